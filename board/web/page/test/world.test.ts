import { describe, expect, it } from "vitest";
import { Board } from "../src/model/Board";
import { isPitch, parseDrawing } from "../src/model/world";

describe("what stands on the field", () => {
  const head = "open x_min_m=-1 y_min_m=2 step_m=0.5 columns=4 rows=2";

  it("has a picture of a building's free floor, in pieces", () => {
    const { floor } = parseDrawing([`${head} from=0 1,2`, `${head} from=5 0,1,1,1`]);
    expect(floor).toMatchObject({ columns: 4, rows: 2, step: 0.5, x: -1, y: 2 });
    expect([...floor!.cells]).toEqual([1, 255, 255, 1, 1, 255, 1, 255]);
  });

  it("takes no picture that can't be one", () => {
    for (const line of [
      "open columns=1e9 rows=1e9 step_m=1 from=0 1", "open columns=2 rows=0 step_m=1 from=0 1",
      "open columns=2 rows=2 step_m=0 from=0 1", "open columns=1.5 rows=2 step_m=1 from=0 1", "open",
    ]) expect(parseDrawing([line]).floor).toBeNull();
    for (const runs of ["1,-2,3", "a,b", "1e99,1", "0,99999999"]) {
      expect(parseDrawing([`${head} from=0 ${runs}`]).floor!.cells.length).toBe(8);
    }
    expect([...parseDrawing([`${head} from=-3 0,2`]).floor!.cells]).toEqual(new Array(8).fill(1));
  });

  it("has what is no wall", () => {
    const { solids } = parseDrawing(["solid z0_m=0 z1_m=0.7 colour=brown 0,0 1,0 1,1", "solid z0_m=0 z1_m=1 0,0 1,0"]);
    expect(solids).toMatchObject([{ z0: 0, z1: 0.7, colour: "brown", points: [{ x: 0, y: 0 }, { x: 1, y: 0 }, { x: 1, y: 1 }] }]);
  });

  it("is a pitch where it has paint or goals, and only there is a game", () => {
    const office = parseDrawing(["wall x0_m=0 y0_m=0 x1_m=1 y1_m=0 z0_m=0 z1_m=1", `${head} from=0 0,8`]);
    const pitch = parseDrawing(["line x0_m=0 y0_m=0 x1_m=1 y1_m=0 width_m=0.1 colour=white"]);
    expect([isPitch(office), isPitch(pitch), isPitch(parseDrawing(["goal name=a dx_m=1 dy_m=1"]))]).toEqual([false, true, true]);
    const board = new Board();
    board.kind = "simulation";
    board.drawing = office;
    board.game = new Map([["phase", "free"], ["blue", "0"]]);
    expect(board.isGame).toBe(false);
    board.game.set("phase", "playing"); // a referee has begun one there
    expect(board.isGame).toBe(true);
    board.game.clear();
    board.drawing = pitch;
    expect(board.isGame).toBe(true);
    board.kind = "record";
    expect(board.isGame).toBe(false);
  });
});
