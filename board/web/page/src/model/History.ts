import type { Reading } from "../link/readingsIn";
import { wrap, degrees, type Pose } from "./geometry";
import { kEstimate } from "./features";
import { momentAt, type Moment, type Way } from "./moments";
import type { Robot } from "./Robot";
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
  /** Of a record, whose series are whole from the beginning: brings them. */
  whole: { begin: number; end: number; wanted: () => void } | null = null;

  /** Follows value @p name of @p feature from now on; twice: no more. */
  toggle(feature: string, name: string, unit: string): void {
    const key = `${feature} ${name}`;
    if (!this.series.delete(key)) this.add(key, `${feature.split("/").at(-1)} ${name}`, unit);
    this.version++;
    this.whole?.wanted();
  }

  has(feature: string, name: string): boolean {
    return this.series.has(`${feature} ${name}`);
  }

  /** Follows a series that a panel shows, by its key. */
  follow(key: string, label: string, unit: string): void {
    if (this.series.has(key) || !key.includes("/")) return;
    this.add(key, label, unit);
    this.version++;
    this.whole?.wanted();
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
    this.whole?.wanted();
  }

  take(robot: Robot, { stamp, feature, words }: Reading): void {
    if (this.whole) return;
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

  /** Features of which a series is wanted that has no value yet. */
  get missing(): string[] {
    const found = new Set<string>();
    for (const { key, times } of this.series.values()) if (!times.length && key.includes("/")) found.add(key.split(" ", 1)[0]!);
    return [...found];
  }

  /** All that a record has of a feature. */
  takeWhole(robot: Robot, readings: Reading[]): void {
    for (const { stamp, feature, words } of readings) {
      const known = robot.feature(feature);
      if (!known) continue;
      for (const { name, value } of valuesOf(known.kind, words, 8192)) {
        const series = this.series.get(`${feature} ${name}`);
        if (series) push(series, stamp / 1e6, value);
      }
    }
    this.version++;
  }

  /** How far the estimates of a whole record are from the truth, and from those of others, by their names. */
  takeWays(way: Way, others: Map<string, Way>): void {
    for (const key of [...this.series.keys()]) if (!key.includes("/")) this.series.delete(key);
    const { estimate, truth } = way;
    const turn = (a: { theta: number }, b: { theta: number }) => Math.abs(degrees(wrap(a.theta - b.theta)));
    this.compare("error distance", "error", "m", estimate, truth, apart);
    this.compare("error heading", "heading error", "°", estimate, truth, turn);
    const own = estimate.length ? estimate : truth;
    for (const [name, other] of others) {
      const its = other.estimate.length ? other.estimate : other.truth;
      this.compare(`apart ${name}`, `from ${name}`, "m", own, its, apart);
    }
    this.version++;
  }

  private compare(key: string, label: string, unit: string, own: Moment[], other: Moment[], by: typeof apart): void {
    if (!own.length || !other.length) return;
    const series = this.add(key, label, unit);
    for (const moment of own) {
      const its = momentAt(other, moment.stamp);
      if (its) push(series, moment.stamp / 1e6, by(moment, its));
    }
    if (!series.times.length) this.series.delete(key);
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

const apart = (a: Pose, b: Pose): number => Math.hypot(a.x - b.x, a.y - b.y);

/** A value of a series at a time [s]: the last one before it. */
export function valueAt({ times, values }: Series, time: number): number | undefined {
  let found: number | undefined;
  for (let i = 0; i < times.length && times[i]! <= time; ++i) found = values[i];
  return found;
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
  if (series.times.length > kMost) { // never of a whole record, which has fewer
    series.times.splice(0, kMost / 10);
    series.values.splice(0, kMost / 10);
  }
}
