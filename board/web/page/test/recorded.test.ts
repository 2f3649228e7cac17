import { describe, expect, test } from "vitest";
import { gzipSync } from "node:zlib";
import { countUntil, matches, RecordedBoard, RecordedTime, truthWords } from "../src/link/RecordedBoard";
import { Robot } from "../src/model/Robot";

describe("a run within the page", () => {
  test("finds how far it is by halving", () => {
    const stamps = Float64Array.from([0, 10, 10, 25]);
    expect([-1, 0, 9, 10, 24, 25, 1e9].map((time) => countUntil(stamps, time))).toEqual([0, 1, 1, 3, 3, 4, 4]);
    expect(countUntil(new Float64Array(), 5)).toBe(0);
  });

  test("queries are of three whole names, or anything", () => {
    expect(matches([], "LMS200/LRF/Scan")).toBe(true);
    expect(matches(["*/LRF/*"], "LMS200/LRF/Scan")).toBe(true);
    expect(matches(["*/truth/*", "LMS200/*/Scan"], "LMS200/LRF/Scan")).toBe(true);
    expect(matches(["*/LR/*"], "LMS200/LRF/Scan")).toBe(false);
  });

  test("its robots are described as by a server, formats with them", async () => {
    const describe = ["laser/LRF/scan for people", "format laser/LRF/scan scan beams=2 first_deg=0 step_deg=90 max_m=8"];
    globalThis.WebSocket ??= { CONNECTING: 0, OPEN: 1, CLOSED: 3 } as unknown as typeof WebSocket;
    const readings = gzipSync("0 laser/LRF/scan 2 1000 2000\n").toString("base64");
    const board = new RecordedBoard(new RecordedTime({
      world: ["world=run"], field: [], truth: [], events: [], robots: [{ name: "run", describe, readings }], end_us: 1,
    }));
    const said = await new Promise<string>((resolve) => {
      board.onopen = () => board.send("#1 DESCRIBE robot robot=1\n");
      board.onmessage = ({ data }) => resolve(data as string);
    });
    board.close();
    const robot = new Robot(1);
    robot.describe(said.split("\n").slice(1));
    expect(robot.features.map(({ name, kind }) => [name, kind.name])).toEqual([["laser/LRF/scan", "scan"]]);
  });

  test("ground truth becomes a robot of the world: headings from 0 on", () => {
    // 90 and -90 degrees; those of a reading count from -180 on.
    expect(truthWords(2, "5 reference/groundTruth/pose 3 2147484148 2147482148 27000")).toBe(
      "2 2147484148 2147482148 9000 0",
    );
    expect(truthWords(1, "5 reference/groundTruth/pose 3 0 0 9000")).toBe("1 0 0 27000 0");
  });
});
