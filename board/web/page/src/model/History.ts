import type { Reading } from "../link/readingsIn";
import { wrap, degrees } from "./geometry";
import { kEstimate, type Robot } from "./Robot";
import { valuesOf } from "./values";

/** A number over time: stamps [s] and values, oldest first. */
export interface Series {
  key: string;
  label: string;
  unit: string;
  times: number[];
  values: number[];
}

const kMost = 3000;
/** How far apart estimate and truth may be to be compared [us]. */
const kApart = 25_000;

/** The numbers of the selected robot that somebody wants to see over time. */
export class History {
  readonly series = new Map<string, Series>();
  version = 0;

  /** Follows value @p name of @p feature from now on; twice: no more. */
  toggle(feature: string, name: string, unit: string): void {
    const key = `${feature} ${name}`;
    if (!this.series.delete(key)) this.add(key, `${feature.split("/").at(-1)} ${name}`, unit);
    this.version++;
  }

  has(feature: string, name: string): boolean {
    return this.series.has(`${feature} ${name}`);
  }

  add(key: string, label: string, unit: string): Series {
    const series = { key, label, unit, times: [], values: [] };
    this.series.set(key, series);
    return series;
  }

  clear(): void {
    for (const series of this.series.values()) series.times = [];
    for (const series of this.series.values()) series.values = [];
    this.version++;
  }

  take(robot: Robot, { stamp, feature, words }: Reading): void {
    const time = stamp / 1e6;
    if (feature === kEstimate) this.takeError(robot, stamp);
    if (!this.isWanted(feature)) return;
    const known = robot.feature(feature);
    if (!known) return;
    for (const { name, value } of valuesOf(known.kind, words, 8192)) {
      const series = this.series.get(`${feature} ${name}`);
      if (series) push(series, time, value);
    }
    this.version++;
  }

  private isWanted(feature: string): boolean {
    for (const key of this.series.keys()) if (key.startsWith(`${feature} `)) return true;
    return false;
  }

  /** The estimate's distance from the truth: [m] and [degrees]. */
  private takeError(robot: Robot, stamp: number): void {
    const { estimate } = robot;
    const truth = robot.truthAt(stamp, kApart);
    if (!estimate || !truth) return;
    const time = stamp / 1e6;
    const distance = this.series.get("error distance") ?? this.add("error distance", "error", "m");
    push(distance, time, Math.hypot(estimate.x - truth.x, estimate.y - truth.y));
    const heading = this.series.get("error heading") ?? this.add("error heading", "heading error", "°");
    push(heading, time, Math.abs(degrees(wrap(estimate.theta - truth.theta))));
    this.version++;
  }
}

function push(series: Series, time: number, value: number): void {
  const last = series.times.at(-1);
  if (last !== undefined && time < last) {
    series.times = [];
    series.values = [];
  } else if (last === time) {
    return;
  }
  series.times.push(time);
  series.values.push(value);
  if (series.times.length > kMost) {
    series.times.splice(0, kMost / 10);
    series.values.splice(0, kMost / 10);
  }
}
