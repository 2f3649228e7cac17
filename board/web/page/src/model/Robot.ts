import { numberOf, parseHead } from "../link/words";
import { poseOf, protectionOf, statusOf, type Protection, type Status } from "./decode";
import { kEstimate, type Feature } from "./features";
import { parseFormat } from "./Format";
import { compose, inverse, type Point, type Pose } from "./geometry";
import { kindOf, type Kind } from "./kinds";
import { between, kJump, type Content, type Moment, type Way } from "./moments";
import { parseOutline, type Outline } from "./world";

/** The newest reading of a feature. */
export interface Held {
  stamp: number;
  words: Uint32Array;
}

const kTrail = 400;
const kPast = 50;
const kTrailStep = 0.03;
/** A word, and what is behind it. */
function split(line: string): [string, string] {
  const blank = line.indexOf(" ");
  return blank < 0 ? [line, ""] : [line.slice(0, blank), line.slice(blank + 1)];
}

const kLongestLabel = 48; // the board's names have at most 32 characters

/** A robot as the page knows it. Mutable: the drawing loop reads what the connection writes. */
export class Robot {
  name = "";
  team = "";
  player = "";
  /** The player that it had until somebody commanded it. */
  takenFrom = "";
  client = 0;
  /** The record under way: its file's name, or "failed"; "": none. */
  record = "";
  /** Why it has failed. */
  recordProblem = "";
  truth: Pose | null = null;
  /** States of its manipulators, four bits each. */
  states = 0;
  features: Feature[] = [];
  isDescribed = false;
  outlines: Outline[] = [];
  radius = 0.25;
  height = 0.4;
  speed = 1;
  turn = 2;
  manipulators: { name: string; states: string[] }[] = [];
  readonly readings = new Map<string, Held>();
  /** Counts what came of them. */
  version = 0;
  trail: Point[] = [];
  /** Where it was lately, to compare with estimates that come later. */
  private past: Moment[] = [];
  /** Of a record: what it holds, where the robot was in all of it, scans of it all, and which moments have maps [us]. */
  contents: Content[] = [];
  way: Way | null = null;
  along: (Held & { feature: string; pose: Pose })[] | null = null;
  mapMoments: number[] = [];
  /** Where odometry's origin was in the field when it was last joined to the truth. */
  private odometryOrigin: Pose | null = null;

  constructor(readonly number: number) {}

  /** Its name, or its number; the beginning of what is too long for any place on the page. */
  get label(): string {
    const { name } = this;
    return name.length > kLongestLabel ? `${name.slice(0, kLongestLabel)}…` : name || `robot ${this.number}`;
  }

  feature(name: string): Feature | undefined {
    return this.features.find((feature) => feature.name === name);
  }

  /** The first feature of a kind. */
  featureOf(kind: Kind["name"]): Feature | undefined {
    return this.features.find((feature) => feature.kind.name === kind);
  }

  /** The newest reading of that feature. */
  heldOf(kind: Kind["name"]): Held | undefined {
    const feature = this.featureOf(kind);
    return feature && this.readings.get(feature.name);
  }

  /** Status of its localization; null without one. */
  get status(): Status | null {
    const feature = this.featureOf("track");
    const held = feature && this.readings.get(feature.name);
    return held ? statusOf(feature.kind, held.words) : null;
  }

  /** What bounds its estimate's error; null without one. */
  get protection(): Protection | null {
    const held = this.heldOf("protection");
    return held ? protectionOf(held.words) : null;
  }

  /** Pose at which it is drawn: the true one, or else its estimate. */
  get pose(): Pose | null {
    return this.truth ?? this.estimate ?? this.odometry;
  }

  get estimate(): Pose | null {
    return this.poseIn(this.readings.get(kEstimate));
  }

  get odometry(): Pose | null {
    return this.poseIn(this.heldOf("odometry"));
  }

  private poseIn(held: Held | undefined): Pose | null {
    return held ? poseOf(held.words) : null;
  }

  /** Where it would be by odometry alone since `joinOdometry`. */
  get ghost(): Pose | null {
    const { odometry } = this;
    if (!odometry) return null;
    if (!this.odometryOrigin) this.joinOdometry();
    return this.odometryOrigin && compose(this.odometryOrigin, odometry);
  }

  joinOdometry(): void {
    const { odometry } = this;
    const pose = this.truth ?? this.estimate;
    this.odometryOrigin = odometry && pose ? compose(pose, inverse(odometry)) : null;
  }

  /**
   * Where it was at @p stamp: between the two moments around it, or at the one next to it if that
   * is no farther away than @p most [us]; null if nothing is known of that time.
   */
  truthAt(stamp: number, most = Infinity): Pose | null {
    const { past } = this;
    const next = past.findIndex((one) => one.stamp >= stamp);
    if (next > 0) {
      const [before, behind] = [past[next - 1]!, past[next]!];
      return behind.stamp - before.stamp <= 4 * most ? between(before, behind, stamp) : null;
    }
    const nearest = next === 0 ? past[0]! : past.at(-1);
    if (nearest) return Math.abs(nearest.stamp - stamp) <= most ? nearest : null;
    return most === Infinity ? this.truth : null;
  }

  setTruth(pose: Pose, stamp: number): void {
    this.truth = pose;
    const newest = this.past.at(-1);
    if (newest && stamp < newest.stamp) this.past = [];
    else if (newest?.stamp === stamp) this.past.pop();
    this.past.push({ ...pose, stamp });
    if (this.past.length > kPast) this.past.shift();
    const last = this.trail.at(-1);
    const moved = last ? Math.hypot(pose.x - last.x, pose.y - last.y) : Infinity;
    if (last && moved > kJump) this.trail = [];
    if (moved < kTrailStep) return;
    this.trail.push({ x: pose.x, y: pose.y });
    if (this.trail.length > kTrail) this.trail.splice(0, this.trail.length - kTrail);
  }

  startOver(): void {
    this.trail = [];
    this.past = [];
    this.readings.clear();
    this.version++;
    this.odometryOrigin = null;
  }

  describe(lines: string[]): void {
    this.features = [];
    this.outlines = [];
    this.manipulators = [];
    this.isDescribed = true;
    for (const line of lines) this.describeFeature(line);
    for (const line of lines) this.describeMore(line);
  }

  private describeFeature(line: string): void {
    const [name, text] = split(line);
    if (!/^[^/ ]+\/[^/ ]+\/[^/ ]+$/.test(name)) return;
    this.features.push({ name, text, kind: kindOf(null), mount: { x: 0, y: 0, theta: 0 } });
  }

  /** What lines tell of the features and of the robot. */
  private describeMore(line: string): void {
    const [first, rest] = split(line);
    const { words, keys } = parseHead(rest);
    if (first === "format") {
      const [name, format] = split(rest);
      const feature = this.feature(name);
      if (feature) feature.kind = kindOf(parseFormat(format));
    } else if (first === "mount") {
      const feature = this.feature(words[0] ?? "");
      if (!feature) return;
      feature.mount = { x: numberOf(keys, "x_m", 0), y: numberOf(keys, "y_m", 0), theta: numberOf(keys, "theta_rad", 0) };
    } else if (first === "limits") {
      this.speed = numberOf(keys, "v_m_s", 1);
      this.turn = numberOf(keys, "w_rad_s", 2);
    } else if (first === "body") {
      this.radius = numberOf(keys, "radius_m", 0.25);
      this.height = numberOf(keys, "height_m", 0.4);
    } else if (first === "manipulator") {
      this.manipulators.push({ name: words[0] ?? "", states: words.slice(1) });
    } else if (first === "outline") {
      const outline = parseOutline(line);
      if (outline) this.outlines.push(outline);
    }
  }

  /** Whether a part of it counts in its present state. */
  shows(outline: Outline): boolean {
    if (!outline.manipulator) return true;
    const index = this.manipulators.findIndex((one) => one.name === outline.manipulator);
    if (index < 0 || index > 7) return false;
    return this.manipulators[index]!.states[(this.states >>> (4 * index)) & 15] === outline.state;
  }
}
