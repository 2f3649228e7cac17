import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CylinderGeometry,
  EdgesGeometry,
  ExtrudeGeometry,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PlaneGeometry,
  RingGeometry,
  Shape,
  ShapeGeometry,
  SphereGeometry,
  type BufferGeometry as Geometry,
  type Material,
  type Object3D,
  type Scene,
} from "three";
import { paint, robotColour } from "../field/palette";
import { Rays, arrowsOf } from "../field/rays";
import type { Board } from "../model/Board";
import type { Robot } from "../model/Robot";
import { isPitch, type FieldArc, type FieldLine } from "../model/world";
import type { Layers } from "../ui/layers";

const kPaint = 0.004;
const kMostArrows = 10000;

/** Floor, lines, walls, goals, robots, balls, rays and samples as bodies. */
export class World3d {
  private readonly still = new Group();
  private readonly moving = new Group();
  private readonly robots = new Map<number, { group: Group; parts: { mesh: Mesh; index: number }[] }>();
  private readonly objects = new Map<string, Mesh>();
  private readonly rays: LineSegments;
  private readonly arrows: InstancedMesh;
  private floor: Mesh | null = null;
  private scene = -1;

  constructor(
    scene: Scene,
    private readonly board: Board,
  ) {
    const lines = new LineBasicMaterial({ vertexColors: true, transparent: true });
    this.rays = new LineSegments(new BufferGeometry(), lines);
    this.rays.frustumCulled = false;
    const arrow = new Shape();
    arrow.moveTo(0.06, 0).lineTo(-0.04, 0.026).lineTo(-0.022, 0).lineTo(-0.04, -0.026);
    this.arrows = new InstancedMesh(new ShapeGeometry(arrow), new MeshBasicMaterial({ color: 0xffb640 }), kMostArrows);
    this.arrows.count = 0;
    this.arrows.frustumCulled = false;
    scene.add(this.still, this.moving, this.rays, this.arrows);
  }

  dispose(): void {
    free(this.still);
    free(this.moving);
    free(this.rays);
    free(this.arrows);
  }

  update(layers: Layers): void {
    const { board } = this;
    if (this.scene !== board.scene) this.rebuild();
    for (const robot of board.robots.values()) this.place(robot);
    for (const object of board.objects) {
      const mesh = this.objects.get(object.name);
      const middle = mesh?.userData.middle as number | undefined;
      mesh?.position.set(object.x, object.y, object.z + (middle ?? 0));
      mesh?.rotation.set(0, 0, object.theta);
    }
    this.updateRays(layers);
    this.updateArrows(layers);
  }

  private place(robot: Robot): void {
    const drawn = this.robots.get(robot.number);
    const { pose } = robot;
    if (!drawn) return;
    drawn.group.visible = pose !== null;
    if (!pose) return;
    drawn.group.position.set(pose.x, pose.y, 0);
    drawn.group.rotation.z = pose.theta;
    for (const { mesh, index } of drawn.parts) mesh.visible = robot.shows(robot.outlines[index]!);
  }

  private updateRays(layers: Layers): void {
    const rays = new Rays();
    const { robot } = this.board;
    if (robot) rays.add(robot, layers, null);
    const count = rays.lines.length / 6;
    const places = new Float32Array(3 * count);
    const colours = new Float32Array(4 * count);
    for (let i = 0; i < count; ++i) {
      places.set([rays.lines[6 * i]!, rays.lines[6 * i + 1]!, 0.3], 3 * i);
      colours.set(rays.lines.slice(6 * i + 2, 6 * i + 6), 4 * i);
    }
    this.rays.geometry.dispose();
    this.rays.geometry = new BufferGeometry();
    this.rays.geometry.setAttribute("position", new BufferAttribute(places, 3));
    this.rays.geometry.setAttribute("color", new BufferAttribute(colours, 4));
  }

  private updateArrows(layers: Layers): void {
    const words = layers.samples ? this.board.robot?.heldOf("samples")?.words : undefined;
    const data = words ? arrowsOf(words) : new Float32Array();
    const matrix = new Matrix4();
    const count = Math.min(kMostArrows, data.length / 4);
    for (let i = 0; i < count; ++i) {
      matrix.makeRotationZ(data[4 * i + 2]!).setPosition(data[4 * i]!, data[4 * i + 1]!, 0.012);
      this.arrows.setMatrixAt(i, matrix);
    }
    this.arrows.count = count;
    this.arrows.instanceMatrix.needsUpdate = true;
  }

  private rebuild(): void {
    const { board } = this;
    this.scene = board.scene;
    free(this.still);
    free(this.moving);
    this.still.clear();
    this.moving.clear();
    this.robots.clear();
    this.objects.clear();
    this.buildGround();
    this.still.traverse((one) => shade(one, one !== this.floor));
    for (const robot of board.robots.values()) this.buildRobot(robot);
    for (const { name, radius, height, colour, kind } of board.world?.objects ?? []) {
      const isBall = kind === "ball";
      const shape = isBall ? new SphereGeometry(radius, 24, 16) : upright(new CylinderGeometry(radius, radius, height, 24));
      const mesh = new Mesh(shape, new MeshLambertMaterial({ color: paint(colour) }));
      mesh.userData.middle = isBall ? radius : height / 2;
      this.objects.set(name, mesh);
      this.moving.add(mesh);
    }
    this.moving.traverse((one) => shade(one, true));
  }

  private buildGround(): void {
    const { world, drawing } = this.board;
    if (!world) return;
    const width = world.max.x - world.min.x;
    const height = world.max.y - world.min.y;
    const floor = new Mesh(new PlaneGeometry(width, height), new MeshLambertMaterial({ color: isPitch(drawing) ? 0x2c6e4d : 0xc3cad2 }));
    floor.position.set((world.min.x + world.max.x) / 2, (world.min.y + world.max.y) / 2, 0);
    this.floor = floor;
    this.still.add(floor);
    for (const line of drawing.lines) this.still.add(lineOf(line));
    for (const arc of drawing.arcs) this.still.add(arcOf(arc));
    for (const wall of drawing.walls) {
      const length = Math.hypot(wall.x1 - wall.x0, wall.y1 - wall.y0);
      const look = { color: wall.goal ? 0xb8c4d0 : 0xd9dee3, transparent: true, opacity: 0.55 };
      const mesh = new Mesh(new BoxGeometry(length, 0.02, wall.z1 - wall.z0), new MeshLambertMaterial(look));
      mesh.position.set((wall.x0 + wall.x1) / 2, (wall.y0 + wall.y1) / 2, (wall.z0 + wall.z1) / 2);
      mesh.rotation.z = Math.atan2(wall.y1 - wall.y0, wall.x1 - wall.x0);
      this.still.add(mesh);
    }
    for (const { points, z0, z1, colour } of drawing.solids) {
      const shape = new Shape(points.map(({ x, y }) => ({ x, y }) as never));
      const depth = Math.max(0.01, z1 - z0);
      const mesh = new Mesh(new ExtrudeGeometry(shape, { depth, bevelEnabled: false }), new MeshLambertMaterial({ color: paint(colour) }));
      mesh.position.z = z0;
      this.still.add(mesh);
    }
    for (const goal of drawing.goals) {
      const shape = new BoxGeometry(2 * goal.dx, 2 * goal.dy, goal.height);
      const frame = new LineSegments(new EdgesGeometry(shape), new LineBasicMaterial({ color: paint(goal.colour) }));
      shape.dispose();
      frame.position.set(goal.x, goal.y, goal.height / 2);
      frame.rotation.z = goal.theta;
      this.still.add(frame);
    }
    for (const mark of drawing.landmarks) {
      if (mark.kind !== "post") continue;
      const post = new Mesh(upright(new CylinderGeometry(0.1, 0.1, 1, 20)), new MeshLambertMaterial({ color: 0xf0c020 }));
      post.position.set(mark.x, mark.y, 0.5);
      this.still.add(post);
    }
  }

  private buildRobot(robot: Robot): void {
    const group = new Group();
    const parts: { mesh: Mesh; index: number }[] = [];
    const isRun = this.board.kind === "record";
    const look = (colour: string) => new MeshLambertMaterial({ color: colour });
    robot.outlines.forEach((outline, index) => {
      const shape = new Shape(outline.points.map(({ x, y }) => ({ x, y }) as never));
      const depth = Math.max(0.01, outline.z1 - outline.z0);
      const colour = robotColour(robot, isRun, isRun ? "" : outline.colour);
      const mesh = new Mesh(new ExtrudeGeometry(shape, { depth, bevelEnabled: false }), look(colour));
      mesh.position.z = outline.z0;
      parts.push({ mesh, index });
      group.add(mesh);
    });
    if (!robot.outlines.length) {
      const body = new Mesh(upright(new CylinderGeometry(robot.radius, robot.radius, robot.height, 32)), look(robotColour(robot, isRun)));
      body.position.z = robot.height / 2;
      group.add(body);
    }
    const top = Math.max(robot.height, ...robot.outlines.map(({ z1 }) => z1));
    const tip = robot.radius * 0.7;
    const nose = new Shape();
    nose.moveTo(tip, 0).lineTo(-tip * 0.5, tip * 0.5).lineTo(-tip * 0.15, 0).lineTo(-tip * 0.5, -tip * 0.5);
    const sign = new Mesh(new ShapeGeometry(nose), new MeshBasicMaterial({ color: 0xffffff }));
    sign.position.z = top + 0.005;
    group.add(sign);
    this.robots.set(robot.number, { group, parts });
    this.moving.add(group);
  }
}

/** What is lit casts shadows and has those of others, unless one looks through it; paint and signs do neither. */
function shade(object: Object3D, casts: boolean): void {
  if (!(object instanceof Mesh) || !(object.material instanceof MeshLambertMaterial)) return;
  object.receiveShadow = true;
  object.castShadow = casts && !object.material.transparent;
}

/** Cylinders of three stand along y. */
function upright<T extends Geometry>(geometry: T): T {
  geometry.rotateX(Math.PI / 2);
  return geometry;
}

function lineOf(line: FieldLine): Mesh {
  const length = Math.hypot(line.x1 - line.x0, line.y1 - line.y0);
  const mesh = new Mesh(new PlaneGeometry(length, line.width), new MeshBasicMaterial({ color: paint(line.colour) }));
  mesh.position.set((line.x0 + line.x1) / 2, (line.y0 + line.y1) / 2, kPaint);
  mesh.rotation.z = Math.atan2(line.y1 - line.y0, line.x1 - line.x0);
  return mesh;
}

function arcOf(arc: FieldArc): Mesh {
  const inner = Math.max(0, 1 - arc.width / 2 / arc.rx);
  const outer = 1 + arc.width / 2 / arc.rx;
  const from = Math.min(arc.from, arc.to);
  const ring = new RingGeometry(inner, outer, 64, 1, from, Math.abs(arc.to - arc.from));
  const mesh = new Mesh(ring, new MeshBasicMaterial({ color: paint(arc.colour) }));
  mesh.scale.set(arc.rx, arc.ry, 1);
  mesh.rotation.z = arc.angle;
  mesh.position.set(arc.x, arc.y, kPaint);
  return mesh;
}

/** Gives back what the graphics card holds for an object and all in it. */
function free(object: Object3D): void {
  object.traverse((one) => {
    const { geometry, material } = one as { geometry?: Geometry; material?: Material };
    geometry?.dispose();
    material?.dispose();
  });
}
