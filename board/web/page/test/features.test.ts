import { describe, expect, it } from "vitest";
import { fixOf, kindOf, pictureOf, placesOf, sightingsOf, statusOf, summary, valuesOf } from "../src/model/features";
import { parsePlayerKinds, scoresOf, parseHappenings } from "../src/model/soccer";
import { parseDrawing, parseOutline, parseWorld } from "../src/model/world";
import { Robot } from "../src/model/Robot";

const kMiddle = 2 ** 31;
const kScan =
  "[distance mm] of each of 180 beams from -90 deg in steps of 1.00558659 deg; 0: not valid; from 8000 on: nothing seen";

describe("readings of features", () => {
  it("are known by what the server says of their words", () => {
    const scan = kindOf("LMS200/LRF/180DegreeScan", kScan);
    expect(scan).toMatchObject({ name: "scan", most: 8 });
    expect(scan.name === "scan" && [scan.first, scan.step]).toEqual([-Math.PI / 2, (1.00558659 * Math.PI) / 180]);
    expect(kindOf("a/b/c", "[distance mm]; 0: not valid; from 3000 on: nothing seen")).toEqual({ name: "cone", most: 3 });
    expect(kindOf("a/b/c", "[distance mm], or none: looked and saw nothing").name).toBe("range");
    expect(kindOf("a/b/c", "something new").name).toBe("other");
  });

  it("are numbers with units", () => {
    const words = new Uint32Array([kMiddle + 1500, kMiddle - 250, 18000 + 9000, kMiddle - 500, kMiddle + 1000]);
    expect(valuesOf({ name: "odometry" }, words).map(({ value, unit }) => [value, unit])).toEqual([
      [1.5, "m"], [-0.25, "m"], [90, "°"], [-0.5, "m/s"], [10, "°/s"],
    ]);
  });

  it("tell what was seen", () => {
    const [post] = sightingsOf("landmarks", new Uint32Array([3, 2500, 9000]));
    expect(post).toMatchObject({ identity: 3, range: 2.5, bearing: -Math.PI / 2 });
    const [ball] = sightingsOf("objects", new Uint32Array([0, 0xffa500, 6411, 18000, 110]));
    expect(ball).toMatchObject({ colour: "#ffa500", range: 6.411, bearing: 0, radius: 0.11 });
  });

  it("have sigmas and correlations", () => {
    const fix = fixOf(new Uint32Array([kMiddle, kMiddle, 18000, 200000, 100000, 50000, 15000, 10000, 10000]))!;
    expect(fix).toMatchObject({ x: 0, theta: 0, sigmaX: 0.2, sigmaY: 0.1 });
    expect(fix.xy).toBeCloseTo(0.5 * 0.2 * 0.1);
    expect(placesOf(new Uint32Array([6000, kMiddle, kMiddle, 18000, 1, 1, 1, 10000, 10000, 10000, 5]))).toHaveLength(1);
  });

  it("say in words how sure the filter is", () => {
    expect(statusOf(new Uint32Array([1, 1, 4000, 5500]))).toEqual({
      status: "uncertain", reason: "several places fit", quality: 0.4, share: 0.55,
    });
    expect(summary({ name: "status" }, new Uint32Array([2, 3, 100, 0]))).toBe("lost: no reading comes, 1 %");
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
      `LMS200/LRF/Scan ${kScan}`,
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
