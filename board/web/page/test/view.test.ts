import { describe, expect, it } from "vitest";
import { Seen, View, niceLength } from "../src/field/View";
import { areApart, canBeApart } from "../src/ui/apart";
import { Board } from "../src/model/Board";
import { Robot } from "../src/model/Robot";
import { compose, ellipseOf, inverse, wrap } from "../src/model/geometry";

function viewOf(width: number, height: number): View {
  const view = new View();
  view.width = width;
  view.height = height;
  return view;
}

describe("a view of the field", () => {
  it("shows all of it, y upwards", () => {
    const view = viewOf(800, 600);
    view.fit({ x: -7, y: -5 }, { x: 7, y: 5 }, 0);
    expect(view.toPixel({ x: 0, y: 0 })).toEqual({ x: 400, y: 300 });
    expect(view.toPixel({ x: -7, y: 0 }).x).toBeCloseTo(0);
    expect(view.toPixel({ x: 0, y: 5 }).y).toBeLessThan(300);
  });

  it("is the same for fields side by side", () => {
    const seen = new Seen();
    const [one, other] = [new View(seen), new View(seen)];
    one.width = other.width = 400;
    one.height = other.height = 300;
    one.zoom(2, { x: 100, y: 50 });
    other.pan(30, -20);
    expect(one.matrix).toBe(other.matrix);
    expect(other.isFree).toBe(true);
    expect(new View().isFree).toBe(false);
  });

  it("has a field each for two to six records", () => {
    const board = new Board();
    const ui = { isOneField: false, is3d: false };
    const fill = (count: number) => (board.robots = new Map(Array.from({ length: count }, (_, i) => [i + 1, new Robot(i + 1)])));
    board.kind = "record";
    expect([1, 2, 6, 7].map((count) => (fill(count), canBeApart(board)))).toEqual([false, true, true, false]);
    fill(2);
    expect([areApart(board, ui), areApart(board, { ...ui, isOneField: true }), areApart(board, { ...ui, is3d: true })]).toEqual([true, false, false]);
    board.kind = "simulation";
    expect(areApart(board, ui)).toBe(false);
  });

  it("turns pixels into the field and back", () => {
    const view = viewOf(640, 480);
    view.fit({ x: 1, y: 2 }, { x: 4, y: 9 });
    const there = view.toField(view.toPixel({ x: 2.5, y: -3.25 }));
    expect(there.x).toBeCloseTo(2.5);
    expect(there.y).toBeCloseTo(-3.25);
  });

  it("keeps the place under the mouse when it grows", () => {
    const view = viewOf(640, 480);
    const before = view.toField({ x: 100, y: 50 });
    view.zoom(3, { x: 100, y: 50 });
    expect(view.toField({ x: 100, y: 50 }).x).toBeCloseTo(before.x);
    expect(view.toField({ x: 100, y: 50 }).y).toBeCloseTo(before.y);
  });

  it("moves with the hand", () => {
    const view = viewOf(640, 480);
    const held = view.toField({ x: 10, y: 20 });
    view.pan(30, -40);
    expect(view.toField({ x: 40, y: -20 }).x).toBeCloseTo(held.x);
    expect(view.toField({ x: 40, y: -20 }).y).toBeCloseTo(held.y);
  });

  it("has a scale of 1, 2 or 5", () => {
    expect(niceLength(60, 110)).toBe(1);
    expect(niceLength(40, 110)).toBe(2);
    expect(niceLength(1000, 60)).toBeCloseTo(0.05);
  });
});

describe("geometry", () => {
  it("leads back to the origin through the inverse", () => {
    const pose = { x: 1.5, y: -2, theta: 2.2 };
    const origin = compose(pose, inverse(pose));
    expect(Math.hypot(origin.x, origin.y, origin.theta)).toBeLessThan(1e-12);
  });

  it("wraps angles to (-pi, pi]", () => {
    expect(wrap(3 * Math.PI)).toBeCloseTo(Math.PI);
    expect(wrap(-Math.PI)).toBe(Math.PI);
    expect(wrap(-0.5)).toBeCloseTo(-0.5);
  });

  it("finds the axes of a covariance", () => {
    // Sigmas 3 and 1, turned by 30 degrees: R diag(9, 1) R'.
    const turn = Math.PI / 6;
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    const { major, minor, angle } = ellipseOf(9 * c * c + s * s, 8 * c * s, 9 * s * s + c * c);
    expect([major, minor, angle].map((value) => Number(value.toFixed(9)))).toEqual([3, 1, Number(turn.toFixed(9))]);
  });
});
