import type { View } from "./View";

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

/** Whether WebGL is drawn by a graphics card: in software, smooth edges cost more than all the rest. */
function hasGpu(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const renderer = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
}

interface Part {
  program: WebGLProgram;
  array: WebGLVertexArrayObject;
  buffer: WebGLBuffer;
  count: number;
  /** How many numbers the buffer holds. */
  room: number;
  uniforms: Map<string, WebGLUniformLocation | null>;
}

/** Draws what is too much for SVG: samples and rays. Below the SVG, in the same view. */
export class Cloud {
  private readonly gl: WebGL2RenderingContext;
  private arrows!: Part;
  private lines!: Part;
  private dots!: Part;
  private corners = new Float32Array();
  private isLost = false;

  /** @throws Error where there is no WebGL2 */
  constructor(private readonly canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl2", { alpha: true, antialias: hasGpu(), premultipliedAlpha: true });
    if (!gl) throw new Error("this browser has no WebGL2: samples and rays are not shown");
    this.gl = gl;
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.isLost = true;
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.isLost = false;
      this.build();
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
  }

  private part(made: WebGLProgram): Part {
    const { gl } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    return { program: made, array, buffer: gl.createBuffer(), count: 0, room: 0, uniforms: new Map() };
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
    if (data.length > part.room) gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    else gl.bufferSubData(gl.ARRAY_BUFFER, 0, data);
    part.room = Math.max(part.room, data.length);
  }

  /**
   * Each sample is a triangle of its own: drawn in software, instances cost fifteen times as much.
   * @param data x, y [m], heading [rad], weight 0..1 a sample
   */
  setArrows(data: Float32Array): void {
    if (this.corners.length < 3 * data.length) this.corners = new Float32Array(3 * data.length);
    const { corners } = this;
    for (let from = 0, to = 0; from < data.length; from += 4) {
      for (let corner = 0; corner < 3; ++corner, to += 4) {
        corners[to] = data[from]!;
        corners[to + 1] = data[from + 1]!;
        corners[to + 2] = data[from + 2]!;
        corners[to + 3] = data[from + 3]!;
      }
    }
    this.fill(this.arrows, corners.subarray(0, 3 * data.length), 4);
  }

  setLines(data: Float32Array): void {
    this.fill(this.lines, data, kVertex);
  }

  setDots(data: Float32Array): void {
    this.fill(this.dots, data, kVertex);
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
}
