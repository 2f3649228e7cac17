import { Robot } from "./Robot";
import { emptyDrawing, isPitch, type Drawing, type World } from "./world";
import type { Pose } from "./geometry";

/** A line that was said to the server, and what became of it. */
export interface Said {
  id: number;
  time: number;
  line: string;
  outcome: string;
  isError: boolean;
  times: number;
}

export interface Happening { number: number; stamp: number; what: string; text: string }
export interface PlayerOption { key: string; unit: string; text: string }
export interface PlayerKind { name: string; text: string; options: PlayerOption[] }
export interface Playing { robot: string; player: string; team: string }
export interface MovableState extends Pose { name: string; z: number }

/** What the page wants to see of the selected robot beside its usual features. */
export interface Wishes {
  samples: boolean;
  pictures: Set<string>;
  /** Of all robots, not of the selected one alone. */
  all: boolean;
}

const kMostSaid = 300;

/**
 * All that the page knows of the server's world. The connection writes it; the drawing loop reads
 * it each frame (`frame` says whether anything is new), panels at most ten times a second.
 */
export class Board {
  link: "connecting" | "open" | "lost" | "refused" = "connecting";
  linkText = "";
  /** Whether the server would let us steer with a token: why we have none. */
  needsToken: "wrong" | "missing" | null = null;
  role = "";
  kind = "";
  worldName = "";
  commands = new Set<string>();
  hasWorldTruth = false;

  world: World | null = null;
  drawing: Drawing = emptyDrawing();
  /** Counts what changes rarely: world, drawing, robots and their outlines. */
  scene = 0;
  /** Counts everything that is drawn. */
  frame = 0;

  now = 0;
  nowAt = 0;
  state = "";
  status = new Map<string, string>();
  game = new Map<string, string>();
  happenings: Happening[] = [];
  nextHappening = 0;
  playerKinds: PlayerKind[] = [];
  /** Names of the robots that ship with the program. */
  robotKinds: string[] = [];
  playing: Playing[] = [];

  robots = new Map<number, Robot>();
  objects: MovableState[] = [];
  selected = 0;

  said: Said[] = [];
  errors = new Map<string, string>();
  private nextSaid = 1;
  private readonly listeners = new Set<() => void>();

  get robot(): Robot | null {
    return this.robots.get(this.selected) ?? null;
  }

  get isOperator(): boolean {
    return this.link === "open" && this.role === "operator";
  }

  /** Whether it is a game, with a score: on a pitch, or because a referee has begun one. */
  get isGame(): boolean {
    if (this.kind !== "simulation") return false;
    return isPitch(this.drawing) || (this.game.get("phase") ?? "free") !== "free";
  }

  can(command: string): boolean {
    return this.commands.has(command);
  }

  /** Something changed that panels show. */
  touch(): void {
    for (const listener of this.listeners) listener();
  }

  onTouch(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  setNow(stamp: number): void {
    if (!Number.isFinite(stamp)) return;
    this.now = stamp;
    this.nowAt = performance.now();
  }

  /** Notes what is said. Repetitions of the same command in a row are one line. */
  say(line: string): Said {
    const verb = (text: string) => text.split(" ")[0];
    const last = this.said.at(-1);
    const repeats = verb(line) === "VELOCITY" || verb(line) === "PLACE" || verb(line) === "SEEK";
    if (last && repeats && verb(last.line) === verb(line) && !last.isError) {
      last.line = line;
      last.times += 1;
      last.time = Date.now();
      return last;
    }
    const said = { id: this.nextSaid++, time: Date.now(), line, outcome: "…", isError: false, times: 1 };
    this.said.push(said);
    if (this.said.length > kMostSaid) this.said.shift();
    this.touch();
    return said;
  }
}
