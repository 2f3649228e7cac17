import { describe, expect, it } from "vitest";
import { expectedOf, parseLocalize, parseMap, parseWhy } from "../src/model/Insight";
import type { Reply } from "../src/link/Connection";
import { parseHead } from "../src/link/words";

function reply(head: string, lines: string[] = [], bytes: Uint8Array | null = null): Reply {
  const { words, keys } = parseHead(head);
  return { command: words[0]!, words: words.slice(1), keys, lines, bytes };
}

describe("what the filter tells", () => {
  it("has the features with what they measured and should have", () => {
    const lines = [
      "a/b/scan p=0.25 values=2",
      "value a/b/scan 0 unit=m measured=2.5 expected=3",
      "value a/b/scan 1 unit=m measured=inf expected=inf",
      "a/b/post p=1 values=1",
      "value a/b/post 0 unit=rad",
    ];
    const why = parseWhy(reply("WHY robot=1 p=0.25 lines=5", lines), { x: 0, y: 0, theta: 0 });
    expect(why.features.map(({ feature, p }) => [feature, p])).toEqual([["a/b/scan", 0.25], ["a/b/post", 1]]);
    expect(why.features[0]!.values[1]).toEqual({ index: 1, unit: "m", measured: Infinity, expected: Infinity });
    expect(why.features[1]!.values[0]).toMatchObject({ measured: null, expected: null });
    expect([...expectedOf(why).get("a/b/scan")!]).toEqual([[0, 3]]);
  });

  it("has maps with as many cells as they say", () => {
    const keys = "columns=2 rows=1 x_min_m=-1 y_min_m=0 step_m=0.5 low=0 high=0.5";
    const map = parseMap(reply(`HEATMAP ${keys}`, [], new Uint8Array([0, 255])));
    expect(map).toMatchObject({ low: 0, high: 0.5, heat: { columns: 2, rows: 1, x: -1, step: 0.5 } });
    expect(() => parseMap(reply(`HEATMAP ${keys}`, [], new Uint8Array(3)))).toThrow(/another number of cells/);
    expect(() => parseMap(reply("HEATMAP columns=1e9 rows=1e9 step_m=1"))).toThrow(/another number of cells/);
  });

  it("says how far learning is", () => {
    expect(parseLocalize(reply("LOCALIZE robot=1 state=learning progress=0.4 the scan"))).toEqual({
      state: "learning", progress: 0.4, text: "the scan",
    });
  });
});
