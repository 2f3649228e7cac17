import type { Board, MovableState } from "../model/Board";
import { changesOf, placesOf, type Protection } from "../model/decode";
import { degrees, ellipseOf, type Pose } from "../model/geometry";
import { bestOf, kJump, type Moment } from "../model/moments";
import type { Robot } from "../model/Robot";
import type { MovableKind, Outline } from "../model/world";
import type { Layers } from "../ui/layers";
import { drawGround } from "./Ground";
import { paint, robotColour } from "./palette";
import { fixed, make, set } from "./svg";
import type { View } from "./View";

/** Of names [pixels]. */
const kHalfLetter = 3.8;
const kLine = 14;

interface Drawn {
  group: SVGGElement;
  parts: { element: SVGElement; outline: Outline }[];
  label: SVGTextElement;
  trail: SVGPolylineElement;
  /** All of a record. */
  way: SVGPathElement;
  /** What it is called for screen readers, newest. */
  spoken: string;
}

/** Robots, ball, lines, estimates as SVG: what has a name, for eyes, hands and screen readers. */
export class Scene {
  private readonly ground: SVGGElement;
  private readonly changes: SVGGElement;
  private readonly ways: SVGGElement;
  private readonly trails: SVGGElement;
  private readonly beliefs: SVGGElement;
  private readonly movers: SVGGElement;
  private readonly labels: SVGGElement;
  private readonly robots = new Map<number, Drawn>();
  private readonly objects = new Map<string, Drawn>();
  private scene = -1;
  /** The words that the changes were drawn from. */
  private drawn: Uint32Array | null = null;

  constructor(
    readonly svg: SVGSVGElement,
    private readonly board: Board,
    private readonly only: number | null = null,
  ) {
    svg.replaceChildren();
    this.ground = make("g", { "aria-hidden": "true" }, svg);
    this.changes = make("g", { "aria-hidden": "true" }, svg);
    this.ways = make("g", { "aria-hidden": "true" }, svg);
    this.trails = make("g", { "aria-hidden": "true" }, svg);
    this.beliefs = make("g", { "aria-hidden": "true" }, svg);
    this.movers = make("g", {}, svg);
    this.labels = make("g", { "aria-hidden": "true", class: "labels" }, svg);
  }

  private get shown(): Robot[] {
    return [...this.board.robots.values()].filter(({ number }) => this.only === null || number === this.only);
  }

  /** The robot whose belief is drawn. */
  private get robot(): Robot | null {
    return this.only === null ? this.board.robot : (this.board.robots.get(this.only) ?? null);
  }

  draw(view: View, layers: Layers, held: Map<string, Pose>): void {
    const { board } = this;
    if (this.scene !== board.scene) this.rebuild();
    for (const group of [this.ground, this.changes, this.ways, this.trails, this.beliefs, this.movers]) set(group, "transform", view.matrix);
    for (const robot of this.shown) this.drawRobot(robot, view, layers, held.get(`robot=${robot.number}`));
    if (layers.names) this.spreadNames();
    for (const object of board.objects) this.drawObject(object, view, held.get(`object=${object.name}`));
    this.drawChanges(layers);
    this.drawBeliefs(view, layers);
    set(this.labels, "visibility", layers.names ? "visible" : "hidden");
    set(this.ways, "visibility", layers.way ? "visible" : "hidden");
    set(this.trails, "visibility", layers.trails ? "visible" : "hidden");
  }

  private rebuild(): void {
    const { board } = this;
    this.scene = board.scene;
    if (board.world) drawGround(this.ground, board.world, board.drawing);
    // Who has the focus keeps it: elements of robots that stay are not made anew.
    for (const [number, drawn] of [...this.robots]) {
      if (board.robots.has(number)) continue;
      this.drop(drawn);
      this.robots.delete(number);
    }
    for (const robot of this.shown) this.buildRobot(robot);
    for (const drawn of this.objects.values()) this.drop(drawn);
    this.objects.clear();
    for (const object of board.world?.objects ?? []) this.buildObject(object);
  }

  private drop({ group, label, trail, way }: Drawn): void {
    group.remove();
    way.remove();
    label.remove();
    trail.remove();
  }

  private start(name: string, attributes: Record<string, string>): Drawn {
    const group = make("g", { role: "img", tabindex: "0", "aria-label": name, visibility: "hidden", ...attributes }, this.movers);
    const label = make("text", { class: "name" }, this.labels);
    label.textContent = name;
    return { group, parts: [], label, trail: make("polyline", { class: "trail" }, this.trails), way: make("path", { class: "way" }, this.ways), spoken: name };
  }

  private buildRobot(robot: Robot): void {
    const { number } = robot;
    let drawn = this.robots.get(number);
    if (!drawn) {
      drawn = this.start(robot.label, { class: "robot", "data-robot": String(number) });
      this.robots.set(number, drawn);
    }
    const { group } = drawn;
    const isRun = this.board.kind === "record";
    const team = robotColour(robot, isRun);
    drawn.label.textContent = robot.label;
    set(drawn.trail, "stroke", team);
    set(drawn.way, "stroke", team);
    set(drawn.way, "d", robot.way ? pathOf(bestOf(robot.way)) : "");
    group.replaceChildren();
    drawn.parts = [];
    const reach = Math.max(robot.radius, 0.12);
    make("circle", { r: reach * 1.35, class: "halo" }, group);
    for (const outline of robot.outlines) {
      const points = outline.points.map(({ x, y }) => `${fixed(x)},${fixed(y)}`).join(" ");
      const kind = outline.manipulator ? "body part" : "body";
      drawn.parts.push({ element: make("polygon", { points, class: kind, fill: robotColour(robot, isRun, isRun ? "" : outline.colour) }, group), outline });
    }
    if (!robot.outlines.length) make("circle", { r: robot.radius, class: "body", fill: team }, group);
    const tip = fixed(reach * 0.62);
    const back = fixed(-reach * 0.3);
    const side = fixed(reach * 0.34);
    make("path", { d: `M${tip} 0L${back} ${side}L${fixed(-reach * 0.08)} 0L${back} -${side}Z`, class: "heading" }, group);
  }

  private buildObject(object: MovableKind): void {
    const drawn = this.start(object.name, { class: "object", "data-object": object.name });
    this.objects.set(object.name, drawn);
    make("circle", { r: Math.max(object.radius * 2, 0.2), class: "halo" }, drawn.group);
    make("circle", { r: object.radius, class: "body", fill: paint(object.colour) }, drawn.group);
    drawn.label.textContent = "";
  }

  private move(drawn: Drawn, pose: Pose, name: string): void {
    set(drawn.group, "transform", `translate(${fixed(pose.x)} ${fixed(pose.y)}) rotate(${fixed(degrees(pose.theta), 1)})`);
    if (drawn.group.getAttribute("visibility") === "hidden") drawn.group.setAttribute("visibility", "visible");
    drawn.spoken = `${name} at ${pose.x.toFixed(1)}, ${pose.y.toFixed(1)}`;
  }

  /** Tells screen readers where everything is; not each frame, since that costs them time. */
  speak(): void {
    for (const { group, spoken } of [...this.robots.values(), ...this.objects.values()]) set(group, "aria-label", spoken);
  }

  private drawRobot(robot: Robot, view: View, layers: Layers, held: Pose | undefined): void {
    const drawn = this.robots.get(robot.number);
    const pose = held ?? robot.pose;
    if (!drawn || !pose) return;
    const isSelected = this.board.selected === robot.number;
    this.move(drawn, pose, robot.label);
    set(drawn.group, "class", isSelected ? "robot selected" : "robot");
    for (const { element, outline } of drawn.parts) {
      if (outline.manipulator) set(element, "visibility", robot.shows(outline) ? "inherit" : "hidden");
    }
    if (layers.names) {
      const at = view.toPixel(pose);
      set(drawn.label, "x", fixed(at.x, 0));
      set(drawn.label, "y", fixed(at.y - robot.radius * view.scale - 7, 0));
    }
    if (layers.trails) {
      const points = robot.trail.map(({ x, y }) => `${fixed(x, 2)},${fixed(y, 2)}`);
      if (drawn.trail.dataset.count !== String(points.length) || points.length === 400) {
        drawn.trail.dataset.count = String(points.length);
        drawn.trail.setAttribute("points", points.join(" "));
      }
    }
  }

  /** Names that would lie upon others stand above them. */
  private spreadNames(): void {
    const placed: { x: number; y: number; half: number }[] = [];
    for (const { label } of this.robots.values()) {
      const x = Number(label.getAttribute("x"));
      let y = Number(label.getAttribute("y"));
      const half = (label.textContent?.length ?? 0) * kHalfLetter;
      const isCovered = () => placed.some((one) => Math.abs(one.x - x) < one.half + half && Math.abs(one.y - y) < kLine);
      for (let i = 0; i < placed.length && isCovered(); ++i) y -= kLine;
      placed.push({ x, y, half });
      set(label, "y", fixed(y, 0));
    }
  }

  private drawObject(object: MovableState, view: View, held: Pose | undefined): void {
    const drawn = this.objects.get(object.name);
    if (!drawn) return;
    const pose = held ?? object;
    this.move(drawn, pose, object.name);
    // A ball in the air is larger, so one sees that it is above.
    const radius = this.board.world?.objects.find(({ name }) => name === object.name)?.radius ?? 0.11;
    const height = Math.max(0, object.z);
    const body = drawn.group.lastElementChild!;
    set(body, "r", fixed(Math.max(radius * (1 + Math.min(1.5, height)), 3 / view.scale)));
  }

  /** Squares where the selected robot is sure that the map no longer fits; they change seldom. */
  private drawChanges(layers: Layers): void {
    const words = (layers.changes && this.robot?.heldOf("changes")?.words) || null;
    if (words === this.drawn) return;
    this.drawn = words;
    this.changes.replaceChildren();
    const found = words && changesOf(words);
    if (!found) return;
    const side = fixed(found.cell);
    for (const isNew of [false, true]) {
      const cells = found.cells.filter((cell) => cell.isSure && cell.isNew === isNew);
      const squares = cells.map(({ x, y }) => `M${fixed(x - found.cell / 2)} ${fixed(y - found.cell / 2)}h${side}v${side}h-${side}z`);
      if (squares.length) make("path", { d: squares.join(""), class: isNew ? "fresh" : "gone" }, this.changes);
    }
  }

  private drawBeliefs(view: View, layers: Layers): void {
    const { robot } = this;
    this.beliefs.replaceChildren();
    if (!robot) return;
    if (layers.ghost && robot.ghost) this.outlineAt(robot, robot.ghost, "ghost");
    if (layers.places) {
      const held = robot.heldOf("clusters");
      for (const place of held ? placesOf(held.words).reverse() : []) {
        const ellipse = ellipseOf(place.sigmaX ** 2, place.xy, place.sigmaY ** 2);
        const at = `translate(${fixed(place.x)} ${fixed(place.y)}) rotate(${fixed(degrees(ellipse.angle), 1)})`;
        const least = 2 / view.scale;
        const size = { rx: fixed(Math.max(least, 2 * ellipse.major)), ry: fixed(Math.max(least, 2 * ellipse.minor)) };
        make("ellipse", { ...size, transform: at, class: "place", opacity: fixed(0.35 + 0.65 * place.share, 2) }, this.beliefs);
      }
    }
    if (layers.bound && robot.estimate) this.ringAt(robot.estimate, robot.protection);
    if (layers.estimate && robot.truth && robot.estimate) this.outlineAt(robot, robot.estimate, "estimate");
  }

  /** The ring that the robot's middle hardly ever leaves; none where nothing bounds the error. */
  private ringAt({ x, y }: Pose, bound: Protection | null): void {
    if (!bound || !Number.isFinite(bound.metres)) return;
    make("circle", { cx: fixed(x), cy: fixed(y), r: fixed(bound.metres), class: "bound" }, this.beliefs);
  }

  private outlineAt(robot: Robot, pose: Pose, kind: string): void {
    const at = `translate(${fixed(pose.x)} ${fixed(pose.y)}) rotate(${fixed(degrees(pose.theta), 1)})`;
    const r = fixed(robot.radius);
    make("path", { d: `M-${r} 0a${r} ${r} 0 1 0 ${fixed(2 * robot.radius)} 0a${r} ${r} 0 1 0 -${fixed(2 * robot.radius)} 0M0 0H${fixed(robot.radius * 1.5)}`, class: kind, transform: at }, this.beliefs);
  }
}

/** Nobody drives faster [m/s]. */
const kFastest = 3;

/** A line along poses; who was carried leaves a gap in it. */
function pathOf(moments: Moment[]): string {
  return moments
    .map(({ x, y, stamp }, i) => {
      const last = moments[i - 1];
      const isGap = !last || Math.hypot(x - last.x, y - last.y) > kJump + (kFastest * (stamp - last.stamp)) / 1e6;
      return `${isGap ? "M" : "L"}${fixed(x, 2)} ${fixed(y, 2)}`;
    })
    .join("");
}
