import type { Heat } from "../model/maps";
import { heatPalette } from "./palette";
import type { View } from "./View";

/** Colours as pixels of a canvas. */
const kClear = new Uint32Array(heatPalette(0.85).buffer);
export const kOpaque = new Uint32Array(heatPalette(1).buffer);

/** A pixel a cell, the highest row first. */
export function paintHeat(canvas: HTMLCanvasElement, { columns, rows, cells }: Heat, colours: Uint32Array): void {
  if (canvas.width !== columns) canvas.width = columns;
  if (canvas.height !== rows) canvas.height = rows;
  const picture = new ImageData(columns, rows);
  const pixels = new Uint32Array(picture.data.buffer);
  for (let row = 0; row < rows; ++row) {
    const from = (rows - 1 - row) * columns;
    for (let column = 0; column < columns; ++column) pixels[row * columns + column] = colours[cells[from + column]!]!;
  }
  canvas.getContext("2d")?.putImageData(picture, 0, 0);
}

/**
 * The map below all that moves: a small picture that the compositor enlarges, so neither a new map nor a new sample draws
 * the other one again.
 */
export class HeatLayer {
  readonly canvas = document.createElement("canvas");
  private shown: Heat | null = null;

  /** @param colours of the 256 values; of a map of p if there are none */
  constructor(private readonly colours: Uint32Array = kClear) {
    this.canvas.className = "heat";
    this.canvas.setAttribute("aria-hidden", "true");
    this.canvas.hidden = true;
  }

  draw(view: View, heat: Heat | null): void {
    if (heat !== this.shown) {
      this.shown = heat;
      this.canvas.hidden = heat === null;
      if (heat) paintHeat(this.canvas, heat, this.colours);
    }
    if (!heat) return;
    const corner = view.toPixel({ x: heat.x, y: heat.y + heat.rows * heat.step });
    const size = heat.step * view.scale;
    const placed = `translate(${corner.x}px, ${corner.y}px) scale(${size})`;
    if (this.canvas.style.transform !== placed) this.canvas.style.transform = placed;
  }
}
