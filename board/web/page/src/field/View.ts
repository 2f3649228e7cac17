import type { Point } from "../model/geometry";

const kSmallest = 2;
const kLargest = 4000;

/** What part of the field is seen; views of several fields side by side share one. */
export class Seen {
  /** Field point in the middle of the view [m]. */
  x = 0;
  y = 0;
  /** Pixels a metre. */
  scale = 60;
  /** Whether the user has moved it; otherwise the view fits itself to the field. */
  isFree = false;
}

/** Field metres to pixels of a view, y upwards. */
export class View {
  width = 1;
  height = 1;

  constructor(private readonly seen = new Seen()) {}

  get x(): number {
    return this.seen.x;
  }
  set x(value: number) {
    this.seen.x = value;
  }
  get y(): number {
    return this.seen.y;
  }
  set y(value: number) {
    this.seen.y = value;
  }
  get scale(): number {
    return this.seen.scale;
  }
  set scale(value: number) {
    this.seen.scale = value;
  }
  get isFree(): boolean {
    return this.seen.isFree;
  }
  set isFree(value: boolean) {
    this.seen.isFree = value;
  }

  toPixel({ x, y }: Point): Point {
    return { x: this.width / 2 + (x - this.x) * this.scale, y: this.height / 2 - (y - this.y) * this.scale };
  }

  toField({ x, y }: Point): Point {
    return { x: this.x + (x - this.width / 2) / this.scale, y: this.y - (y - this.height / 2) / this.scale };
  }

  /** Shows a rectangle as large as possible, beside what others need: pixels on the left, below and above. */
  fit(min: Point, max: Point, margin = 0.3, left = 0, below = 0, above = 0): void {
    const width = Math.max(0.1, max.x - min.x + 2 * margin);
    const height = Math.max(0.1, max.y - min.y + 2 * margin);
    this.scale = clamp(Math.min(Math.max(1, this.width - left) / width, Math.max(1, this.height - below - above) / height));
    this.x = (min.x + max.x) / 2 - left / 2 / this.scale;
    this.y = (min.y + max.y) / 2 + (above - below) / 2 / this.scale;
    this.isFree = false;
  }

  /** Enlarges by @p factor; the field point under @p pixel stays there. */
  zoom(factor: number, pixel: Point): void {
    const before = this.toField(pixel);
    this.scale = clamp(this.scale * factor);
    const after = this.toField(pixel);
    this.x += before.x - after.x;
    this.y += before.y - after.y;
    this.isFree = true;
  }

  /** Moves what is seen by so many pixels. */
  pan(dx: number, dy: number): void {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.isFree = true;
  }

  /** The transform of an SVG group whose units are metres of the field. */
  get matrix(): string {
    const { width, height, x, y, scale } = this;
    return `matrix(${scale} 0 0 ${-scale} ${width / 2 - x * scale} ${height / 2 + y * scale})`;
  }
}

function clamp(scale: number): number {
  return Math.min(kLargest, Math.max(kSmallest, scale));
}

/** A length for a ruler of about @p pixels: 1, 2 or 5 times a power of ten [m]. */
export function niceLength(scale: number, pixels: number): number {
  const wanted = pixels / scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const factor = [5, 2, 1].find((one) => one * power <= wanted) ?? 1;
  return factor * power;
}
