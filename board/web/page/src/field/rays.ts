import { bearingOf, headingOf, lengthOf } from "../model/decode";
import type { Feature } from "../model/features";
import { compose, place, polar, type Point, type Pose } from "../model/geometry";
import type { Rows } from "../model/kinds";
import type { Expected } from "../model/maps";
import type { Held, Robot } from "../model/Robot";
import { expectedSightings, rowsOf, type Row } from "../model/rows";
import type { Layers } from "../ui/layers";

type Rgba = readonly [number, number, number, number];
const kRay: Rgba = [0.34, 0.71, 0.91, 0.28];
const kHit: Rgba = [0.34, 0.71, 0.91, 1];
const kAlong: Rgba = [0.2, 0.5, 0.75, 0.5];
const kFar: Rgba = [0.34, 0.71, 0.91, 0.1];
const kSeen: Rgba = [0.8, 0.47, 0.65, 0.9];
const kObject: Rgba = [1, 0.6, 0.15, 0.95];
const kExpected: Rgba = [0.95, 0.85, 0.2, 1];
const kRayLength = 6;
const kMostRows = 8192;

/** Lines and dots for the readings of a robot, as Cloud takes them. */
export class Rays {
  readonly lines: number[] = [];
  readonly dots: number[] = [];

  private dot({ x, y }: Point, colour: Rgba): void {
    this.dots.push(x, y, ...colour);
  }

  private line(from: Point, to: Point, colour: Rgba, end: Rgba = colour): void {
    this.lines.push(from.x, from.y, ...colour, to.x, to.y, ...end);
  }

  add(robot: Robot, layers: Layers, expected: Expected | null): void {
    for (const feature of robot.features) {
      const held = robot.readings.get(feature.name);
      if (!held) continue;
      const base = (robot.truth && robot.truthAt(held.stamp)) ?? robot.pose;
      if (!base) continue;
      const sensor = compose(base, feature.mount);
      if (layers.rays) this.addRanges(feature, held, sensor);
      if (layers.sightings && !this.addPair(robot, feature, held, sensor)) {
        this.addSightings(feature, held, sensor, base);
      }
      const values = layers.expected ? expected?.get(feature.name) : undefined;
      if (values) this.addExpected(feature, values, sensor);
    }
  }

  /** Where the scans of a whole record have met something. */
  addAlong(robot: Robot): void {
    for (const { feature, words, pose } of robot.along ?? []) {
      const known = robot.feature(feature);
      if (known?.kind.name !== "scan") continue;
      const { first, step, most } = known.kind;
      const sensor = compose(pose, known.mount);
      for (let i = 0; i < words.length; ++i) {
        const range = words[i]! / 1000;
        if (range > 0 && range < most) this.dot(polar(sensor, range, first + i * step), kAlong);
      }
    }
  }

  /**
   * Distance and bearing of one landmark that come as two features: one place.
   * @returns whether the feature is of such a pair
   */
  private addPair(robot: Robot, { name, kind }: Feature, held: Held, sensor: Pose): boolean {
    if (kind.name !== "rows" || (kind.of !== "range" && kind.of !== "bearing")) return false;
    const other = kind.of === "range" ? name.replace(/Distance$/, "Bearing") : name.replace(/Bearing$/, "Distance");
    const partner = other === name ? undefined : robot.readings.get(other);
    const isPair = partner !== undefined && partner.stamp === held.stamp && partner.words.length && held.words.length;
    if (!isPair) return false;
    if (kind.of === "range") {
      const end = polar(sensor, held.words[0]! / 1000, bearingOf(partner.words[0]!));
      this.line(sensor, end, [kSeen[0], kSeen[1], kSeen[2], 0.25], kSeen);
      this.dot(end, kSeen);
    }
    return true;
  }

  private addRanges({ kind }: Feature, { words }: Held, sensor: Pose): void {
    if (kind.name === "scan") {
      for (let i = 0; i < words.length; ++i) {
        const range = words[i]! / 1000;
        if (range <= 0) continue;
        const isFar = range >= kind.most;
        const end = polar(sensor, Math.min(range, kind.most), kind.first + i * kind.step);
        this.line(sensor, end, isFar ? kFar : kRay);
        if (!isFar) this.dot(end, kHit);
      }
    } else if (kind.name === "cone" && words.length && words[0]! > 0) {
      const range = Math.min(words[0]! / 1000, kind.most);
      const colour = words[0]! / 1000 >= kind.most ? kFar : kHit;
      let before: Point = sensor;
      for (let i = -4; i <= 4; ++i) {
        const next = polar(sensor, range, (i / 4) * kind.half);
        this.line(before, next, colour);
        before = next;
      }
      this.line(before, sensor, colour);
    }
  }

  private addSightings({ kind }: Feature, { words }: Held, sensor: Pose, base: Pose): void {
    if (kind.name === "obstacles") this.addObstacles(words, base);
    if (kind.name === "rows") for (const row of rowsOf(kind, words, kMostRows)) this.addRow(kind, row, sensor, base);
  }

  /** What is known of where it is says how it is drawn: a place, a direction, or a distance. */
  private addRow({ row: meanings }: Rows, { range, bearing, x, y }: Row, sensor: Pose, base: Pose): void {
    const colour = meanings.includes("colour") ? kObject : kSeen;
    const faint: Rgba = [colour[0], colour[1], colour[2], 0.25];
    if (range !== undefined && bearing !== undefined) {
      const end = polar(sensor, range, bearing);
      // Points have no identity, and are too many for lines.
      if (meanings.includes("identity")) this.line(sensor, end, faint, colour);
      this.dot(end, colour);
    } else if (x !== undefined && y !== undefined) {
      this.dot(place(base, { x, y }), colour);
    } else if (range !== undefined) {
      this.addCircle(sensor, range, colour);
    } else if (bearing !== undefined) {
      this.line(sensor, polar(sensor, kRayLength, bearing), colour, [colour[0], colour[1], colour[2], 0]);
    }
  }

  private addCircle(middle: Pose, radius: number, colour: Rgba): void {
    for (let i = 0; i < 48; ++i) {
      this.line(polar(middle, radius, (i * Math.PI) / 24), polar(middle, radius, ((i + 0.5) * Math.PI) / 24), colour);
    }
  }

  /** Circles and segments in the frame of the robot. */
  private addObstacles(words: Uint32Array, base: Pose): void {
    for (let i = 0; i + 5 <= words.length; i += 5) {
      const at = (k: number) => lengthOf(words[i + k]!);
      const first = compose(base, { x: at(1), y: at(2), theta: 0 });
      if (words[i] === 0) this.dot(first, kObject);
      else this.line(first, compose(base, { x: at(3), y: at(4), theta: 0 }), kObject);
    }
  }

  private addExpected({ kind }: Feature, values: Map<number, number>, sensor: Pose): void {
    for (const [index, value] of values) {
      if (kind.name === "scan") {
        if (value > 0 && value < kind.most) this.dot(polar(sensor, value, kind.first + index * kind.step), kExpected);
      } else if (kind.name === "cone" && value < kind.most) {
        const left = polar(sensor, value, -kind.half);
        this.line(left, polar(sensor, value, kind.half), kExpected);
      } else if (kind.name === "rows" && kind.of === "bearing") {
        this.line(sensor, polar(sensor, kRayLength, value), kExpected, [kExpected[0], kExpected[1], kExpected[2], 0]);
      }
    }
    if (kind.name !== "rows") return;
    for (const { range, bearing } of expectedSightings(kind, values)) this.dot(polar(sensor, range, bearing), kExpected);
  }
}

/** Samples as Cloud takes them: x, y, heading, weight. */
export function arrowsOf(words: Uint32Array): Float32Array {
  const count = words.length >> 2;
  const data = new Float32Array(4 * count);
  for (let i = 0; i < 4 * count; i += 4) {
    data[i] = lengthOf(words[i]!);
    data[i + 1] = lengthOf(words[i + 1]!);
    data[i + 2] = headingOf(words[i + 2]!);
    data[i + 3] = Math.min(1, words[i + 3]! / 65535);
  }
  return data;
}
