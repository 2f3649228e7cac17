import { numberOf, parseHead, type Head } from "../link/words";
import type { Point } from "./geometry";
import type { Heat } from "./maps";

/** What stands and lies on the field, as DESCRIBE world and DESCRIBE field tell. Lengths [m]. */
export interface FieldLine { x0: number; y0: number; x1: number; y1: number; width: number; colour: string }
export interface FieldArc {
  x: number; y: number; rx: number; ry: number; angle: number; from: number; to: number; width: number; colour: string;
}
export interface Wall { x0: number; y0: number; x1: number; y1: number; z0: number; z1: number; goal: boolean }
export interface Goal { name: string; x: number; y: number; theta: number; dx: number; dy: number; height: number; colour: string }
export interface Landmark { kind: string; id: string; x: number; y: number; z: number }
export interface Solid { z0: number; z1: number; colour: string; points: Point[] }
export interface Drawing {
  lines: FieldLine[]; arcs: FieldArc[]; walls: Wall[]; goals: Goal[]; landmarks: Landmark[]; solids: Solid[];
  /** Where the floor of a building is free: 1 or 255 (free) a cell. */
  floor: Heat | null;
}

export interface MovableKind { name: string; kind: string; radius: number; height: number; colour: string }
export interface World {
  name: string;
  kind: string;
  cycle: number;
  min: Point;
  max: Point;
  objects: MovableKind[];
  /** Of a record [us]; both 0 else. */
  start: number;
  end: number;
}

export interface Outline { manipulator: string; state: string; z0: number; z1: number; colour: string; points: Point[] }

const kColour = /^(#[0-9a-f]{6}|[a-z]{3,20})$/i;

/** A colour that is safe to use as one, or what is given instead. */
export function colourOf(text: string | undefined, otherwise: string): string {
  return text !== undefined && kColour.test(text) ? text : otherwise;
}

export const emptyDrawing = (): Drawing => ({
  lines: [], arcs: [], walls: [], goals: [], landmarks: [], solids: [], floor: null,
});

/** Whether it is a field for a game: with paint or goals. A building has neither. */
export const isPitch = ({ lines, arcs, goals }: Drawing): boolean => lines.length + arcs.length + goals.length > 0;

const kMostCells = 1e6;

/** A piece of the picture of a free floor: runs of cells, in turn closed and open. */
function addFloor(drawing: Drawing, { words, keys }: Head): void {
  const get = (key: string) => numberOf(keys, key, 0);
  const [columns, rows, step] = [get("columns"), get("rows"), get("step_m")];
  const isPicture = Number.isInteger(columns) && Number.isInteger(rows) && columns > 0 && rows > 0 && columns * rows <= kMostCells && step > 0;
  if (!isPicture) return;
  drawing.floor ??= { columns, rows, step, x: get("x_min_m"), y: get("y_min_m"), cells: new Uint8Array(columns * rows).fill(1) };
  const { cells } = drawing.floor;
  let at = get("from");
  let isOpen = false;
  for (const run of (words[1] ?? "").split(",").map(Number)) {
    if (!Number.isInteger(run) || run < 0 || !Number.isInteger(at) || at < 0) return;
    if (isOpen) cells.fill(255, at, at + run);
    at += run;
    isOpen = !isOpen;
  }
}

export function parseWorld(lines: string[]): World {
  const first = parseHead(lines[0] ?? "").keys;
  const world: World = {
    name: first.get("world") ?? "?",
    kind: first.get("kind") ?? "?",
    cycle: numberOf(first, "cycle_s", 0.01),
    min: { x: numberOf(first, "x_min_m", -5), y: numberOf(first, "y_min_m", -5) },
    max: { x: numberOf(first, "x_max_m", 5), y: numberOf(first, "y_max_m", 5) },
    objects: [],
    start: numberOf(first, "start_us", 0),
    end: numberOf(first, "end_us", 0),
  };
  for (const line of lines.slice(1)) {
    const { keys } = parseHead(line);
    const name = keys.get("object");
    if (name === undefined) continue;
    const kind = keys.get("kind") ?? "object";
    world.objects.push({
      name,
      kind,
      radius: Math.abs(numberOf(keys, "radius_m", 0.11)),
      height: Math.abs(numberOf(keys, "height_m", 0.22)),
      colour: colourOf(keys.get("colour"), kind === "ball" ? "orange" : "grey"),
    });
  }
  return world;
}

export function parseDrawing(lines: string[]): Drawing {
  const drawing = emptyDrawing();
  for (const line of lines) {
    const { words, keys } = parseHead(line);
    const get = (key: string, otherwise = 0) => numberOf(keys, key, otherwise);
    switch (words[0]) {
      case "line":
        drawing.lines.push({
          x0: get("x0_m"), y0: get("y0_m"), x1: get("x1_m"), y1: get("y1_m"), width: get("width_m", 0.05),
          colour: colourOf(keys.get("colour"), "white"),
        });
        break;
      case "arc":
        drawing.arcs.push({
          x: get("x_m"), y: get("y_m"), rx: get("rx_m"), ry: get("ry_m"), angle: get("angle_rad"),
          from: get("from_rad"), to: get("to_rad", 2 * Math.PI), width: get("width_m", 0.05),
          colour: colourOf(keys.get("colour"), "white"),
        });
        break;
      case "wall":
        drawing.walls.push({
          x0: get("x0_m"), y0: get("y0_m"), x1: get("x1_m"), y1: get("y1_m"), z0: get("z0_m"), z1: get("z1_m", 0.5),
          goal: keys.get("goal") === "1",
        });
        break;
      case "goal":
        drawing.goals.push({
          name: keys.get("name") ?? words[1] ?? "goal", x: get("x_m"), y: get("y_m"), theta: get("theta_rad"),
          dx: get("dx_m"), dy: get("dy_m"), height: get("height_m", 1), colour: colourOf(keys.get("colour"), "grey"),
        });
        break;
      case "solid": {
        const outline = parseOutline(line);
        if (outline) drawing.solids.push({ ...outline, colour: outline.colour || "grey" });
        break;
      }
      case "open":
        addFloor(drawing, { words, keys });
        break;
      case "landmark":
        drawing.landmarks.push({
          kind: keys.get("kind") ?? "landmark", id: keys.get("id") ?? "", x: get("x_m"), y: get("y_m"), z: get("z_m"),
        });
        break;
      default:
        break; // kinds that are newer than this page
    }
  }
  return drawing;
}

export function parseOutline(line: string): Outline | null {
  const { words, keys } = parseHead(line);
  const points: Point[] = [];
  for (const word of words.slice(1)) {
    const [x, y] = word.split(",").map(Number);
    if (Number.isFinite(x) && Number.isFinite(y)) points.push({ x: x!, y: y! });
  }
  if (points.length < 3) return null;
  return {
    manipulator: keys.get("manipulator") ?? "",
    state: keys.get("state") ?? "",
    z0: numberOf(keys, "z0_m", 0),
    z1: numberOf(keys, "z1_m", 0.3),
    colour: colourOf(keys.get("colour"), ""),
    points,
  };
}
