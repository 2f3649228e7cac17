import { radians, wrap, type Pose } from "./geometry";

/** What kind of reading a feature has, as the server's description of its words tells. */
export type Kind =
  | { name: "scan"; first: number; step: number; most: number }
  | { name: "cone"; most: number }
  | { name: "range" | "bearing" | "landmarks" | "points" | "objects" | "obstacles" | "pose" | "odometry" }
  | { name: "fix" | "status" | "samples" | "places" | "work" | "image" | "device" | "other" };

/** Feature names are MODEL/TYPE/FEATURE. */
export interface Feature {
  name: string;
  text: string;
  kind: Kind;
  mount: Pose;
}

const kOwn: Record<string, Kind["name"]> = {
  "mcl/LOCALIZATION/samples": "samples",
  "mcl/LOCALIZATION/places": "places",
  "mcl/LOCALIZATION/work": "work",
  "mcl/LOCALIZATION/status": "status",
  "mcl/LOCALIZATION/pose": "fix",
};

export function kindOf(name: string, text: string): Kind {
  const own = kOwn[name];
  if (own) return { name: own } as Kind;
  if (text === "" && name === "odometry/odometry/pose") return { name: "odometry" }; // of a record alone
  const scan = /of each of \d+ beams from (-?[\d.e-]+) deg in steps of ([\d.e-]+) deg.* from ([\d.e+]+) on/.exec(text);
  if (scan) {
    return { name: "scan", first: radians(Number(scan[1])), step: radians(Number(scan[2])), most: Number(scan[3]) / 1000 };
  }
  const cone = /^\[distance mm\]; 0: not valid; from ([\d.e+]+) on/.exec(text);
  if (cone) return { name: "cone", most: Number(cone[1]) / 1000 };
  if (text.startsWith("[distance mm], or none")) return { name: "range" };
  if (text.startsWith("[bearing 1/100 degree + 18000], or none")) return { name: "bearing" };
  if (text.startsWith("[identity, distance mm, bearing")) return { name: "landmarks" };
  if (text.startsWith("[distance mm, bearing 1/100 degree + 18000] a point")) return { name: "points" };
  if (text.startsWith("[identity or 0, colour")) return { name: "objects" };
  if (text.startsWith("[0, x mm + 2^31")) return { name: "obstacles" };
  if (text.startsWith("[width, height, bytes a pixel")) return { name: "image" };
  if (text.startsWith("[status (")) return { name: "status" };
  if (text.startsWith("[0 opening, 1 absent")) return { name: "device" };
  if (text.startsWith("[x mm + 2^31, y mm + 2^31, heading 1/100 degree + 18000")) {
    if (text.includes("sigma x um")) return { name: "fix" };
    if (text.includes("translational velocity")) return { name: "odometry" };
    if (text.includes("] in the field frame")) return { name: "pose" };
  }
  return { name: "other" };
}

const kMiddle = 2 ** 31;
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

export interface Sighting {
  identity: number;
  range: number;
  bearing: number;
  /** "#rrggbb" or null. */
  colour: string | null;
  radius: number;
}

export function sightingsOf(kind: Kind["name"], words: Uint32Array): Sighting[] {
  const found: Sighting[] = [];
  const add = (identity: number, mm: number, bearing: number, colour: number, radius: number) =>
    found.push({
      identity,
      range: mm / 1000,
      bearing: bearingOf(bearing),
      colour: colour < 2 ** 24 ? `#${colour.toString(16).padStart(6, "0")}` : null,
      radius: radius / 1000,
    });
  if (kind === "landmarks") {
    for (let i = 0; i + 3 <= words.length; i += 3) add(words[i]!, words[i + 1]!, words[i + 2]!, 2 ** 24, 0);
  } else if (kind === "points") {
    for (let i = 0; i + 2 <= words.length; i += 2) add(0, words[i]!, words[i + 1]!, 2 ** 24, 0);
  } else if (kind === "objects") {
    for (let i = 0; i + 5 <= words.length; i += 5) add(words[i]!, words[i + 2]!, words[i + 3]!, words[i + 1]!, words[i + 4]!);
  }
  return found;
}

const kStatus = ["tracking", "uncertain", "lost"];
const kReasons = [
  "readings fit",
  "several places fit",
  "the belief is spread",
  "no reading comes",
  "a device repeats its reading",
  "readings fit worse than they use to",
  "readings fit elsewhere",
  "readings contradict odometry",
  "the field is searched",
  "readings are late",
  "few readings have confirmed the place yet",
];
const kDevice = ["opening", "absent", "running", "stale", "frozen", "failed"];

export interface Status {
  status: string;
  reason: string;
  quality: number;
  share: number;
}

export function statusOf(words: Uint32Array): Status | null {
  if (words.length < 4) return null;
  return {
    status: kStatus[words[0]!] ?? `status ${words[0]}`,
    reason: kReasons[words[1]!] ?? `reason ${words[1]}`,
    quality: words[2]! / 10000,
    share: words[3]! / 10000,
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

/** A number of a reading, with its name and unit. */
export interface Value {
  name: string;
  value: number;
  unit: string;
}

const kAngle = (angle: number) => (angle * 180) / Math.PI;

/** The numbers of a reading: what panels list and curves show. At most @p most of them. */
export function valuesOf(kind: Kind, words: Uint32Array, most = 64): Value[] {
  const values: Value[] = [];
  const add = (name: string, value: number, unit: string) => values.push({ name, value, unit });
  switch (kind.name) {
    case "scan":
      for (let i = 0; i < words.length && i < most; ++i) add(`beam ${i}`, words[i]! / 1000, "m");
      break;
    case "cone":
    case "range":
      if (words.length) add("distance", words[0]! / 1000, "m");
      break;
    case "bearing":
      if (words.length) add("bearing", kAngle(bearingOf(words[0]!)), "°");
      break;
    case "pose":
    case "fix":
    case "odometry": {
      const pose = poseOf(words);
      if (!pose) break;
      add("x", pose.x, "m");
      add("y", pose.y, "m");
      add("heading", kAngle(pose.theta), "°");
      if (kind.name === "odometry" && words.length >= 5) {
        add("velocity", lengthOf(words[3]!), "m/s");
        add("turning", (words[4]! - kMiddle) / 100, "°/s");
      }
      const fix = kind.name === "fix" ? fixOf(words) : null;
      if (fix) {
        add("sigma x", fix.sigmaX, "m");
        add("sigma y", fix.sigmaY, "m");
        add("sigma heading", kAngle(fix.sigmaTheta), "°");
      }
      break;
    }
    case "landmarks":
    case "points":
    case "objects":
      sightingsOf(kind.name, words).slice(0, most / 2).forEach((seen, i) => {
        const name = kind.name === "landmarks" ? `${seen.identity}` : `${i + 1}`;
        add(`${name} distance`, seen.range, "m");
        add(`${name} bearing`, kAngle(seen.bearing), "°");
      });
      break;
    case "status": {
      const status = statusOf(words);
      if (status) add("quality", status.quality, ""), add("share", status.share, "");
      break;
    }
    case "work":
      if (words.length >= 4) {
        add("samples", words[0]!, "");
        add("effective samples", words[1]!, "");
        add("update", words[2]! / 1000, "ms");
        add("updates", words[3]!, "");
      }
      break;
    case "samples":
    case "places":
    case "image":
      break;
    default:
      for (let i = 0; i < words.length && i < most; ++i) add(`word ${i}`, words[i]!, "");
  }
  return values;
}

const number = (value: number, digits = 2) => value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");

/** A reading in one line, for people. */
export function summary(kind: Kind, words: Uint32Array): string {
  if (kind.name === "scan") {
    let nearest = Infinity;
    let valid = 0;
    for (const word of words) {
      const range = word / 1000;
      if (word === 0) continue;
      ++valid;
      if (range < nearest && range < kind.most) nearest = range;
    }
    return `${words.length} beams, ${valid} valid${Number.isFinite(nearest) ? `, nearest ${number(nearest)} m` : ""}`;
  }
  if (kind.name === "cone") {
    if (!words.length || words[0] === 0) return "not valid";
    return words[0]! / 1000 >= kind.most ? `nothing within ${number(kind.most)} m` : `${number(words[0]! / 1000)} m`;
  }
  if (kind.name === "image") {
    const picture = pictureOf(words);
    return picture ? `${picture.width} × ${picture.height} pixels` : "no picture";
  }
  if (kind.name === "status") {
    const status = statusOf(words);
    return status ? `${status.status}: ${status.reason}, ${number(status.quality * 100, 0)} %` : "-";
  }
  if (kind.name === "device") return kDevice[words[0]!] ?? "-";
  if (kind.name === "samples") return `${words.length / 4} samples`;
  if (kind.name === "places") return placesOf(words).map((p) => `${number(p.share * 100, 0)} %`).join(", ") || "none";
  if (kind.name === "landmarks" || kind.name === "points" || kind.name === "objects") {
    const seen = sightingsOf(kind.name, words);
    if (!seen.length) return "nothing in sight";
    const each = seen.slice(0, 3).map((s) => {
      const who = kind.name === "landmarks" || s.identity ? `${s.identity}: ` : "";
      return `${who}${number(s.range)} m ${number(kAngle(s.bearing), 0)}°`;
    });
    return each.join(", ") + (seen.length > 3 ? `, ${seen.length - 3} more` : "");
  }
  if (!words.length) return "nothing in sight";
  const values = valuesOf(kind, words, 6);
  if (kind.name === "other") return `${words.length} words: ${values.map((v) => v.value).join(" ")}${words.length > 6 ? " …" : ""}`;
  return values.slice(0, 5).map((v) => `${number(v.value, v.unit === "°" ? 1 : v.unit === "" ? 0 : 2)}${v.unit && ` ${v.unit}`}`).join(", ");
}
