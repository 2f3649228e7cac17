import type { Drawing, FieldArc, World } from "../model/world";
import { paint } from "./palette";
import { fixed, make } from "./svg";

/** What stands still: floor, lines, walls, goals, landmarks. In metres of the field. */
export function drawGround(group: SVGGElement, world: World, drawing: Drawing): void {
  group.replaceChildren();
  // Of a record without a world the bounds are those of the way, and no edge that stands somewhere.
  const isPlace = world.kind !== "record" || drawing.landmarks.length > 0;
  if (isPlace && !drawing.lines.length && !drawing.walls.length && !drawing.floor) {
    make("rect", { ...box(world), class: "border" }, group);
  }
  for (const line of drawing.lines) {
    make(
      "line",
      { x1: line.x0, y1: line.y0, x2: line.x1, y2: line.y1, stroke: paint(line.colour), "stroke-width": line.width },
      group,
    );
  }
  for (const arc of drawing.arcs) drawArc(group, arc);
  for (const solid of drawing.solids) {
    const points = solid.points.map(({ x, y }) => `${fixed(x)},${fixed(y)}`).join(" ");
    make("polygon", { points, class: "solid", fill: paint(solid.colour) }, group);
  }
  for (const goal of drawing.goals) {
    const at = `translate(${goal.x} ${goal.y}) rotate(${(goal.theta * 180) / Math.PI})`;
    const area = { x: -goal.dx, y: -goal.dy, width: 2 * goal.dx, height: 2 * goal.dy };
    const element = make("rect", { ...area, transform: at, class: "goal", fill: paint(goal.colour) }, group);
    element.append(title(`${goal.name}, goal`));
  }
  for (const wall of drawing.walls) {
    const shape = { x1: wall.x0, y1: wall.y0, x2: wall.x1, y2: wall.y1 };
    make("line", { ...shape, class: wall.goal ? "wall of-goal" : "wall" }, group);
  }
  for (const mark of drawing.landmarks) {
    if (mark.kind === "goal") continue; // drawn as such
    const element = make("circle", { cx: mark.x, cy: mark.y, r: 0.1, class: "landmark" }, group);
    element.append(title(`${mark.kind} ${mark.id}`));
  }
}

function box(world: World) {
  return { x: world.min.x, y: world.min.y, width: world.max.x - world.min.x, height: world.max.y - world.min.y };
}

function title(text: string): SVGTitleElement {
  const element = make("title");
  element.textContent = text;
  return element;
}

function drawArc(group: SVGGElement, arc: FieldArc): void {
  const turn = Math.min(2 * Math.PI, Math.abs(arc.to - arc.from));
  const paintOf = { stroke: paint(arc.colour), "stroke-width": arc.width, fill: "none" };
  const at = `translate(${arc.x} ${arc.y}) rotate(${fixed((arc.angle * 180) / Math.PI)})`;
  if (turn > 2 * Math.PI - 1e-6) {
    make("ellipse", { rx: arc.rx, ry: arc.ry, transform: at, ...paintOf }, group);
    return;
  }
  const end = (angle: number) => `${fixed(arc.rx * Math.cos(angle), 4)} ${fixed(arc.ry * Math.sin(angle), 4)}`;
  const isLarge = turn > Math.PI ? 1 : 0;
  const isLeft = arc.to > arc.from ? 1 : 0;
  const d = `M${end(arc.from)}A${arc.rx} ${arc.ry} 0 ${isLarge} ${isLeft} ${end(arc.to)}`;
  make("path", { d, transform: at, ...paintOf }, group);
}
