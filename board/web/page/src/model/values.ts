import { changesOf, fixOf, kMiddle, lengthOf, pictureOf, placesOf, poseOf, protectionOf, statusOf, type Protection } from "./decode";
import { degrees } from "./geometry";
import type { Kind, Rows } from "./kinds";
import { rowsOf, type Row } from "./rows";

/** A number of a reading, with its name and unit. */
export interface Value {
  name: string;
  value: number;
  unit: string;
}

/** The numbers of a reading: what panels list and curves show. At most @p most of them. */
export function valuesOf(kind: Kind, words: Uint32Array, most = 64): Value[] {
  switch (kind.name) {
    case "scan":
      return Array.from(words.subarray(0, most), (word, i) => ({ name: `beam ${i}`, value: word / 1000, unit: "m" }));
    case "cone":
      return words.length ? [{ name: "distance", value: words[0]! / 1000, unit: "m" }] : [];
    case "rows":
      return rowValues(kind, words, most);
    case "pose":
    case "fix":
    case "odometry":
      return poseValues(kind.name, words);
    case "track": {
      const status = statusOf(kind, words);
      if (!status) return [];
      return [{ name: "quality", value: status.quality, unit: "" }, { name: "share", value: status.share, unit: "" }];
    }
    case "protection": {
      const bound = protectionOf(words);
      if (!bound || !Number.isFinite(bound.metres)) return [];
      return [{ name: "radius", value: bound.metres, unit: "m" }, { name: "angle", value: degrees(bound.radians), unit: "°" }];
    }
    case "changes": {
      const counts = changeCounts(words);
      return [{ name: "walls gone", value: counts.gone, unit: "cells" }, { name: "new", value: counts.fresh, unit: "cells" }];
    }
    case "work":
      if (words.length < 4) return [];
      return [
        { name: "samples", value: words[0]!, unit: "" },
        { name: "effective samples", value: words[1]!, unit: "" },
        { name: "update", value: words[2]! / 1000, unit: "ms" },
        { name: "updates", value: words[3]!, unit: "" },
      ];
    case "samples":
    case "clusters":
    case "image":
      return [];
    default:
      return Array.from(words.subarray(0, most), (word, i) => ({ name: `word ${i}`, value: word, unit: "" }));
  }
}

function poseValues(kind: "pose" | "fix" | "odometry", words: Uint32Array): Value[] {
  const pose = poseOf(words);
  if (!pose) return [];
  const values: Value[] = [
    { name: "x", value: pose.x, unit: "m" },
    { name: "y", value: pose.y, unit: "m" },
    { name: "heading", value: degrees(pose.theta), unit: "°" },
  ];
  if (kind === "odometry" && words.length >= 5) {
    values.push({ name: "velocity", value: lengthOf(words[3]!), unit: "m/s" });
    values.push({ name: "turning", value: (words[4]! - kMiddle) / 100, unit: "°/s" });
  }
  const fix = kind === "fix" ? fixOf(words) : null;
  if (fix) {
    values.push({ name: "sigma x", value: fix.sigmaX, unit: "m" }, { name: "sigma y", value: fix.sigmaY, unit: "m" });
    values.push({ name: "sigma heading", value: degrees(fix.sigmaTheta), unit: "°" });
  }
  return values;
}

/** What of a row is a length or an angle. */
function partsOf(row: Row): Value[] {
  const lengths = { distance: row.range, x: row.x, y: row.y, radius: row.radius };
  const angles = { bearing: row.bearing, heading: row.heading };
  return [
    ...Object.entries(lengths).map(([name, value]) => ({ name, value, unit: "m" })),
    ...Object.entries(angles).map(([name, value]) => ({ name, value: value && degrees(value), unit: "°" })),
  ].filter((part): part is Value => part.value !== undefined);
}

/** How a row is called among the others: by what was seen, or else by its place. */
function labelOf(kind: Rows, row: Row, index: number): string {
  if (kind.of === "range" || kind.of === "bearing") return ""; // there is one at most
  // Objects have 0 where nobody knows which they are.
  return String(kind.of === "objects" ? index + 1 : (row.identity ?? index + 1));
}

function rowValues(kind: Rows, words: Uint32Array, most: number): Value[] {
  const values: Value[] = [];
  rowsOf(kind, words, most).forEach((row, i) => {
    const label = labelOf(kind, row, i);
    for (const { name, value, unit } of partsOf(row)) values.push({ name: `${label} ${name}`.trim(), value, unit });
    row.others?.forEach((value, k) => values.push({ name: `${label} word ${k}`.trim(), value, unit: "" }));
  });
  return values.slice(0, most);
}

const number = (value: number, digits = 2) => value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");

const kShown = 3;

/** The first rows in one line. */
function rowSummary(kind: Rows, words: Uint32Array): string {
  const count = Math.floor(words.length / kind.row.length);
  if (!count) return "nothing in sight";
  const each = rowsOf(kind, words, kShown).map((row) => {
    const who = row.identity || kind.of === "landmarks" ? `${row.identity}: ` : "";
    const parts = partsOf(row).filter(({ name }) => name !== "radius");
    const digits = parts.length === 1 ? 1 : 0;
    const texts = parts.map(({ value, unit }) => (unit === "°" ? `${number(value, digits)}°` : `${number(value)} m`));
    return who + (texts.join(" ") || "–");
  });
  return each.join(", ") + (count > kShown ? `, ${count - kShown} more` : "");
}

function scanSummary(words: Uint32Array, most: number): string {
  const ranges = Array.from(words, (word) => word / 1000).filter((range) => range > 0);
  const nearest = ranges.reduce((least, range) => Math.min(least, range), most);
  return `${words.length} beams, ${ranges.length} valid${nearest < most ? `, nearest ${number(nearest)} m` : ""}`;
}

/** A reading in one line, for people. */
export function summary(kind: Kind, words: Uint32Array): string {
  switch (kind.name) {
    case "scan":
      return scanSummary(words, kind.most);
    case "cone":
      if (!words.length || words[0] === 0) return "not valid";
      return words[0]! / 1000 >= kind.most ? `nothing within ${number(kind.most)} m` : `${number(words[0]! / 1000)} m`;
    case "image": {
      const picture = pictureOf(words);
      return picture ? `${picture.width} × ${picture.height} pixels` : "no picture";
    }
    case "track": {
      const status = statusOf(kind, words);
      return status ? `${status.status}: ${status.reason}, ${number(status.quality * 100, 0)} %` : "-";
    }
    case "device":
      return kind.status[words[0]!] ?? "-";
    case "samples":
      return `${words.length / 4} samples`;
    case "clusters":
      return placesOf(words).map((place) => `${number(place.share * 100, 0)} %`).join(", ") || "none";
    case "protection": {
      const bound = protectionOf(words);
      return bound ? boundText(bound) : "-";
    }
    case "changes": {
      const { gone, fresh, unsure } = changeCounts(words);
      return gone + fresh + unsure ? `${gone} cells of walls gone, ${fresh} new, ${unsure} not sure` : "nothing";
    }
    case "rows":
      return rowSummary(kind, words);
    default:
      return words.length ? plainSummary(kind, words) : "nothing in sight";
  }
}

/** How many cells of the map no longer fit, for sure or not. */
function changeCounts(words: Uint32Array): { gone: number; fresh: number; unsure: number } {
  const cells = changesOf(words)?.cells ?? [];
  const sure = cells.filter(({ isSure }) => isSure);
  const fresh = sure.filter(({ isNew }) => isNew).length;
  return { gone: sure.length - fresh, fresh, unsure: cells.length - sure.length };
}

/** A bound of an error, for people. */
export function boundText({ metres, radians }: Protection): string {
  return Number.isFinite(metres) ? `${number(metres)} m, ${number(degrees(radians), 1)}°` : "unbounded";
}

function plainSummary(kind: Kind, words: Uint32Array): string {
  const values = valuesOf(kind, words, 6);
  if (kind.name === "other" || kind.name === "obstacles") {
    return `${words.length} words: ${values.map(({ value }) => value).join(" ")}${words.length > 6 ? " …" : ""}`;
  }
  const digits = (unit: string) => (unit === "°" ? 1 : unit === "" ? 0 : 2);
  return values.slice(0, 5).map(({ value, unit }) => `${number(value, digits(unit))}${unit && ` ${unit}`}`).join(", ");
}
