import type { View } from "./View";
import { heatPalette } from "./palette";

/** A map of values over the field: one byte a cell, rows from the lowest y on; 0: not open. */
export interface Heat {
  columns: number;
  rows: number;
  x: number;
  y: number;
  step: number;
  cells: Uint8Array;
}

/** Lines and dots: x, y [m] and a colour (r, g, b, a in 0..1) each. */
export const kVertex = 6;

const kHead = `#version 300 es
precision highp float;
uniform vec4 view; // middle x, y [m]; pixels a metre over half the width, over half the height
vec4 onView(vec2 p) { return vec4((p - view.xy) * view.zw, 0.0, 1.0); }
`;

const kArrowVertex = `${kHead}
layout(location = 0) in vec4 arrow; // x, y [m], heading [rad], weight 0..1
uniform float size; // of an arrow [m]
uniform vec3 light;
uniform vec3 heavy;
out vec4 tint;
void main() {
  float c = cos(arrow.z), s = sin(arrow.z);
  int i = gl_VertexID % 3;
  vec2 corner = i == 0 ? vec2(0.65, 0.0) : vec2(-0.35, i == 1 ? 0.27 : -0.27);
  vec2 p = corner * size * (0.75 + 0.5 * arrow.w);
  gl_Position = onView(arrow.xy + vec2(c * p.x - s * p.y, s * p.x + c * p.y));
  tint = vec4(mix(light, heavy, arrow.w), 0.35 + 0.6 * arrow.w);
}`;

const kFlatVertex = `${kHead}
layout(location = 0) in vec2 position;
layout(location = 1) in vec4 colour;
uniform float size;
out vec4 tint;
void main() { gl_Position = onView(position); gl_PointSize = size; tint = colour; }`;

const kTintFragment = `#version 300 es
precision mediump float;
in vec4 tint;
out vec4 result;
void main() { result = vec4(tint.rgb * tint.a, tint.a); }`;

const kHeatVertex = `${kHead}
layout(location = 0) in vec2 corner;
uniform vec4 box; // x, y, width, height [m]
out vec2 at;
void main() { at = corner; gl_Position = onView(box.xy + corner * box.zw); }`;

const kHeatFragment = `#version 300 es
precision mediump float;
uniform sampler2D cells;
uniform sampler2D palette;
in vec2 at;
out vec4 result;
void main() {
  vec4 c = texture(palette, vec2((texture(cells, at).r * 255.0 + 0.5) / 256.0, 0.5));
  result = vec4(c.rgb * c.a, c.a);
}`;

function program(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`a shader can't be used: ${gl.getProgramInfoLog(made)}`);
  }
  return made;
}

interface Part {
  program: WebGLProgram;
  array: WebGLVertexArrayObject;
  buffer: WebGLBuffer;
  count: number;
  uniforms: Map<string, WebGLUniformLocation | null>;
}

/** Draws what is too much for SVG: samples, rays, heat maps. Below the SVG, in the same view. */
export class Cloud {
  private readonly gl: WebGL2RenderingContext;
  private arrows!: Part;
  private lines!: Part;
  private dots!: Part;
  private heat!: Part & { cells: WebGLTexture; palette: WebGLTexture };
  private heatShown: Heat | null = null;
  private isLost = false;

  /** @throws Error where there is no WebGL2 */
  constructor(private readonly canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl2", { alpha: true, antialias: true, premultipliedAlpha: true });
    if (!gl) throw new Error("this browser has no WebGL2: samples, rays and heat maps are not shown");
    this.gl = gl;
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.isLost = true;
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.isLost = false;
      this.build();
      const shown = this.heatShown;
      if (shown) this.setHeat(shown);
    });
    this.build();
  }

  private build(): void {
    const { gl } = this;
    this.arrows = this.part(program(gl, kArrowVertex, kTintFragment));
    gl.bindBuffer(gl.ARRAY_BUFFER, this.arrows.buffer);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 0, 0);
    const flat = program(gl, kFlatVertex, kTintFragment);
    this.lines = this.flat(flat);
    this.dots = this.flat(flat);
    const heat = this.part(program(gl, kHeatVertex, kHeatFragment));
    gl.bindBuffer(gl.ARRAY_BUFFER, heat.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    this.heat = { ...heat, cells: gl.createTexture(), palette: gl.createTexture() };
    gl.bindTexture(gl.TEXTURE_2D, this.heat.palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, heatPalette(0.85));
    this.filter(gl.NEAREST);
  }

  private filter(kind: number): void {
    const { gl } = this;
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, kind);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, kind);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  }

  private part(made: WebGLProgram): Part {
    const { gl } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    return { program: made, array, buffer: gl.createBuffer(), count: 0, uniforms: new Map() };
  }

  private flat(made: WebGLProgram): Part {
    const { gl } = this;
    const part = this.part(made);
    gl.bindBuffer(gl.ARRAY_BUFFER, part.buffer);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, kVertex * 4, 0);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 4, gl.FLOAT, false, kVertex * 4, 8);
    return part;
  }

  private fill(part: Part, data: Float32Array, each: number): void {
    const { gl } = this;
    part.count = data.length / each;
    gl.bindBuffer(gl.ARRAY_BUFFER, part.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
  }

  /**
   * Each sample is a triangle of its own: drawn in software, instances cost fifteen times as much.
   * @param data x, y [m], heading [rad], weight 0..1 a sample
   */
  setArrows(data: Float32Array): void {
    const corners = new Float32Array(3 * data.length);
    for (let from = 0, to = 0; from < data.length; from += 4) {
      const sample = data.subarray(from, from + 4);
      for (let corner = 0; corner < 3; ++corner, to += 4) corners.set(sample, to);
    }
    this.fill(this.arrows, corners, 4);
  }

  setLines(data: Float32Array): void {
    this.fill(this.lines, data, kVertex);
  }

  setDots(data: Float32Array): void {
    this.fill(this.dots, data, kVertex);
  }

  setHeat(heat: Heat | null): void {
    const { gl } = this;
    this.heatShown = heat;
    if (!heat) return;
    gl.bindTexture(gl.TEXTURE_2D, this.heat.cells);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, heat.columns, heat.rows, 0, gl.RED, gl.UNSIGNED_BYTE, heat.cells);
    this.filter(gl.NEAREST);
  }

  /** @param ratio device pixels a pixel */
  draw(view: View, ratio: number, colours: { light: number[]; heavy: number[] }): void {
    const { gl, canvas } = this;
    if (this.isLost) return;
    const width = Math.max(1, Math.round(view.width * ratio));
    const height = Math.max(1, Math.round(view.height * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (this.heatShown) this.drawHeat(view, this.heatShown);
    this.drawFlat(this.lines, gl.LINES, view, 1);
    if (this.arrows.count) {
      this.use(this.arrows, view);
      gl.uniform1f(this.at(this.arrows, "size"), Math.max(0.09, 9 / view.scale));
      gl.uniform3fv(this.at(this.arrows, "light"), colours.light);
      gl.uniform3fv(this.at(this.arrows, "heavy"), colours.heavy);
      gl.drawArrays(gl.TRIANGLES, 0, this.arrows.count);
    }
    this.drawFlat(this.dots, gl.POINTS, view, 4 * ratio);
  }

  private at(part: Part, name: string): WebGLUniformLocation | null {
    let place = part.uniforms.get(name);
    if (place === undefined) {
      place = this.gl.getUniformLocation(part.program, name);
      part.uniforms.set(name, place);
    }
    return place;
  }

  private use(part: Part, view: View): void {
    const { gl } = this;
    gl.useProgram(part.program);
    gl.bindVertexArray(part.array);
    gl.uniform4f(this.at(part, "view"), view.x, view.y, (2 * view.scale) / view.width, (2 * view.scale) / view.height);
  }

  private drawFlat(part: Part, mode: number, view: View, size: number): void {
    if (!part.count) return;
    this.use(part, view);
    this.gl.uniform1f(this.at(part, "size"), size);
    this.gl.drawArrays(mode, 0, part.count);
  }

  private drawHeat(view: View, heat: Heat): void {
    const { gl } = this;
    this.use(this.heat, view);
    gl.uniform4f(this.at(this.heat, "box"), heat.x, heat.y, heat.columns * heat.step, heat.rows * heat.step);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.heat.cells);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.heat.palette);
    gl.uniform1i(this.at(this.heat, "cells"), 0);
    gl.uniform1i(this.at(this.heat, "palette"), 1);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.activeTexture(gl.TEXTURE0);
  }
}
