import { bearingOf, lengthOf } from "./decode";
import type { Meaning, Rows } from "./kinds";

/** One row of a reading: what it has of it. Lengths [m], angles [rad]; x and y in the frame of the robot. */
export interface Row {
  identity?: number;
  range?: number;
  bearing?: number;
  x?: number;
  y?: number;
  heading?: number;
  radius?: number;
  /** "#rrggbb"; not there if the sensor saw none. */
  colour?: string;
  /** Words whose meaning nobody but the sensor knows. */
  others?: number[];
}

const kNoColour = 2 ** 24;

function take(row: Row, meaning: Meaning, word: number): void {
  switch (meaning) {
    case "identity":
      row.identity ??= word;
      break;
    case "range_mm":
      row.range ??= word / 1000;
      break;
    case "bearing_cdeg":
      row.bearing ??= bearingOf(word);
      break;
    case "x_mm":
      row.x ??= lengthOf(word);
      break;
    case "y_mm":
      row.y ??= lengthOf(word);
      break;
    case "heading_cdeg":
      row.heading ??= bearingOf(word);
      break;
    case "radius_mm":
      row.radius ??= word / 1000;
      break;
    case "colour":
      if (word < kNoColour) row.colour ??= `#${word.toString(16).padStart(6, "0")}`;
      break;
    case "other":
      (row.others ??= []).push(word);
      break;
  }
}

/** What of a row is a length or an angle, so that it is weighed: in the order in which WHY lists it. */
const kWeighed: readonly Meaning[] = ["range_mm", "bearing_cdeg", "x_mm", "y_mm", "heading_cdeg", "radius_mm"];

/** Sightings that are expected, by the values that WHY lists; none if rows are no sightings alone. */
export function expectedSightings({ row: meanings }: Rows, values: Map<number, number>): { range: number; bearing: number }[] {
  const weighed = meanings.filter((meaning) => kWeighed.includes(meaning));
  const [range, bearing] = [weighed.indexOf("range_mm"), weighed.indexOf("bearing_cdeg")];
  const found = [];
  if (weighed.length !== 2 || range < 0 || bearing < 0) return [];
  for (let at = 0; values.has(at) && values.has(at + 1); at += 2) {
    found.push({ range: values.get(at + range)!, bearing: values.get(at + bearing)! });
  }
  return found;
}

/** The rows of a reading, at most @p most of them; of a row that is not complete nothing. */
export function rowsOf({ row: meanings }: Rows, words: Uint32Array, most = Infinity): Row[] {
  const rows: Row[] = [];
  const size = meanings.length;
  for (let at = 0; at + size <= words.length && rows.length < most; at += size) {
    const row: Row = {};
    meanings.forEach((meaning, i) => take(row, meaning, words[at + i]!));
    rows.push(row);
  }
  return rows;
}
