import { BoardError, type Reply } from "../link/Connection";
import { numberOf, parseHead, plain } from "../link/words";
import { degrees, radians, type Pose } from "./geometry";
import type { Expected, Heat } from "./maps";
import type { Session } from "./Session";

/** A map of one feature ("" of all together). */
export interface FeatureMap {
  feature: string;
  heat: Heat;
  low: number;
  high: number;
  /** When the newest reading was taken that it is of [us]; of an exported page, the moment it was made for. */
  stamp: number;
}

export interface WhyFeature {
  feature: string;
  p: number;
  values: { index: number; unit: string; measured: number | null; expected: number | null }[];
}

export interface Why {
  pose: Pose;
  p: number;
  features: WhyFeature[];
}

export interface Localize {
  state: string;
  progress: number;
  text: string;
}

/** What the user wants to know of the filter's view of the field. */
export interface MapWish {
  /** Heading [rad]; null: the best of all. */
  theta: number | null;
  of: "probability" | "expectation";
  /** Of probabilities. */
  scale: "linear" | "log";
  index: number;
  /** Features that are left out of the product. */
  without: Set<string>;
  /** Also a map of each feature. */
  each: boolean;
}

/** From one map to the next, and what is left to the server between them [ms]. */
const kMapPeriod = 110;
const kRest = 15;
const kSlowPause = 500;
const kCells = 40000;
const kSmallCells = 3000;

/**
 * Asks how the filter sees the field: maps of p(s given l), why, and what is expected where it is. One request at a time on
 * a connection of its own: what was wished last is asked next, and what comes for another robot is dropped.
 */
export class Insight {
  readonly wish: MapWish = { theta: null, of: "probability", scale: "log", index: 0, without: new Set(), each: false };
  /** Whether maps are wanted at all, and whether what is expected is. */
  wantsMap = false;
  wantsExpected = false;
  wantsLocalize = false;
  map: FeatureMap | null = null;
  small: FeatureMap[] = [];
  features: string[] = [];
  why: Why | null = null;
  expected: Expected | null = null;
  localize: Localize | null = null;
  error = "";
  /** Maps a second, measured. */
  rate = 0;
  private isRunning = false;
  private lastMap = 0;
  /** What the map is of; the same is not asked again. */
  private mapped = "";
  private nextSmall = 0;
  /** How many of the small maps are as new as the large one. */
  private smallAsked = 0;
  /** Counts robots that were looked at. */
  private turn = 0;
  /** Ends the pause between two questions for the filter's state. */
  private askSoon: () => void = () => {};

  constructor(
    private readonly session: Session,
    private readonly changed: () => void,
  ) {
    session.onLocalize = () => this.askSoon();
  }

  start(): void {
    if (this.isRunning) return;
    this.isRunning = true;
    void this.run(() => this.askSlow());
    void this.run(() => this.askState(), (end) => (this.askSoon = end));
  }

  /** Forgets all, since another robot is looked at. */
  clear(): void {
    this.turn++;
    this.map = this.why = this.expected = this.localize = null;
    this.small = [];
    this.features = [];
    this.mapped = "";
    this.error = "";
    this.changed();
  }

  /** Asks again and again; @p once says how long to wait, and @p waits is given what ends the wait early. */
  private async run(once: () => Promise<number>, waits?: (end: () => void) => void): Promise<void> {
    for (;;) {
      let pause = kSlowPause;
      const { board } = this.session;
      const { turn } = this;
      try {
        if (board.link === "open" && board.robot && !document.hidden) pause = await once();
      } catch (error) {
        if (!(error instanceof BoardError)) throw error;
        if (turn === this.turn && board.link === "open" && this.wantsMap) this.error = error.message;
        this.mapped = "";
      }
      await new Promise<void>((resolve) => {
        waits?.(resolve);
        setTimeout(resolve, pause);
      });
    }
  }

  private async askState(): Promise<number> {
    if (this.wantsLocalize && this.session.board.can("LOCALIZE")) {
      await this.askLocalize();
      this.changed();
    }
    return kSlowPause;
  }

  private async askSlow(): Promise<number> {
    const { session, turn } = this;
    const { board } = session;
    const began = performance.now();
    const wantsMap = this.wantsMap && board.can("HEATMAP");
    const wantsWhy = board.can("WHY") && (this.wantsExpected || (wantsMap && !this.features.length));
    if (!wantsMap && (this.map || this.small.length)) this.forgetMaps();
    if (!this.wantsExpected && this.expected) this.expected = null;
    if (!wantsMap && !wantsWhy) {
      session.side.close();
      return kSlowPause / 4;
    }
    const at = wantsWhy && (board.robot!.truth ?? board.robot!.estimate ?? (wantsMap ? this.middle : null));
    const why = at ? await this.askWhy(at) : null;
    if (turn !== this.turn) return 0;
    if (why) {
      this.features = why.features.map(({ feature }) => feature);
      this.expected = this.wantsExpected ? expectedOf(why) : null;
    }
    if (wantsMap) await this.askMaps(began, turn);
    if (turn === this.turn) this.changed();
    return Math.max(kRest, kMapPeriod - (performance.now() - began));
  }

  /** Where to ask which features there are, if nobody knows where the robot is. */
  private get middle(): Pose {
    const { world } = this.session.board;
    return world ? { x: (world.min.x + world.max.x) / 2, y: (world.min.y + world.max.y) / 2, theta: 0 } : { x: 0, y: 0, theta: 0 };
  }

  private forgetMaps(): void {
    this.map = null;
    this.small = [];
    this.mapped = "";
    this.rate = this.lastMap = 0;
    this.changed();
  }

  private get chosen(): string[] {
    const { without } = this.wish;
    return without.size ? this.features.filter((feature) => !without.has(feature)) : [];
  }

  private async askMaps(began: number, turn: number): Promise<void> {
    const { wish } = this;
    if (wish.of === "expectation" && this.features.length - wish.without.size !== 1) {
      this.error = "choose one feature above to show what it expects";
      this.map = null;
      this.mapped = "";
      return;
    }
    // Readings that are not new make the same map.
    const what = [this.session.readings, wish.theta, wish.of, wish.scale, wish.index, wish.each, ...wish.without].join(" ");
    if (what !== this.mapped) {
      const map = await this.askMap("", this.chosen, kCells);
      if (turn !== this.turn) return;
      this.map = map;
      this.mapped = what;
      this.smallAsked = 0;
      this.error = "";
      this.count();
    }
    if (wish.each) await this.askSmall(began + kMapPeriod, turn);
    else this.small = [];
  }

  private count(): void {
    const time = performance.now();
    if (this.lastMap) this.rate = 0.8 * this.rate + (0.2 * 1000) / Math.max(1, time - this.lastMap);
    this.lastMap = time;
  }

  /** Maps of one feature each: as many as there is time for, the oldest first. */
  private async askSmall(until: number, turn: number): Promise<void> {
    const { features } = this;
    if (this.smallAsked >= features.length) return;
    const known = new Map(this.small.map((map) => [map.feature, map]));
    do {
      const feature = features[this.nextSmall++ % features.length]!;
      const map = await this.askMap(feature, [feature], kSmallCells);
      if (turn !== this.turn) return;
      known.set(feature, map);
    } while (++this.smallAsked < features.length && performance.now() < until);
    this.small = features.flatMap((feature) => known.get(feature) ?? []);
  }

  private async askMap(feature: string, queries: string[], cells: number): Promise<FeatureMap> {
    const { wish } = this;
    const parts = [`HEATMAP robot=${this.session.board.selected}`, ...queries, `cells=${cells}`];
    if (wish.theta !== null) parts.push(`theta_deg=${plain(degrees(wish.theta))}`);
    const isExpectation = wish.of === "expectation" && feature === "";
    if (!isExpectation && wish.scale === "log") parts.push("scale=log");
    if (isExpectation) parts.push("of=expectation", `index=${wish.index}`);
    return { feature, ...parseMap(await this.session.side.ask(parts.join(" "))) };
  }

  /** Why the filter finds @p pose as probable as it does. */
  async explain(pose: Pose): Promise<void> {
    this.why = await this.askWhy(pose);
    this.changed();
  }

  private async askWhy({ x, y, theta }: Pose): Promise<Why | null> {
    const { board } = this.session;
    const at = `x_m=${plain(x)} y_m=${plain(y)} theta_deg=${plain(degrees(theta))}`;
    return parseWhy(await this.session.side.ask(`WHY robot=${board.selected} ${at}`), { x, y, theta });
  }

  private async askLocalize(): Promise<void> {
    try {
      this.localize = parseLocalize(await this.session.ask(`LOCALIZE robot=${this.session.board.selected}`));
    } catch (error) {
      if (!(error instanceof BoardError) || error.code === "closed") throw error;
      this.localize = { state: "none", progress: 0, text: error.message };
    }
  }
}

export function parseLocalize({ keys, words }: Reply): Localize {
  return {
    state: keys.get("state") ?? "?",
    progress: Math.min(1, Math.max(0, numberOf(keys, "progress", 0))),
    text: words.join(" "),
  };
}

/** @throws BoardError if the bytes are not those of a map */
export function parseMap({ keys, bytes }: Reply): Omit<FeatureMap, "feature"> {
  const columns = numberOf(keys, "columns", 0);
  const rows = numberOf(keys, "rows", 0);
  const step = numberOf(keys, "step_m", 0);
  const isMap = columns > 0 && rows > 0 && step > 0 && bytes !== null && bytes.length === columns * rows;
  if (!isMap) throw new BoardError("reply", "the map has another number of cells than its reply says", "HEATMAP");
  return {
    heat: { columns, rows, step, x: numberOf(keys, "x_min_m", 0), y: numberOf(keys, "y_min_m", 0), cells: bytes },
    low: numberOf(keys, "low", 0),
    high: numberOf(keys, "high", 1),
    stamp: numberOf(keys, "moment", numberOf(keys, "stamp", 0)),
  };
}

export function parseWhy({ keys, lines }: Reply, pose: Pose): Why {
  const features: WhyFeature[] = [];
  for (const line of lines) {
    const { words, keys: of } = parseHead(line);
    // Infinite: nothing is (or should be) within reach.
    const optional = (key: string) => (of.has(key) ? numberOf(of, key, of.get(key) === "inf" ? Infinity : NaN) : null);
    if (words[0] === "value") {
      const feature = features.find((one) => one.feature === words[1]);
      feature?.values.push({
        index: Number(words[2]),
        unit: of.get("unit") ?? "",
        measured: optional("measured"),
        expected: optional("expected"),
      });
    } else if (words[0]) {
      features.push({ feature: words[0], p: numberOf(of, "p", 0), values: [] });
    }
  }
  // An exported page answers for the place that is next to the one it was asked for.
  const at = {
    x: numberOf(keys, "x_m", pose.x),
    y: numberOf(keys, "y_m", pose.y),
    theta: keys.has("theta_deg") ? radians(numberOf(keys, "theta_deg", 0)) : pose.theta,
  };
  return { pose: at, p: numberOf(keys, "p", 0), features };
}

export function expectedOf(why: Why): Expected {
  const expected: Expected = new Map();
  for (const { feature, values } of why.features) {
    const map = new Map<number, number>();
    for (const { index, expected: value } of values) if (value !== null && Number.isFinite(value)) map.set(index, value);
    expected.set(feature, map);
  }
  return expected;
}
