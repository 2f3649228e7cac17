import { degrees, type Point, type Pose } from "../model/geometry";
import type { Robot } from "../model/Robot";
import { isPitch } from "../model/world";
import type { Context } from "../ui/context";
import { Cloud } from "./Cloud";
import { FieldHands } from "./FieldHands";
import type { HandledField } from "./HandledField";
import { HeatLayer } from "./HeatLayer";
import { Overlay } from "./Overlay";
import { floorPalette } from "./palette";
import { Rays, arrowsOf } from "./rays";
import { Scene } from "./Scene";
import { make } from "./svg";
import { Seen, View } from "./View";

const kFramesCounted = 30;
const kSpokenPeriod = 500;
const kMargin = 0.3;
const kTools = 44;
/** Scale and legend below, buttons and the story above: nothing lies over the corners of the field. */
const kBelow = 34;
const kAbove = 40;

/** Draws the field when something on it is new, at most once a frame of the screen. */
export class FieldPainter implements HandledField {
  readonly view: View;
  readonly held = new Map<string, Pose>();
  readonly overlay: Overlay;
  readonly svg: SVGSVGElement;
  problem = "";
  private readonly floor: HTMLDivElement;
  /** Where the floor of a building is free. */
  private readonly free = new HeatLayer(new Uint32Array(floorPalette().buffer));
  private readonly heat = new HeatLayer();
  private readonly canvas: HTMLCanvasElement;
  private readonly scene: Scene;
  private readonly hands: FieldHands;
  private readonly watcher: ResizeObserver;
  private cloud: Cloud | null = null;
  private request = 0;
  private readonly speaking = setInterval(() => this.scene.speak(), kSpokenPeriod);
  private drawnBoard = -1;
  private drawnUi = -1;
  private drawnSamples: Uint32Array | null = null;
  /** What the rays were made of, and the view that the cloud was drawn in. */
  private rayInputs: unknown[] = [];
  private drawnView = "";
  private isDirty = true;
  private times: number[] = [];

  /**
   * @param only the one robot that is on this field; null: all of them
   * @param seen what is seen of it; fields side by side share that
   */
  constructor(
    private readonly place: HTMLElement,
    readonly context: Context,
    private readonly only: number | null = null,
    seen = new Seen(),
  ) {
    this.view = new View(seen);
    this.floor = document.createElement("div");
    this.floor.className = "floor";
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("aria-hidden", "true");
    this.svg = make("svg", { class: "over", role: "group", "aria-label": "Field: robots, ball and lines", tabindex: 0 });
    this.free.canvas.classList.add("free");
    this.place.replaceChildren(this.floor, this.free.canvas, this.heat.canvas, this.canvas, this.svg);
    this.scene = new Scene(make("svg"), context.session.board, only);
    // The scene's groups live in the one SVG, below what hands draw.
    this.svg.append(...this.scene.svg.childNodes);
    this.overlay = new Overlay(this.svg, this.place);
    try {
      this.cloud = new Cloud(this.canvas);
    } catch (error) {
      this.problem = (error as Error).message;
    }
    this.hands = new FieldHands(this);
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(place);
    this.resize();
    this.request = requestAnimationFrame(() => this.tick());
  }

  /** The robot whose readings and belief are drawn. */
  private get robot(): Robot | null {
    const { board } = this.context.session;
    return this.only === null ? board.robot : (board.robots.get(this.only) ?? null);
  }

  stop(): void {
    cancelAnimationFrame(this.request);
    clearInterval(this.speaking);
    this.watcher.disconnect();
    this.hands.stop();
    this.place.replaceChildren();
  }

  dirty(): void {
    this.isDirty = true;
    // Fields beside this one see the same.
    if (this.only !== null) this.context.ui.redraw();
  }

  fit(): void {
    const { world } = this.context.session.board;
    const { ui } = this.context;
    if (ui.follow) ui.change({ follow: false });
    if (world) this.view.fit(world.min, world.max, kMargin, kTools, kBelow, kAbove);
    this.dirty();
  }

  zoomBy(factor: number, at: Point = { x: this.view.width / 2, y: this.view.height / 2 }): void {
    this.view.zoom(factor, at);
    this.dirty();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.place;
    if (!clientWidth || !clientHeight) return;
    this.view.width = clientWidth;
    this.view.height = clientHeight;
    this.svg.setAttribute("viewBox", `0 0 ${clientWidth} ${clientHeight}`);
    this.dirty();
  }

  private tick(): void {
    this.request = requestAnimationFrame(() => this.tick());
    const { session, ui } = this.context;
    const { board } = session;
    const isNew = board.frame !== this.drawnBoard || ui.frame !== this.drawnUi || this.isDirty;
    if (!isNew || !board.world || ui.is3d) return;
    this.drawnBoard = board.frame;
    this.drawnUi = ui.frame;
    const needsAll = this.isDirty;
    this.isDirty = false;
    this.draw(needsAll);
    this.count();
  }

  /** Frames a second, for tests and the curious: an attribute of the stage. */
  private count(): void {
    const time = performance.now();
    this.times.push(time);
    if (this.times.length < kFramesCounted) return;
    const rate = ((this.times.length - 1) * 1000) / (time - this.times[0]!);
    this.place.dataset.fps = rate.toFixed(1);
    this.times = [];
  }

  private draw(needsAll: boolean): void {
    const { view, overlay } = this;
    const { session, ui } = this.context;
    const { board } = session;
    const world = board.world!;
    const { robot } = this;
    if (ui.follow && robot?.pose) {
      view.x = robot.pose.x;
      view.y = robot.pose.y;
      view.isFree = true;
    } else if (!view.isFree) {
      view.fit(world.min, world.max, kMargin, kTools, kBelow, kAbove);
    }
    this.drawFloor();
    this.free.draw(view, board.drawing.floor);
    const isOfSelected = robot === board.robot;
    this.heat.draw(view, isOfSelected ? ui.heat : null);
    this.scene.draw(view, ui.layers, this.held);
    this.drawCloud(needsAll);
    overlay.drawScale(view);
    overlay.drawAsked(view, isOfSelected ? ui.asked : null);
  }

  private drawFloor(): void {
    const world = this.context.session.board.world!;
    const a = this.view.toPixel({ x: world.min.x, y: world.max.y });
    const b = this.view.toPixel({ x: world.max.x, y: world.min.y });
    const { style } = this.floor;
    this.floor.classList.toggle("pitch", isPitch(this.context.session.board.drawing));
    style.transform = `translate(${a.x}px, ${a.y}px)`;
    style.width = `${b.x - a.x}px`;
    style.height = `${b.y - a.y}px`;
  }

  private drawCloud(needsAll: boolean): void {
    const { cloud, view } = this;
    if (!cloud) return;
    // The cloud changes with the readings of one robot; robots move far more often.
    const areSamplesNew = this.takeSamples(cloud);
    const areRaysNew = this.takeRays(cloud);
    const seen = `${view.matrix} ${view.width} ${view.height}`;
    if (!areSamplesNew && !areRaysNew && seen === this.drawnView && !needsAll) return;
    this.drawnView = seen;
    cloud.draw(view, window.devicePixelRatio || 1, { light: [0.85, 0.45, 0.1], heavy: [1, 0.85, 0.3] });
  }

  private takeSamples(cloud: Cloud): boolean {
    const { ui } = this.context;
    const samples = (ui.layers.samples && this.robot?.heldOf("samples")?.words) || null;
    if (samples === this.drawnSamples) return false;
    cloud.setArrows(samples ? arrowsOf(samples) : new Float32Array());
    this.drawnSamples = samples;
    return true;
  }

  private takeRays(cloud: Cloud): boolean {
    const { session, ui } = this.context;
    const { robot } = this;
    const expected = robot === session.board.robot ? ui.expected : null;
    if (ui.layers.along && robot && !robot.along) void session.past.learnScans(robot);
    const inputs = [robot?.version, ui.layers, expected, robot, robot?.along?.length];
    if (inputs.every((input, i) => input === this.rayInputs[i])) return false;
    this.rayInputs = inputs;
    const rays = new Rays();
    if (robot && ui.layers.along) rays.addAlong(robot);
    if (robot && (ui.layers.rays || ui.layers.sightings || ui.layers.expected)) rays.add(robot, ui.layers, expected);
    cloud.setLines(new Float32Array(rays.lines));
    cloud.setDots(new Float32Array(rays.dots));
    return true;
  }

  get askedHeading(): number {
    const { insight, session } = this.context;
    return insight.wish.theta ?? session.board.robot?.pose?.theta ?? 0;
  }

  describe(at: Point): string {
    const robot = this.robot?.pose;
    const away = robot ? Math.hypot(at.x - robot.x, at.y - robot.y) : null;
    const bearing = robot ? degrees(Math.atan2(at.y - robot.y, at.x - robot.x)) : 0;
    const relative = away === null ? "" : `   ${away.toFixed(2)} m, ${bearing.toFixed(0)}° from the robot`;
    return `x ${at.x.toFixed(2)}  y ${at.y.toFixed(2)} m${relative}`;
  }
}
