import { describe, expect, it } from "vitest";
import { Rays } from "../src/field/rays";
import { kLayerNames, type Layers } from "../src/ui/layers";
import { changesOf, fixOf, pictureOf, placesOf, protectionOf, statusOf } from "../src/model/decode";
import { parseFormat } from "../src/model/Format";
import { kindOf, type Kind } from "../src/model/kinds";
import { Robot } from "../src/model/Robot";
import { rowsOf } from "../src/model/rows";
import { parsePlayerKinds, scoresOf, parseHappenings } from "../src/model/soccer";
import { summary, valuesOf } from "../src/model/values";
import { parseDrawing, parseOutline, parseWorld } from "../src/model/world";

const kMiddle = 2 ** 31;
const kinded = (text: string): Kind => kindOf(parseFormat(text));
const kTrack = "track status=tracking,uncertain,lost reason=readings_fit,several_places_fit,no_reading_comes";

/** A line of each of the container's formats, and the kind that it makes. */
const kFormats: [string, object][] = [
  ["scan beams=180 first_deg=-90 step_deg=1.00558659 max_m=8",
    { name: "scan", first: -Math.PI / 2, step: (1.00558659 * Math.PI) / 180, most: 8 }],
  ["cone opening_deg=30 max_m=3", { name: "cone", half: expect.closeTo(Math.PI / 12), most: 3 }],
  ["range max_m=10", { name: "rows", of: "range", row: ["range_mm"] }],
  ["range", { name: "rows", of: "range" }],
  ["bearing", { name: "rows", of: "bearing", row: ["bearing_cdeg"] }],
  ["landmarks", { name: "rows", of: "landmarks", row: ["identity", "range_mm", "bearing_cdeg"] }],
  ["points", { name: "rows", of: "points", row: ["range_mm", "bearing_cdeg"] }],
  ["objects", { name: "rows", of: "objects", row: ["identity", "colour", "range_mm", "bearing_cdeg", "radius_mm"] }],
  ["obstacles", { name: "obstacles" }],
  ["fix", { name: "fix" }],
  ["pose", { name: "pose" }],
  ["odometry", { name: "odometry" }],
  ["image", { name: "image" }],
  ["image width=640 height=480", { name: "image" }],
  [kTrack, { name: "track", status: ["tracking", "uncertain", "lost"] }],
  ["clusters", { name: "clusters" }],
  ["protection", { name: "protection" }],
  ["changes", { name: "changes" }],
  ["work", { name: "work" }],
  ["samples", { name: "samples" }],
  ["device status=opening,absent", { name: "device", status: ["opening", "absent"] }],
  ["talk", { name: "other" }],
  ["places", { name: "other" }],
  ["radar row=identity,range_mm,speed", { name: "rows", of: "", row: ["identity", "range_mm", "other"] }],
  ["gas", { name: "other" }],
];

describe("formats", () => {
  it.each(kFormats)("%s", (line, kind) => expect(kinded(line)).toMatchObject(kind));

  it.each([
    "", " ", "scan", "Scan beams=1", "scan beams=1 first_deg=x step_deg=1 max_m=8", "scan first_deg=0 step_deg=1 max_m=0",
    "scan first_deg=0 step_deg=1 max_m=inf", "scan first_deg=0 step_deg=1 max_m=-1", "scan  first_deg=0 step_deg=1 max_m=8",
    "scan first_deg=0 first_deg=0 step_deg=1 max_m=8", "scan first_deg=0 step_deg=1 max_m", "scan first_deg= step_deg=1 max_m=8",
    "cone", "cone opening_deg=-1 max_m=3", "cone opening_deg=NaN max_m=3", "radar row=", "row=x_mm,y_mm", "radar row=\u{1f600}",
    `radar row=${"other,".repeat(200)}other`, `a${"b".repeat(64)}`, `radar ${Array.from({ length: 33 }, (_, i) => `k${i}=1`).join(" ")}`,
  ])("are none: '%s'", (line) => {
    expect(kinded(line)).toEqual({ name: "other" });
  });

  it("have no names beyond their own keys", () => {
    expect(kinded("__proto__ row=constructor,x_mm")).toEqual({ name: "rows", of: "", row: ["other", "x_mm"] });
  });

  it("say all: texts for people change nothing", () => {
    const described = (text: (i: number) => string) => {
      const robot = new Robot(1);
      const names = kFormats.map((_, i) => `model/type/f${i}`);
      robot.describe([
        ...names.map((name, i) => `${name} ${text(i)}`.trim()),
        ...names.map((name, i) => `format ${name} ${kFormats[i]![0]}`),
      ]);
      return robot.features.map(({ kind }) => kind);
    };
    const kinds = described(() => "");
    expect(kinds.map(({ name }) => name)).toEqual(kFormats.map(([, kind]) => (kind as Kind).name));
    expect(described((i) => kFormats[(i + 1) % kFormats.length]![0])).toEqual(kinds);
    expect(described(() => "[distance mm] of each of 9 beams from 0 deg in steps of 1 deg; 0: not valid; from 9 on")).toEqual(kinds);
    expect(described(() => "format model/type/f0 landmarks")).toEqual(kinds);
  });

  it("may come before their features, and for features that are not there", () => {
    const robot = new Robot(1);
    robot.describe(["format a/b/c landmarks", "format a/b/none scan", "format", "format a/b/c", "format x y z", "a/b/c sees", "a/b/d"]);
    expect(robot.features.map(({ kind }) => kind.name)).toEqual(["other", "other"]); // the last line of a feature counts
    robot.describe(["format a/b/c landmarks", "a/b/c sees"]);
    expect(robot.features[0]!.kind).toMatchObject({ of: "landmarks" });
  });

  it("tell which feature is the localization's", () => {
    const robot = new Robot(1);
    expect(robot.protection).toBeNull();
    robot.describe(["x/y/how", `format x/y/how ${kTrack}`, "x/y/cloud", "format x/y/cloud samples", "x/y/bound", "format x/y/bound protection"]);
    expect(robot.protection).toBeNull();
    robot.readings.set("x/y/bound", { stamp: 0, words: new Uint32Array([2000000, 10000]) });
    expect(robot.protection!.metres).toBe(2);
    robot.readings.set("x/y/how", { stamp: 0, words: new Uint32Array([2, 1, 100, 5000]) });
    robot.readings.set("x/y/cloud", { stamp: 0, words: new Uint32Array(8) });
    expect(robot.status).toMatchObject({ status: "lost", reason: "several places fit", quality: 0.01, share: 0.5, relocalizations: null });
    expect(robot.heldOf("samples")!.words).toHaveLength(8);
    expect(robot.heldOf("clusters")).toBeUndefined();
  });
});

describe("a plugin's own format", () => {
  const mount = { x: 1, y: 0, theta: 0 };
  const base = { x: 10, y: 5, theta: Math.PI / 2 };
  const layers = Object.fromEntries(kLayerNames.map((name) => [name, true])) as unknown as Layers;

  /** What is drawn of it: places of dots, beginnings and ends of lines. */
  function drawn(row: string, words: number[], expected: number[] = []) {
    const robot = new Robot(1);
    robot.describe(["a/b/c of my own", `format a/b/c mine row=${row}`, `mount a/b/c x_m=${mount.x} y_m=0 theta_rad=0`]);
    robot.setTruth(base, 0);
    robot.readings.set("a/b/c", { stamp: 0, words: new Uint32Array(words) });
    const rays = new Rays();
    rays.add(robot, layers, new Map([["a/b/c", new Map(expected.entries())]]));
    const points = (numbers: number[]) =>
      Array.from({ length: numbers.length / 6 }, (_, i) => [numbers[6 * i]!, numbers[6 * i + 1]!].map((n) => Number(n.toFixed(6))));
    return { dots: points(rays.dots), lines: points(rays.lines) };
  }

  it("shows what is expected, too, and lists words whose meaning nobody knows", () => {
    const kind = kinded("mine row=other,bearing_cdeg,range_mm");
    expect(valuesOf(kind, new Uint32Array([7, 9000, 1500])).map(({ name, value, unit }) => [name, value, unit])).toEqual([
      ["1 distance", 1.5, "m"], ["1 bearing", -90, "°"], ["1 word 0", 7, ""],
    ]);
    expect(drawn("other,bearing_cdeg,range_mm", [], [Math.PI / 2, 2]).dots).toEqual([[8, 6]]);
  });

  // The sensor is one metre before the robot, which looks along y.
  it("is sightings if it has ranges and bearings", () => {
    const two = drawn("identity,other,bearing_cdeg,range_mm", [7, 0, 18000, 2000, 8, 0, 27000, 500]);
    expect(two.dots).toEqual([[10, 8], [9.5, 6]]);
    expect(two.lines).toEqual([[10, 6], [10, 8], [10, 6], [9.5, 6]]);
    expect(drawn("range_mm,bearing_cdeg", [2000, 18000]).lines).toEqual([]);
  });

  it("is points in the frame of the robot if it has x and y", () => {
    expect(drawn("x_mm,y_mm,heading_cdeg", [kMiddle + 2000, kMiddle - 1000, 18000])).toEqual({ dots: [[11, 7]], lines: [] });
  });

  it("is a circle around the sensor if it has ranges alone, a ray if bearings", () => {
    const circle = drawn("range_mm", [2000]);
    expect(circle.dots).toEqual([]);
    for (const [x, y] of circle.lines) expect(Math.hypot(x! - 10, y! - 6)).toBeCloseTo(2);
    const ray = drawn("other,bearing_cdeg", [0, 9000]);
    expect(ray.lines[0]).toEqual([10, 6]);
    expect(ray.lines[1]![0]).toBeGreaterThan(12);
    expect(ray.lines[1]![1]).toBeCloseTo(6);
  });

  it("is nothing on the field if it says nothing of places, or a row is not complete", () => {
    expect(drawn("identity,other", [1, 2])).toEqual({ dots: [], lines: [] });
    expect(drawn("x_mm,heading_cdeg", [kMiddle, 18000])).toEqual({ dots: [], lines: [] });
    expect(drawn("identity,range_mm,bearing_cdeg", [1, 2000])).toEqual({ dots: [], lines: [] });
  });

  it("is numbers in metres and degrees", () => {
    const kind = kinded("mine row=identity,range_mm,bearing_cdeg,radius_mm,colour,other");
    const words = new Uint32Array([12, 2500, 9000, 110, 0xffa500, 77, 13, 1000, 18000, 0, 2 ** 24, 0]);
    expect(valuesOf(kind, words).slice(0, 5)).toEqual([
      { name: "12 distance", value: 2.5, unit: "m" }, { name: "12 radius", value: 0.11, unit: "m" },
      { name: "12 bearing", value: -90, unit: "°" }, { name: "12 word 0", value: 77, unit: "" }, { name: "13 distance", value: 1, unit: "m" },
    ]);
    expect(valuesOf(kind, words, 2)).toHaveLength(2);
    expect(summary(kind, words)).toBe("12: 2.50 m -90°, 13: 1.00 m 0°");
    expect(valuesOf(kinded("mine row=x_mm,y_mm,heading_cdeg"), new Uint32Array([kMiddle + 1, kMiddle, 18100]))).toEqual([
      { name: "1 x", value: 0.001, unit: "m" }, { name: "1 y", value: 0, unit: "m" },
      { name: "1 heading", value: expect.closeTo(1), unit: "°" },
    ]);
    expect(summary(kind, new Uint32Array())).toBe("nothing in sight");
  });
});

describe("readings of features", () => {
  it("are numbers with units", () => {
    const words = new Uint32Array([kMiddle + 1500, kMiddle - 250, 18000 + 9000, kMiddle - 500, kMiddle + 1000]);
    expect(valuesOf({ name: "odometry" }, words).map(({ value, unit }) => [value, unit])).toEqual([
      [1.5, "m"], [-0.25, "m"], [90, "°"], [-0.5, "m/s"], [10, "°/s"],
    ]);
    expect(valuesOf(kinded("bearing"), new Uint32Array([19550]))).toEqual([{ name: "bearing", value: expect.closeTo(15.5), unit: "°" }]);
    expect(valuesOf(kinded("objects"), new Uint32Array([0, 0, 1000, 18000, 50]))[0]!.name).toBe("1 distance");
    expect(valuesOf(kinded("landmarks"), new Uint32Array([0, 1000, 18000]))[0]!.name).toBe("0 distance");
  });

  it("are one line for people", () => {
    const line = (format: string, ...words: number[]) => summary(kinded(format), new Uint32Array(words));
    const scan = "scan beams=4 first_deg=0 step_deg=1 max_m=8";
    expect(line(scan, 0, 8000, 2500, 3000)).toBe("4 beams, 3 valid, nearest 2.50 m");
    expect(line(scan, 0, 8000)).toBe("2 beams, 1 valid");
    expect(line("cone opening_deg=30 max_m=3", 3000)).toBe("nothing within 3.00 m");
    expect(line("cone opening_deg=30 max_m=3", 0)).toBe("not valid");
    expect(line("range", 1250)).toBe("1.25 m");
    expect(line("range")).toBe("nothing in sight");
    expect(line("bearing", 16450)).toBe("-15.5°");
    expect(line("points", 1000, 18000, 1000, 18100, 1000, 18200, 1000, 18300)).toBe("1.00 m 0°, 1.00 m 1°, 1.00 m 2°, 1 more");
    expect(line("device status=opening,not_there", 1)).toBe("not there");
    expect(line("device", 1)).toBe("-");
    expect(line("gas", 1, 2, 3)).toBe("3 words: 1 2 3");
  });

  it("tell what was seen", () => {
    const rows = (format: string, ...words: number[]) => rowsOf(kinded(format) as Kind & { name: "rows" }, new Uint32Array(words));
    expect(rows("landmarks", 3, 2500, 9000)).toEqual([{ identity: 3, range: 2.5, bearing: -Math.PI / 2 }]);
    expect(rows("objects", 0, 0xffa500, 6411, 18000, 110, 1)).toEqual([
      { identity: 0, colour: "#ffa500", range: 6.411, bearing: 0, radius: 0.11 },
    ]);
    expect(rows("objects", 0, 2 ** 24, 1, 18000, 0)[0]!.colour).toBeUndefined();
  });

  it("have sigmas and correlations", () => {
    const fix = fixOf(new Uint32Array([kMiddle, kMiddle, 18000, 200000, 100000, 50000, 15000, 10000, 10000]))!;
    expect(fix).toMatchObject({ x: 0, theta: 0, sigmaX: 0.2, sigmaY: 0.1 });
    expect(fix.xy).toBeCloseTo(0.5 * 0.2 * 0.1);
    expect(placesOf(new Uint32Array([6000, kMiddle, kMiddle, 18000, 1, 1, 1, 10000, 10000, 10000, 5]))).toHaveLength(1);
  });

  it("say where the map no longer fits", () => {
    const changes = kinded("changes");
    const words = new Uint32Array([100, 0, 1, 2 ** 31 + 1500, 2 ** 31 - 250, 3, 1, 1, 1, 2 ** 31, 2 ** 31, 2, 0, 1, 0, 2 ** 31, 2 ** 31, 1, 0]);
    expect(changesOf(words)).toEqual({
      cell: 0.1,
      cells: [
        { x: 1.5, y: -0.25, isNew: false, isSure: true, passes: 3 },
        { x: 0, y: 0, isNew: true, isSure: true, passes: 2 },
        { x: 0, y: 0, isNew: true, isSure: false, passes: 1 },
      ],
    });
    expect(valuesOf(changes, words)).toMatchObject([
      { name: "walls gone", value: 1 },
      { name: "new", value: 1 },
    ]);
    expect(summary(changes, words)).toBe("1 cells of walls gone, 1 new, 1 not sure");
    expect(summary(changes, new Uint32Array([100]))).toBe("nothing");
    expect(changesOf(new Uint32Array())).toBeNull();
  });

  it("bound the error, or say that nothing does", () => {
    const bound = kinded("protection");
    const words = new Uint32Array([125000, 15000]);
    expect(protectionOf(words)).toEqual({ metres: expect.closeTo(0.125, 9), radians: expect.closeTo(1.5 * (Math.PI / 180), 9) });
    expect(valuesOf(bound, words)).toMatchObject([
      { name: "radius", value: expect.closeTo(0.125, 9), unit: "m" },
      { name: "angle", value: expect.closeTo(1.5, 9), unit: "°" },
    ]);
    expect(summary(bound, words)).toBe("0.13 m, 1.5°");
    const none = new Uint32Array([0xffffffff, 0xffffffff]);
    expect(protectionOf(none)).toEqual({ metres: Infinity, radians: Infinity });
    expect(valuesOf(bound, none)).toEqual([]);
    expect(summary(bound, none)).toBe("unbounded");
    expect(protectionOf(new Uint32Array([7]))).toBeNull();
    expect(summary(bound, new Uint32Array([7]))).toBe("-");
  });

  it("say the filter's status in words", () => {
    expect(statusOf(kinded(kTrack), new Uint32Array([1, 1, 4000, 5500]))).toMatchObject({
      status: "uncertain", reason: "several places fit", quality: 0.4, share: 0.55, relocalizations: null,
    });
    const told = statusOf(kinded(`${kTrack} cause=none,a_pose_was_given`), new Uint32Array([0, 0, 9000, 10000, 3, 1]));
    expect(told).toMatchObject({ relocalizations: 3, cause: "a pose was given" });
    expect(statusOf(kinded(kTrack), new Uint32Array([0, 0, 9000, 10000, 3, 7]))!.cause).toBe("cause 7");
    expect(summary(kinded(kTrack), new Uint32Array([2, 2, 100, 0]))).toBe("lost: no reading comes, 1 %");
    expect(summary(kinded(kTrack), new Uint32Array([3, 9, 100, 0]))).toBe("status 3: reason 9, 1 %");
    expect(summary(kinded(kTrack), new Uint32Array([2]))).toBe("-");
  });

  it("are pictures only if all of their pixels are there", () => {
    expect(pictureOf(new Uint32Array([2, 1, 3, 0x04030201, 0x0605]))?.pixels).toEqual(new Uint8Array([1, 2, 3, 4, 5, 6]));
    expect(pictureOf(new Uint32Array([2, 2, 3, 0, 0]))).toBeNull();
    expect(pictureOf(new Uint32Array([65535, 65535, 3]))).toBeNull();
    expect(pictureOf(new Uint32Array([2, 2]))).toBeNull();
  });
});

describe("descriptions", () => {
  it("tell where things are", () => {
    const world = parseWorld(["world=f2000 kind=simulation x_min_m=-7 y_min_m=-5 x_max_m=7 y_max_m=5 cycle_s=0.01", "object=ball kind=ball radius_m=0.1 colour=#ff8800"]);
    expect(world).toMatchObject({ name: "f2000", cycle: 0.01, min: { x: -7, y: -5 }, objects: [{ name: "ball", radius: 0.1, colour: "#ff8800" }] });
    const drawing = parseDrawing(["line x0_m=0 y0_m=-4 x1_m=0 y1_m=4 width_m=0.1", "wall x0_m=0 y0_m=0 x1_m=1 y1_m=0 goal=1", "hologram x_m=1"]);
    expect([drawing.lines.length, drawing.walls[0]!.goal]).toEqual([1, true]);
  });

  it("never become a colour that is none", () => {
    expect(parseWorld(["world=x", "object=a kind=b colour=url(//evil)"]).objects[0]!.colour).toBe("grey");
  });

  it("show the state of a manipulator", () => {
    const robot = new Robot(1);
    robot.describe([
      "LMS200/LRF/Scan ranges",
      "mount LMS200/LRF/Scan x_m=0.1 y_m=0 theta_rad=3.14",
      "manipulator kicker rest kick",
      "outline z0_m=0 z1_m=0.5 0,0 1,0 1,1",
      "outline manipulator=kicker state=kick z0_m=0 z1_m=0.1 0,0 2,0 2,1",
    ]);
    expect(robot.features[0]!.mount).toEqual({ x: 0.1, y: 0, theta: 3.14 });
    expect(robot.outlines.map((outline) => robot.shows(outline))).toEqual([true, false]);
    robot.states = 1;
    expect(robot.outlines.map((outline) => robot.shows(outline))).toEqual([true, true]);
    expect(parseOutline("outline 0,0 nan,1")).toBeNull();
  });

  it("keep where a robot was, between two moments, too", () => {
    const robot = new Robot(1);
    robot.setTruth({ x: 0, y: 0, theta: 3 }, 1000);
    robot.setTruth({ x: 0.4, y: 0.2, theta: -3 }, 2000);
    const middle = robot.truthAt(1500)!;
    expect([middle.x, middle.y, Math.abs(middle.theta)]).toEqual([0.2, 0.1, expect.closeTo(Math.PI)]);
    expect(robot.truthAt(2100, 50)).toBeNull();
    expect(robot.truthAt(2100)).toMatchObject({ x: 0.4 });
    robot.setTruth({ x: 5, y: 5, theta: 0 }, 500); // the time went back
    robot.setTruth({ x: -5, y: 5, theta: 0 }, 600); // it was carried away
    expect(robot.truthAt(580)).toMatchObject({ x: -5 });
    expect(robot.truthAt(0)).toMatchObject({ x: 5 });
  });

  it("give the options of players", () => {
    const [follow, keeper] = parsePlayerKinds([
      "player follow goes from point to point",
      "option follow waypoints_m unit=x1,y1,... in m where it goes",
      "player goalkeeper keeps a goal",
      "option goalkeeper policy unit=still|random how it moves; default: still",
      "option goalkeeper out unit=file the table file",
      "option goalkeeper threads what it learns does not depend on it; default: 1",
    ]);
    expect(follow!.options).toEqual([{ key: "waypoints_m", unit: "x1,y1,... in m", text: "where it goes" }]);
    expect(keeper!.options.map(({ key, unit }) => [key, unit])).toEqual([["policy", "still|random"], ["threads", ""]]);
  });

  it("give scores and what has happened", () => {
    const game = new Map(Object.entries({ phase: "playing", half: "1", clock_s: "3", blue: "2", yellow: "0", left: "blue" }));
    expect(scoresOf(game)).toEqual([{ team: "blue", score: "2" }, { team: "yellow", score: "0" }]);
    expect(scoresOf(new Map([["left", "1"], ["right", "2"]]))).toHaveLength(2);
    expect(parseHappenings(["3 4060000 ball-out blue: the ball left"])).toEqual([
      { number: 3, stamp: 4060000, what: "ball-out blue", text: "the ball left" },
    ]);
  });
});
