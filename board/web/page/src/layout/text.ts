import { curvesOf, type PanelId } from "./curves";
import { isPanel, kAreas, kMostPanels, kShare, kSizes, panelsOf, type Area, type Group, type Layout } from "./Layout";

/**
 * How a page is arranged, as a text for its address, of letters that need no escapes there:
 *
 *     1*s372.372.230*r100o1.robots.sensors_50o0.game*mcurves...*llegend.names*v3d
 *
 * The version; the sizes of left, right and bottom; the groups of each area (share, open or collapsed, which panel is
 * seen, panels); the panel that is large; the field's layers; and how the field is seen.
 */
export interface Arrangement {
  layout: Layout;
  /** Names of the layers that are on; null: as the page has them. */
  layers: string[] | null;
  views: string[];
}

const kVersion = "1";
const kLongest = 8000;
const kMostWords = 40;
const kAreaLetters: Record<Area, string> = { left: "a", right: "r", bottom: "b" };

/** Reading failed: says in words why. */
export class LayoutError extends Error {}

/** Letters and digits stay; all else becomes `-` and two digits of each of its bytes. */
function escaped(text: string): string {
  return encodeURIComponent(text)
    .replace(/[-_.!~*'()]/g, (sign) => `%${sign.charCodeAt(0).toString(16)}`)
    .replaceAll("%", "-");
}

function unescaped(text: string): string {
  if (!/^[A-Za-z0-9-]*$/.test(text)) throw new LayoutError("a name has signs that belong to none");
  try {
    return decodeURIComponent(text.replaceAll("-", "%"));
  } catch {
    throw new LayoutError("a name is not written in full");
  }
}

const writeGroup = ({ panels, shown, isCollapsed, share }: Group): string =>
  [`${share}${isCollapsed ? "c" : "o"}${shown}`, ...panels.map(escaped)].join(".");

export function writeArrangement({ layout, layers, views }: Arrangement): string {
  const { sizes, groups, large } = layout;
  const parts = [kVersion, `s${kAreas.map((area) => sizes[area]).join(".")}`];
  for (const area of kAreas) if (groups[area].length) parts.push(kAreaLetters[area] + groups[area].map(writeGroup).join("_"));
  if (large !== null) parts.push(`m${escaped(large)}`);
  if (layers) parts.push(`l${layers.join(".")}`);
  if (views.length) parts.push(`v${views.join(".")}`);
  return parts.join("*");
}

function numberIn(text: string, { least, most }: { least: number; most: number }, what: string): number {
  const value = /^\d{1,5}$/.test(text) ? Number(text) : NaN;
  if (!(value >= least && value <= most)) throw new LayoutError(`${what} is not from ${least} to ${most}`);
  return value;
}

function readGroup(text: string): Group {
  const [head = "", ...names] = text.split(".");
  const [, share = "", state, shown = ""] = /^(\d+)([co])(\d+)$/.exec(head) ?? [];
  const panels = names.map(unescaped);
  if (!panels.length || panels.length > kMostPanels) throw new LayoutError("a group has no panels, or too many");
  const stranger = panels.find((panel) => !isPanel(panel));
  if (stranger !== undefined) throw new LayoutError("it has a panel that is unknown here");
  return {
    panels,
    shown: numberIn(shown, { least: 0, most: panels.length - 1 }, "the tab of a group"),
    isCollapsed: state === "c",
    share: numberIn(share, kShare, "the share of a group"),
  };
}

function readSizes(text: string): Record<Area, number> {
  const words = text.split(".");
  if (words.length !== kAreas.length) throw new LayoutError("it has not three sizes");
  const size = (area: Area, at: number) => numberIn(words[at]!, kSizes[area], `the size of ${area}`);
  return { left: size("left", 0), right: size("right", 1), bottom: size("bottom", 2) };
}

function readWords(text: string): string[] {
  const words = text === "" ? [] : text.split(".");
  if (words.length > kMostWords || !words.every((word) => /^[A-Za-z0-9]{1,20}$/.test(word))) {
    throw new LayoutError("its layers or views are no words");
  }
  return words;
}

/** The parts of a text by their first letters. */
function partsOf(text: string): Map<string, string> {
  if (text.length > kLongest) throw new LayoutError(`it has more than ${kLongest} signs`);
  const [version = "", ...parts] = text.split("*");
  if (version !== kVersion) throw new LayoutError(`it is of another version (${version.slice(0, 12) || "none"})`);
  const found = new Map<string, string>();
  for (const part of parts) {
    const letter = part.slice(0, 1);
    if (!/^[sarbmlv]$/.test(letter)) throw new LayoutError("it has a part that is unknown here");
    if (found.has(letter)) throw new LayoutError("it says a part twice");
    found.set(letter, part.slice(1));
  }
  return found;
}

function readLarge(text: string | undefined, open: PanelId[]): PanelId | null {
  if (text === undefined) return null;
  const panel = unescaped(text);
  if (!open.includes(panel)) throw new LayoutError("its large panel is not open");
  return panel;
}

/** What `writeArrangement` has written. @throws LayoutError in words, for any other text */
export function readArrangement(text: string): Arrangement {
  const parts = partsOf(text);
  const groupsOf = (area: Area) => {
    const its = parts.get(kAreaLetters[area]);
    return its === undefined ? [] : its.split("_").map(readGroup);
  };
  const groups = { left: groupsOf("left"), right: groupsOf("right"), bottom: groupsOf("bottom") };
  const layout: Layout = { groups, sizes: readSizes(parts.get("s") ?? ""), large: null };
  const open = panelsOf(layout);
  if (open.length > kMostPanels) throw new LayoutError(`it has more than ${kMostPanels} panels`);
  if (new Set(open).size !== open.length) throw new LayoutError("it has a panel twice");
  const keys = open.flatMap((panel) => curvesOf(panel)?.map(({ key }) => key) ?? []);
  if (new Set(keys).size !== keys.length) throw new LayoutError("it has a curve twice");
  layout.large = readLarge(parts.get("m"), open);
  const layers = parts.get("l");
  return { layout, layers: layers === undefined ? null : readWords(layers), views: readWords(parts.get("v") ?? "") };
}
