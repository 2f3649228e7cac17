import { plain } from "../link/words";
import { degrees, wrap, type Point, type Pose } from "../model/geometry";
import type { HandledField } from "./HandledField";

const kClick = 4;
const kKeyStep = 60;

/** What is done with what a pointer touched. A `robot` is selected when it is let go or carried: if a second finger comes, to zoom, not at all. */
type Grip =
  | { kind: "pan"; last: Point; robot: number }
  | { kind: "measure"; from: Point }
  | { kind: "about"; at: Point; theta: number }
  | { kind: "carry"; robot: number; what: string; offset: Point; theta: number | null; turns: boolean };

/** Mouse, fingers and keys on the field. */
export class FieldHands {
  private readonly pointers = new Map<number, Point>();
  private readonly end = new AbortController();
  private grip: Grip | null = null;
  private start: Point = { x: 0, y: 0 };
  private hasMoved = false;
  private isSending = false;
  private toSend: { what: string; pose: Pose; turns: boolean } | null = null;

  constructor(private readonly painter: HandledField) {
    const { svg } = painter;
    const options = { signal: this.end.signal };
    svg.addEventListener("pointerdown", (event) => this.down(event), options);
    svg.addEventListener("pointermove", (event) => this.move(event), options);
    svg.addEventListener("pointerup", (event) => this.up(event), options);
    svg.addEventListener("pointercancel", (event) => this.up(event), options);
    svg.addEventListener("wheel", (event) => this.wheel(event), { ...options, passive: false });
    svg.addEventListener("keydown", (event) => this.key(event), options);
  }

  stop(): void {
    this.end.abort();
  }

  private get board() {
    return this.painter.context.session.board;
  }

  private at(event: MouseEvent): Point {
    const box = this.painter.svg.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private down(event: PointerEvent): void {
    const at = this.at(event);
    this.painter.svg.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size > 1) {
      this.grip = null;
      return;
    }
    this.start = at;
    this.hasMoved = false;
    this.grip = this.take(event, at);
  }

  private take(event: PointerEvent, at: Point): Grip {
    const { painter, board } = this;
    const { ui } = painter.context;
    const field = painter.view.toField(at);
    const over = (event.target as Element).closest<SVGGElement>(".robot, .object");
    const robot = Number(over?.dataset.robot ?? 0);
    if (ui.tool === "measure") return { kind: "measure", from: field };
    if (event.shiftKey && board.robot && board.isOperator && board.can("LOCALIZE")) {
      return { kind: "about", at: field, theta: board.robot.pose?.theta ?? 0 };
    }
    if (over && board.isOperator) {
      const what = robot ? `robot=${robot}` : `object=${over.dataset.object}`;
      const pose = robot ? board.robots.get(robot)?.pose : board.objects.find(({ name }) => name === over.dataset.object);
      if (pose) {
        const offset = { x: pose.x - field.x, y: pose.y - field.y };
        return { kind: "carry", robot, what, offset, theta: robot ? pose.theta : null, turns: event.altKey };
      }
    }
    return { kind: "pan", last: at, robot };
  }

  private move(event: PointerEvent): void {
    const { painter } = this;
    const at = this.at(event);
    painter.overlay.say(painter.describe(painter.view.toField(at)));
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size === 2) return this.pinch(event.pointerId, before, at);
    if (!this.hasMoved && Math.hypot(at.x - this.start.x, at.y - this.start.y) > kClick) {
      this.hasMoved = true;
      this.selectTouched(this.grip);
    }
    if (!this.hasMoved || !this.grip) return;
    this.drag(this.grip, at);
    painter.dirty();
  }

  private pinch(moved: number, before: Point, at: Point): void {
    const { view } = this.painter;
    const other = [...this.pointers].find(([id]) => id !== moved)![1];
    const distance = (p: Point) => Math.max(1, Math.hypot(p.x - other.x, p.y - other.y));
    view.zoom(distance(at) / distance(before), { x: (at.x + other.x) / 2, y: (at.y + other.y) / 2 });
    view.pan((at.x - before.x) / 2, (at.y - before.y) / 2);
    this.painter.dirty();
  }

  private drag(grip: Grip, at: Point): void {
    const { painter } = this;
    const { view, overlay, context } = painter;
    const field = view.toField(at);
    if (grip.kind === "pan") {
      view.pan(at.x - grip.last.x, at.y - grip.last.y);
      grip.last = at;
      if (context.ui.follow) context.ui.change({ follow: false });
    } else if (grip.kind === "measure") {
      overlay.measure(view, grip.from, field);
    } else if (grip.kind === "about") {
      grip.theta = Math.atan2(field.y - grip.at.y, field.x - grip.at.x);
      overlay.aim(view, { ...grip.at, theta: grip.theta });
    } else {
      this.carry(grip, field);
    }
  }

  private carry(grip: Grip & { kind: "carry" }, field: Point): void {
    const { painter } = this;
    const from = painter.view.toField(this.start);
    const middle = { x: from.x + grip.offset.x, y: from.y + grip.offset.y };
    const pose = grip.turns
      ? { ...middle, theta: Math.atan2(field.y - middle.y, field.x - middle.x) }
      : { x: field.x + grip.offset.x, y: field.y + grip.offset.y, theta: grip.theta ?? 0 };
    painter.held.set(grip.what, pose);
    this.toSend = { what: grip.what, pose, turns: grip.theta !== null };
    void this.send();
  }

  /** Says where things are carried, one request at a time, the newest place. */
  private async send(): Promise<void> {
    const { toSend, painter } = this;
    if (this.isSending || !toSend) return;
    this.isSending = true;
    this.toSend = null;
    const { what, pose, turns } = toSend;
    const heading = turns ? ` theta_deg=${plain(degrees(wrap(pose.theta)))}` : "";
    await painter.context.session.act(`PLACE ${what} x_m=${plain(pose.x)} y_m=${plain(pose.y)}${heading}`, "field");
    this.isSending = false;
    if (this.toSend) return this.send();
    if (!this.grip) this.letGo();
  }

  private selectTouched(grip: Grip | null): void {
    if (grip && "robot" in grip && grip.robot) this.painter.context.session.select(grip.robot);
  }

  private letGo(): void {
    this.painter.held.clear();
    this.painter.dirty();
  }

  private up(event: PointerEvent): void {
    const { painter, grip } = this;
    if (!this.pointers.delete(event.pointerId)) return;
    this.grip = null;
    if (!grip) return;
    if (!this.hasMoved) this.selectTouched(grip);
    const { session, ui } = painter.context;
    if (grip.kind === "carry") {
      if (!this.isSending) this.letGo();
    } else if (grip.kind === "about") {
      const at = `x_m=${plain(grip.at.x)} y_m=${plain(grip.at.y)} theta_deg=${plain(degrees(grip.theta))}`;
      void session.act(`LOCALIZE robot=${this.board.selected} ${at}`, "localization");
      painter.overlay.clear();
    } else if (grip.kind === "measure") {
      if (!this.hasMoved) painter.overlay.clear();
    } else if (!this.hasMoved && ui.heat && this.board.can("WHY")) {
      this.askWhy(painter.view.toField(grip.last));
    }
    painter.dirty();
  }

  private askWhy(at: Point): void {
    const { context, askedHeading } = this.painter;
    context.ui.change({ asked: at, panel: "localization" });
    context.insight.explain({ ...at, theta: askedHeading }).then(
      () => this.board.errors.delete("why"),
      (error: Error) => {
        this.board.errors.set("why", error.message);
        this.board.touch();
      },
    );
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const pixels = event.deltaMode === 1 ? event.deltaY * 16 : event.deltaY;
    this.painter.zoomBy(Math.exp(-pixels * 0.0015), this.at(event));
  }

  private key(event: KeyboardEvent): void {
    const { painter, board } = this;
    const { ui, session } = painter.context;
    const over = (event.target as Element).closest<SVGGElement>(".robot");
    if (event.key === "Enter" && over) {
      session.select(Number(over.dataset.robot));
      event.preventDefault();
      return;
    }
    if (ui.drivesByKeys || event.ctrlKey || event.metaKey || event.altKey) return;
    const way = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!way) return;
    event.preventDefault();
    if (ui.follow) ui.change({ follow: false });
    painter.view.pan(way[0]! * kKeyStep, way[1]! * kKeyStep);
    painter.dirty();
    board.touch();
  }
}
