import { describe, expect, it } from "vitest";
import { canJoin, curvesOf, kMostCurves, nameOfKey, panelOf } from "../src/layout/curves";
import { kAreas, kMostPanels, kPanels, oneGroup, panelsOf, placeOf, shownOf, usualLayout, type Layout } from "../src/layout/Layout";
import { closed, collapsed, enlarged, joined, keysOut, moved, resized, revealed, shared, shifted, takenOut, targetOf, type Way } from "../src/layout/moves";
import { LayoutError, readArrangement, writeArrangement } from "../src/layout/text";

/** Numbers in [0, 1), the same in every run (mulberry32). */
function chance(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const kKeys = ["error distance", "error heading", "LMS200/LRF/180DegreeScan nearest", "a.b/c_d/e*f x-y", "mcl/effort/ü° effective samples"];
const kWays: Way[] = ["up", "down", "left", "right", "bottom", "earlier", "later"];
const where = (layout: Layout) => kAreas.map((area) => layout.groups[area].map(({ panels }) => panels.join("+")).join(" | "));
const curve = (key: string, unit = "m") => ({ key, unit });

/** Any step that a user can make. */
function step(layout: Layout, next: () => number): Layout {
  const pick = <T>(all: readonly T[]): T => all[Math.floor(next() * all.length)]!;
  const panel = pick([...panelsOf(layout), ...kPanels]);
  const area = pick(kAreas);
  const group = Math.floor(next() * 4);
  const some = [curve(pick(kKeys), pick(["m", "°", ""]))];
  return pick<() => Layout>([
    () => moved(layout, panel, { area, before: group }),
    () => moved(layout, panel, { area, group, at: Math.floor(next() * 5) }),
    () => shifted(layout, panel, pick(kWays)),
    () => closed(layout, panel),
    () => revealed(layout, panel),
    () => enlarged(layout, next() < 0.3 ? null : panel),
    () => collapsed(layout, area, group, next() < 0.5),
    () => resized(layout, area, 3000 * next() - 500),
    () => shared(layout, area, group, 3 * next() - 1),
    () => takenOut(layout, some, { area, before: group }),
    () => joined(layout, some, panel),
  ])();
}

function checkSound(layout: Layout): void {
  const open = panelsOf(layout);
  expect(new Set(open).size).toBe(open.length);
  for (const area of kAreas) {
    for (const group of layout.groups[area]) {
      expect(group.panels.length).toBeGreaterThan(0);
      expect(group.panels).not.toContain("");
      expect(group.panels).toContain(shownOf(group));
    }
  }
  if (layout.large !== null) expect(open).toContain(layout.large);
  const keys = open.flatMap((panel) => curvesOf(panel)?.map(({ key }) => key) ?? []);
  expect(new Set(keys).size).toBe(keys.length);
}

describe("a layout", () => {
  it("has a panel put before, behind and among others", () => {
    const begin = usualLayout();
    const split = moved(begin, "sensors", { area: "right", before: 1 });
    expect(where(split)).toEqual(["", "robots+localization+game | sensors", ""]);
    expect(where(moved(split, "sensors", { area: "right", before: 0 }))).toEqual(["", "sensors | robots+localization+game", ""]);
    const back = moved(split, "sensors", { area: "right", group: 0, at: 1 });
    expect(where(back)).toEqual(["", "robots+sensors+localization+game", ""]);
    expect(shownOf(back.groups.right[0]!)).toBe("sensors");
    expect(where(moved(begin, "robots", { area: "right", group: 0, at: 3 }))).toEqual(["", "sensors+localization+robots+game", ""]);
    expect(where(begin)).toEqual(["", "robots+sensors+localization+game", ""]);
  });

  it("has each panel moved by the menu's words", () => {
    const said = (...ways: Way[]) => where(ways.reduce((layout, way) => shifted(layout, "sensors", way), usualLayout()));
    expect(said("left")).toEqual(["sensors", "robots+localization+game", ""]);
    expect(said("bottom")).toEqual(["", "robots+localization+game", "sensors"]);
    expect(said("down")).toEqual(["", "robots+localization+game | sensors", ""]);
    expect(said("down", "up")).toEqual(["", "sensors | robots+localization+game", ""]);
    expect(said("up", "down")).toEqual(["", "robots+localization+game | sensors", ""]);
    expect(said("later")).toEqual(["", "robots+localization+sensors+game", ""]);
    expect(said("earlier")).toEqual(["", "sensors+robots+localization+game", ""]);
    expect(said("left", "right")).toEqual(["", "robots+localization+game | sensors", ""]);
    const alone = shifted(usualLayout(), "sensors", "left");
    for (const way of ["up", "down", "left", "earlier", "later"] as const) expect(targetOf(alone, "sensors", way)).toBeNull();
    expect(targetOf(closed(alone, "sensors"), "sensors", "up")).toBeNull();
  });

  it("keeps the share and the state of a group that is moved in its area", () => {
    let layout = shifted(usualLayout(), "game", "down");
    layout = collapsed(shared(layout, "right", 0, 0.3), "right", 1, true);
    expect(shifted(layout, "game", "up").groups.right).toMatchObject([{ share: 140, isCollapsed: true }, { share: 60 }]);
  });

  it("brings closed panels back where most are, and none twice", () => {
    const gone = closed(closed(usualLayout(), "sensors"), "game");
    expect(where(gone)).toEqual(["", "robots+localization", ""]);
    expect(where(revealed(gone, "sensors"))).toEqual(["", "robots+localization+sensors", ""]);
    const none = kPanels.reduce((layout, panel) => closed(layout, panel), usualLayout());
    expect(panelsOf(none)).toEqual([]);
    expect(where(revealed(none, "game"))).toEqual(["", "game", ""]);
    expect(where(revealed(shifted(closed(gone, "localization"), "robots", "left"), "game"))).toEqual(["robots+game", "", ""]);
  });

  it("has one panel large, until that is closed", () => {
    const large = enlarged(usualLayout(), "game");
    expect(large.large).toBe("game");
    expect(shifted(large, "game", "left").large).toBe("game");
    expect(closed(large, "game").large).toBeNull();
    expect(enlarged(closed(usualLayout(), "game"), "game").large).toBe("game");
    expect(enlarged(large, null).large).toBeNull();
  });

  it("shares an area between neighbours within bounds", () => {
    const two = shifted(usualLayout(), "game", "down");
    const shares = (part: number) => shared(two, "right", 0, part).groups.right.map(({ share }) => share);
    expect(shares(0.25)).toEqual([50, 150]);
    expect(shares(-3)).toEqual([10, 190]);
    expect(shares(7)).toEqual([190, 10]);
    expect(shared(two, "right", 1, 0.5)).toBe(two);
    expect(resized(two, "left", 1e9).sizes.left).toBe(900);
  });

  it("is one group where there is no room for more", () => {
    const layout = shifted(shifted(usualLayout(), "game", "left"), "robots", "bottom");
    expect(oneGroup(layout, "robots")).toMatchObject({ panels: ["game", "sensors", "localization", "robots"], shown: 3 });
    expect(oneGroup(layout, "nothing").shown).toBe(0);
  });

  it("never has more panels than a page can bear", () => {
    let layout = usualLayout();
    for (let i = 0; i < 40; ++i) layout = takenOut(layout, [curve(`a/b/c ${i}`)], { area: "bottom", before: 0 });
    expect(panelsOf(layout).length).toBe(kMostPanels);
    expect(placeOf(layout, panelOf([curve("a/b/c 39")]))).toBeNull();
  });
});

describe("curves that were taken out", () => {
  it("have a panel, join others of their unit, and are in one panel only", () => {
    const [a, b, c] = [curve("error distance"), curve("apart blue"), curve("error heading", "°")];
    let layout = takenOut(takenOut(usualLayout(), [a], { area: "bottom", before: 0 }), [b], { area: "bottom", before: 1 });
    expect(layout.groups.bottom.map(({ panels }) => panels)).toEqual([[panelOf([a])], [panelOf([b])]]);
    expect(canJoin(panelOf([a]), [c])).toBe(false);
    expect(joined(layout, [c], panelOf([a]))).toBe(layout);
    layout = joined(layout, [b], panelOf([a]));
    expect(layout.groups.bottom.map(({ panels }) => panels)).toEqual([[panelOf([a, b])]]);
    expect([...keysOut(layout)]).toEqual([a.key, b.key]);
    layout = takenOut(layout, [a], { area: "left", before: 0 });
    expect(layout.groups.left[0]!.panels).toEqual([panelOf([a])]);
    expect(layout.groups.bottom[0]!.panels).toEqual([panelOf([b])]);
    expect(keysOut(closed(layout, panelOf([a])))).toEqual(new Set([b.key]));
  });

  it("are named, and read back or refused", () => {
    for (const key of kKeys) expect(curvesOf(panelOf([curve(key, "°")]))).toEqual([curve(key, "°")]);
    expect(curvesOf(panelOf(kKeys.map((key) => curve(key))))).toHaveLength(kKeys.length);
    const many = Array.from({ length: kMostCurves + 1 }, (_, i) => curve(`a${i}`));
    const wrong = ["robots", "curves:", "curves:a", "curves:a\tm\tn", "curves:\tm", "curves: a\tm", "curves:a\tm\na\tm",
      `curves:${"a".repeat(201)}\tm`, `curves:a\t${"m".repeat(13)}`, "curves:a\u0007\tm", panelOf(many)];
    for (const panel of wrong) expect(curvesOf(panel), JSON.stringify(panel)).toBeNull();
    expect(kKeys.slice(0, 3).map(nameOfKey)).toEqual(["error", "heading error", "180DegreeScan nearest"]);
  });
});

describe("the text of a layout", () => {
  it("is short and needs no escapes in an address", () => {
    const text = writeArrangement({ layout: usualLayout(), layers: null, views: [] });
    expect(text).toBe("1*s372.372.230*r100o0.robots.sensors.localization.game");
    expect(new URLSearchParams({ layout: text }).toString()).toBe(`layout=${text}`);
  });

  it("says what any layout is: written and read it is the same", () => {
    const next = chance(7);
    let layout = usualLayout();
    for (let i = 0; i < 1500; ++i) {
      if (i % 50 === 0) layout = usualLayout();
      layout = step(layout, next);
      checkSound(layout);
      const arranged = { layout, layers: next() < 0.5 ? null : ["names", "rays"], views: next() < 0.5 ? [] : ["3d"] };
      const text = writeArrangement(arranged);
      expect(readArrangement(text)).toEqual(arranged);
      expect(new URLSearchParams({ layout: text }).toString()).toBe(`layout=${text}`);
    }
  }, 60_000);

  it("is refused in words, whatever else it is", () => {
    const next = chance(11);
    const right = writeArrangement({
      layout: enlarged(takenOut(usualLayout(), [curve(kKeys[3]!)], { area: "left", before: 0 }), "game"), layers: ["names"], views: ["3d"],
    });
    const signs = "0123456789*._-abcorsmlv%/ <>\"'\u0000ü\ud800";
    for (let i = 0; i < 8000; ++i) {
      const letters = i % 2 ? [...right] : [];
      const changes = 1 + Math.floor(next() * (i % 2 ? 4 : 60));
      for (let k = 0; k < changes; ++k) {
        const at = Math.floor(next() * (letters.length + 1));
        letters.splice(at, Math.floor(next() * 2), signs[Math.floor(next() * signs.length)]!);
      }
      try {
        checkSound(readArrangement(letters.join("")).layout);
      } catch (error) {
        expect(error).toBeInstanceOf(LayoutError);
      }
    }
  }, 60_000);

  it("of another version, or of panels that are unknown, is said to be so", () => {
    const fails = (text: string) => {
      try {
        return readArrangement(text);
      } catch (error) {
        return (error as Error).message;
      }
    };
    expect(fails("")).toMatch(/another version \(none\)/);
    expect(fails("2*s1.2.3")).toMatch(/another version \(2\)/);
    expect(fails("1*s372.372.230*r100o0.robots.weather")).toMatch(/unknown/);
    expect(fails("1*s372.372.230*r100o0.robots*a100o0.robots")).toMatch(/twice/);
    expect(fails("1*s372.372.230*r100o0.robots*r100o0.game")).toMatch(/twice/);
    const twice = (unit: string) => `curves-3Aerror-09${unit}`;
    expect(fails(`1*s372.372.230*r100o0.${twice("m")}.${twice("s")}`)).toMatch(/curve twice/);
    expect(fails("1*s372.372*r100o0.robots")).toMatch(/three sizes/);
    expect(fails("1*s372.99999.230*r100o0.robots")).toMatch(/size of right/);
    expect(fails("1*s372.372.230*r100o1.robots")).toMatch(/tab/);
    expect(fails("1*s372.372.230*r100o0")).toMatch(/no panels/);
    expect(fails("1*s372.372.230*mgame*r100o0.robots")).toMatch(/large/);
    expect(fails("1*s372.372.230*l<script>")).toMatch(/no words/);
    expect(fails("1*s372.372.230*q1")).toMatch(/unknown/);
    expect(fails(`1*s372.372.230*r100o0.robots*v${"a".repeat(9000)}`)).toMatch(/signs/);
  });
});
