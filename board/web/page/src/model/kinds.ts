import { listIn, numberIn, type Format } from "./Format";
import { radians } from "./geometry";

/** What a word of a row can mean. */
export const kMeanings = [
  "identity", "range_mm", "bearing_cdeg", "x_mm", "y_mm", "heading_cdeg", "radius_mm", "colour", "other",
] as const;
export type Meaning = (typeof kMeanings)[number];

/** Words that are rows one behind the other. `of`: the container's own format, "" of a plugin's. */
export interface Rows {
  name: "rows";
  of: "" | "range" | "bearing" | "landmarks" | "points" | "objects";
  row: readonly Meaning[];
}

/** What kind of reading a feature has. */
export type Kind =
  | { name: "scan"; first: number; step: number; most: number }
  | { name: "cone"; half: number; most: number }
  | { name: "track"; status: string[]; reason: string[]; cause: string[] }
  | { name: "device"; status: string[] }
  | Rows
  | { name: "obstacles" | "pose" | "fix" | "odometry" | "image" | "clusters" | "protection" | "changes" | "work" | "samples" | "other" };

/** The container's own formats whose words are rows. */
const kOwnRows: Record<Exclude<Rows["of"], "">, readonly Meaning[]> = {
  range: ["range_mm"],
  bearing: ["bearing_cdeg"],
  landmarks: ["identity", "range_mm", "bearing_cdeg"],
  points: ["range_mm", "bearing_cdeg"],
  objects: ["identity", "colour", "range_mm", "bearing_cdeg", "radius_mm"],
};

const kOther: Kind = { name: "other" };

/** The kind of a format; "other" of one that this page does not know or that is not complete. */
export function kindOf(format: Format | null): Kind {
  if (!format) return kOther;
  const { name } = format;
  switch (name) {
    case "scan": {
      const [first, step, most] = ["first_deg", "step_deg", "max_m"].map((key) => numberIn(format, key));
      const isScan = first != null && step != null && most != null && most > 0;
      return isScan ? { name, first: radians(first), step: radians(step), most } : kOther;
    }
    case "cone": {
      const [opening, most] = ["opening_deg", "max_m"].map((key) => numberIn(format, key));
      const isCone = opening != null && most != null && opening >= 0 && most > 0;
      return isCone ? { name, half: radians(Math.min(opening, 360)) / 2, most } : kOther;
    }
    case "range":
    case "bearing":
    case "landmarks":
    case "points":
    case "objects":
      return { name: "rows", of: name, row: kOwnRows[name] };
    case "track":
      return { name, status: namesIn(format, "status"), reason: namesIn(format, "reason"), cause: namesIn(format, "cause") };
    case "device":
      return { name, status: namesIn(format, "status") };
    case "obstacles":
    case "pose":
    case "fix":
    case "odometry":
    case "image":
    case "clusters":
    case "protection":
    case "changes":
    case "work":
    case "samples":
      return { name };
    default:
      return foreign(format);
  }
}

/** Names have no blanks in a line: '_' stands for them. */
const namesIn = (format: Format, key: string): string[] => listIn(format, key).map((name) => name.replaceAll("_", " "));

/** A plugin's own format: what each word of a row means says how it is drawn. */
function foreign(format: Format): Kind {
  const row = listIn(format, "row").map((one) => kMeanings.find((meaning) => meaning === one) ?? "other");
  return row.length ? { name: "rows", of: "", row } : kOther;
}
