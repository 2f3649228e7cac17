import { degrees, type Point, type Pose } from "../model/geometry";
import { fixed, make, set } from "./svg";
import { niceLength, type View } from "./View";

/** What lies over the scene, in pixels: scale, position under the mouse, ruler, handles. */
export class Overlay {
  private readonly group: SVGGElement;
  private readonly scale: SVGPathElement;
  private readonly scaleText: SVGTextElement;
  private readonly ruler: SVGLineElement;
  private readonly arrow: SVGPathElement;
  private readonly asked: SVGPathElement;
  private readonly note: SVGTextElement;
  private readonly readout: HTMLDivElement;

  constructor(svg: SVGSVGElement, place: HTMLElement) {
    this.group = make("g", { "aria-hidden": "true", class: "overlay" }, svg);
    this.scale = make("path", { class: "scale" }, this.group);
    this.scaleText = make("text", { class: "scale-text" }, this.group);
    this.ruler = make("line", { class: "ruler", visibility: "hidden" }, this.group);
    this.arrow = make("path", { class: "about-here", visibility: "hidden" }, this.group);
    this.asked = make("path", { class: "asked", visibility: "hidden" }, this.group);
    this.note = make("text", { class: "note", visibility: "hidden" }, this.group);
    this.readout = document.createElement("div");
    this.readout.className = "readout";
    this.readout.setAttribute("aria-hidden", "true");
    place.append(this.readout);
  }

  drawScale(view: View): void {
    const length = niceLength(view.scale, 110);
    const width = length * view.scale;
    const x = view.width - 18;
    const y = view.height - 7;
    set(this.scale, "d", `M${fixed(x - width, 1)} ${y - 5}v5H${x}v-5`);
    set(this.scaleText, "x", fixed(x - width - 7, 1));
    set(this.scaleText, "y", String(y));
    this.scaleText.textContent = length >= 1 ? `${length} m` : `${fixed(length * 100, 1)} cm`;
  }

  say(text: string): void {
    this.readout.textContent = text;
  }

  private noteAt(at: Point, text: string): void {
    set(this.note, "x", fixed(at.x + 10, 1));
    set(this.note, "y", fixed(at.y - 10, 1));
    set(this.note, "visibility", "visible");
    this.note.textContent = text;
  }

  measure(view: View, from: Point, to: Point): void {
    const a = view.toPixel(from);
    const b = view.toPixel(to);
    for (const [name, value] of Object.entries({ x1: a.x, y1: a.y, x2: b.x, y2: b.y })) set(this.ruler, name, fixed(value, 1));
    set(this.ruler, "visibility", "visible");
    const way = { x: to.x - from.x, y: to.y - from.y };
    this.noteAt(b, `${Math.hypot(way.x, way.y).toFixed(2)} m  ${degrees(Math.atan2(way.y, way.x)).toFixed(1)}°`);
  }

  /** An arrow for "the robot is about here". */
  aim(view: View, pose: Pose): void {
    const { x, y } = view.toPixel(pose);
    const tip = { x: x + 44 * Math.cos(pose.theta), y: y - 44 * Math.sin(pose.theta) };
    set(this.arrow, "d", `M${fixed(x - 14, 1)} ${fixed(y, 1)}a14 14 0 1 0 28 0a14 14 0 1 0 -28 0M${fixed(x, 1)} ${fixed(y, 1)}L${fixed(tip.x, 1)} ${fixed(tip.y, 1)}`);
    set(this.arrow, "visibility", "visible");
    this.noteAt(tip, `about here, ${degrees(pose.theta).toFixed(0)}°`);
  }

  drawAsked(view: View, at: Point | null): void {
    set(this.asked, "visibility", at ? "visible" : "hidden");
    if (!at) return;
    const { x, y } = view.toPixel(at);
    set(this.asked, "d", `M${fixed(x - 11, 1)} ${fixed(y, 1)}h22M${fixed(x, 1)} ${fixed(y - 11, 1)}v22`);
  }

  clear(): void {
    for (const element of [this.ruler, this.arrow, this.note]) set(element, "visibility", "hidden");
  }
}
