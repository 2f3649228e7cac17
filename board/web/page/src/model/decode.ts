import { radians, wrap, type Pose } from "./geometry";
import type { Kind } from "./kinds";

export const kMiddle = 2 ** 31;
export const lengthOf = (word: number): number => (word - kMiddle) / 1000;
/** Of words that have an offset of half a turn. */
export const bearingOf = (word: number): number => wrap(radians((word - 18000) / 100));
/** Of words that have none: 0 to 35999. */
export const headingOf = (word: number): number => wrap(radians(word / 100));

export function poseOf(words: Uint32Array, at = 0): Pose | null {
  if (words.length < at + 3) return null;
  return { x: lengthOf(words[at]!), y: lengthOf(words[at + 1]!), theta: bearingOf(words[at + 2]!) };
}

export interface Fix extends Pose {
  sigmaX: number;
  sigmaY: number;
  sigmaTheta: number;
  /** Covariance of x and y [m^2]. */
  xy: number;
}

/** The nine words of a pose with its sigmas and correlations. */
export function fixOf(words: Uint32Array, at = 0): Fix | null {
  const pose = poseOf(words, at);
  if (!pose || words.length < at + 9) return null;
  const sigmaX = words[at + 3]! / 1e6;
  const sigmaY = words[at + 4]! / 1e6;
  const correlation = (words[at + 6]! - 10000) / 10000;
  return { ...pose, sigmaX, sigmaY, sigmaTheta: radians(words[at + 5]! / 10000), xy: correlation * sigmaX * sigmaY };
}

export interface Place extends Fix {
  share: number;
}

export function placesOf(words: Uint32Array): Place[] {
  const places: Place[] = [];
  for (let at = 0; at + 10 <= words.length; at += 10) {
    const fix = fixOf(words, at + 1);
    if (fix) places.push({ ...fix, share: words[at]! / 10000 });
  }
  return places;
}

/** What the error of an estimate hardly ever exceeds; infinite where nothing bounds it. */
export interface Protection {
  metres: number;
  radians: number;
}

const kUnbounded = 2 ** 32 - 1;
const boundOf = (word: number, unit: number): number => (word === kUnbounded ? Infinity : word * unit);

export function protectionOf(words: Uint32Array): Protection | null {
  if (words.length < 2) return null;
  return { metres: boundOf(words[0]!, 1e-6), radians: boundOf(words[1]!, radians(1e-4)) };
}

/** A cell where readings contradict the map. */
export interface Change {
  x: number;
  y: number;
  isNew: boolean;
  isSure: boolean;
  passes: number;
}

/** Cells where the map no longer fits, and their edge [m]. */
export interface Changes {
  cell: number;
  cells: Change[];
}

export function changesOf(words: Uint32Array): Changes | null {
  if (!words.length) return null;
  const cells: Change[] = [];
  for (let at = 1; at + 6 <= words.length; at += 6)
    cells.push({
      x: lengthOf(words[at + 2]!),
      y: lengthOf(words[at + 3]!),
      isNew: words[at] === 1,
      isSure: words[at + 1] === 1,
      passes: words[at + 4]!,
    });
  return { cell: words[0]! / 1000, cells };
}

export interface Status {
  status: string;
  reason: string;
  quality: number;
  share: number;
  /** How often the estimate moved beyond the robot's motion; null in older records. */
  relocalizations: number | null;
  /** Why it did so last. */
  cause: string;
}

/** What a localization says of itself, in the names that its format tells. */
export function statusOf(kind: Kind, words: Uint32Array): Status | null {
  if (kind.name !== "track" || words.length < 4) return null;
  return {
    status: kind.status[words[0]!] ?? `status ${words[0]}`,
    reason: kind.reason[words[1]!] ?? `reason ${words[1]}`,
    quality: words[2]! / 10000,
    share: words[3]! / 10000,
    relocalizations: words[4] ?? null,
    cause: kind.cause[words[5] ?? 0] ?? `cause ${words[5]}`,
  };
}

export interface Picture {
  width: number;
  height: number;
  channels: number;
  pixels: Uint8Array;
}

export function pictureOf(words: Uint32Array): Picture | null {
  const [width = 0, height = 0, channels = 0] = words;
  const size = width * height * channels;
  const isPicture = width > 0 && height > 0 && (channels === 1 || channels === 3) && size <= (words.length - 3) * 4;
  if (!isPicture) return null;
  return { width, height, channels, pixels: new Uint8Array(words.buffer, words.byteOffset + 12, size) };
}
