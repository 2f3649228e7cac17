import { gzipSync } from "node:zlib";
import { describe, expect, it } from "vitest";
import { KeptMaps } from "../src/link/KeptMaps";
import { parseHead } from "../src/link/words";
import { History, valueAt } from "../src/model/History";
import { parseMap, parseWhy } from "../src/model/Insight";
import { bestOf, momentAt, type Moment, type Way } from "../src/model/moments";
import { contentsOf, wayOf } from "../src/model/Past";

const kSecond = 1e6;
/** Along x at 1 m/s, @p y beside it, for ten seconds. */
const drive = (y: number): Moment[] =>
  Array.from({ length: 11 }, (_, i) => ({ stamp: i * kSecond, x: i, y, theta: 0 })).map((one) => ({ ...one, x: one.x * 0.5 }));
const way = (estimate: Moment[], truth: Moment[] = []): Way => ({ truth, estimate, odometry: [] });

describe("all of a record", () => {
  it("is known at any time between its moments, and at no other", () => {
    const moments = drive(2);
    expect(momentAt(moments, 2.5 * kSecond)).toEqual({ x: 1.25, y: 2, theta: 0 });
    expect(momentAt(moments, 3 * kSecond)).toMatchObject({ x: 1.5, y: 2 });
    expect(momentAt(moments, -1)).toBeNull();
    expect(momentAt(moments, 11 * kSecond)).toBeNull();
    expect(momentAt([moments[0]!, moments[9]!], 4 * kSecond)).toBeNull(); // 9 s apart
    expect(momentAt([], 0)).toBeNull();
  });

  it("tells poses of each kind apart, and takes the best", () => {
    const words = Uint32Array.from([2 ** 31 + 1000, 2 ** 31, 18000]);
    const fix = Uint32Array.from([2 ** 31 + 2000, 2 ** 31, 18000, 0, 0, 0, 10000, 10000, 10000]);
    const found = wayOf([
      { stamp: 1, feature: "odometry/odometry/pose", words },
      { stamp: 2, feature: "mcl/LOCALIZATION/pose", words: fix },
      { stamp: 3, feature: "a/LRF/b", words },
      { stamp: 4, feature: "mcl/LOCALIZATION/pose", words: new Uint32Array() },
    ]);
    expect([found.truth.length, found.estimate.length, found.odometry.length]).toEqual([0, 1, 1]);
    expect(bestOf(found)).toMatchObject([{ stamp: 2, x: 2, y: 0 }]);
  });

  it("has contents with numbers, whatever else stands there", () => {
    expect(contentsOf(["a/b/c readings=7 first_us=1 last_us=9 new=x", ""])).toEqual([
      { feature: "a/b/c", readings: 7, first: 1, last: 9 },
    ]);
  });

  it("gives the distance of two runs, and of a run from the truth, over all time", () => {
    const history = new History();
    history.takeWays(way(drive(2), drive(2.25)), new Map([["other", way(drive(5))]]));
    expect([...history.series.keys()]).toEqual(["error distance", "error heading", "apart other"]);
    const error = history.series.get("error distance")!;
    expect(error.times).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    for (const value of error.values) expect(value).toBeCloseTo(0.25, 12);
    for (const value of history.series.get("apart other")!.values) expect(value).toBeCloseTo(3, 12);
    history.takeWays(way(drive(2)), new Map()); // another run, without truth
    expect([...history.series.keys()]).toEqual([]);
  });

  it("reads a series at the time that is looked at", () => {
    const series = { key: "", label: "", unit: "", times: [1, 2, 5], values: [10, 20, 50] };
    expect([0, 1, 4.9, 5, 9].map((time) => valueAt(series, time))).toEqual([undefined, 10, 20, 50, 50]);
  });
});

describe("maps within a page", () => {
  const map = { feature: "", scale: "linear", stamp: 5, columns: 2, rows: 1, x_min_m: 0, y_min_m: 0, step_m: 1, low: 0, high: 1, readings: 3 };
  const place = (x: number, p: number) => ({ x, y: 0, theta: 9000, p, ps: [p], expected: [[1500, "inf"]] });
  const moment = (cells: number[]) => ({
    maps: [{ ...map, bytes: Buffer.from(cells).toString("base64") }],
    why: { features: [{ name: "a/b/scan", measured: [2000, null], angles: [0, 0] }], places: [place(0, 0.5), place(4000, 0.25)] },
  });
  const packed = (us: number, cells: number[]) => ({ us, data: gzipSync(JSON.stringify(moment(cells))).toString("base64") });
  const unpack = async (base64: string) => {
    const { gunzipSync } = await import("node:zlib");
    return gunzipSync(Buffer.from(base64, "base64")).toString();
  };
  const kept = new KeptMaps([packed(0, [1, 255]), packed(8 * kSecond, [255, 1])], unpack);

  const ask = async (kind: "map" | "why", time: number, line: string) => {
    const answer = await kept[kind](time, parseHead(line), 1);
    if ("error" in answer) return { error: answer.error };
    const { words, keys } = parseHead(answer.words);
    return { reply: { command: "", words, keys, lines: answer.lines ?? [], bytes: answer.bytes ?? null } };
  };

  it("are those of the moment that is next to the time", async () => {
    for (const [time, cells, at] of [[0, [1, 255], 0], [3.9e6, [1, 255], 0], [4.1e6, [255, 1], 8e6], [99e6, [255, 1], 8e6]] as const) {
      const { reply } = await ask("map", time, "cells=40000");
      const { heat, stamp } = parseMap(reply!);
      expect([[...heat.cells], stamp]).toEqual([cells, at]);
    }
  });

  it("tell why at the place that is next, and say which one that is", async () => {
    const { reply } = await ask("why", 0, "x_m=3 y_m=1 theta_deg=0");
    const why = parseWhy(reply!, { x: 3, y: 1, theta: 0 });
    expect(why.pose.x).toBe(4);
    expect(why.pose.theta).toBeCloseTo(Math.PI / 2, 9);
    expect(why.p).toBe(0.25);
    expect(why.features[0]!.values).toEqual([
      { index: 0, unit: "m", measured: 2, expected: 1.5 },
      { index: 1, unit: "m", measured: null, expected: Infinity },
    ]);
  });

  it("say what they are not", async () => {
    expect((await ask("map", 0, "theta_deg=3")).error).toMatch(/most probable heading alone/);
    expect((await ask("map", 0, "a/b/c d/e/f")).error).toMatch(/of all features, and of each/);
    expect((await ask("map", 0, "a/b/none")).error).toMatch(/no map of a\/b\/none/);
    expect((await ask("why", 0, "x_m=no")).error).toMatch(/^syntax/);
  });
});
