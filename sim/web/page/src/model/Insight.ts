import type { Heat } from "../field/Cloud";
import type { Expected } from "../field/rays";
import { BoardError, type Reply } from "../link/Connection";
import { numberOf, parseHead, plain } from "../link/words";
import { degrees, type Pose } from "./geometry";
import type { Session } from "./Session";

/** A map of one feature ("" of all together). */
export interface FeatureMap {
  feature: string;
  heat: Heat;
  low: number;
  high: number;
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
  index: number;
  /** Features that are left out of the product. */
  without: Set<string>;
  /** Also a map of each feature. */
  each: boolean;
}

const kPause = 60;
const kSlowPause = 500;
const kSmallCells = 3000;

/** Asks how the filter sees the field: maps of p(s given l), why, and what is expected where it is. */
export class Insight {
  readonly wish: MapWish = { theta: null, of: "probability", index: 0, without: new Set(), each: false };
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

  constructor(
    private readonly session: Session,
    private readonly changed: () => void,
  ) {}

  start(): void {
    if (this.isRunning) return;
    this.isRunning = true;
    void this.run();
  }

  /** Forgets all, since another robot is looked at. */
  clear(): void {
    this.map = this.why = this.expected = this.localize = null;
    this.small = [];
    this.features = [];
    this.error = "";
    this.changed();
  }

  private async run(): Promise<void> {
    for (;;) {
      let pause = kSlowPause;
      try {
        if (this.session.board.link === "open" && !document.hidden) pause = await this.once();
      } catch (error) {
        if (!(error instanceof BoardError)) throw error;
        if (error.code !== "closed") this.error = error.message;
      }
      await new Promise((resolve) => setTimeout(resolve, pause));
    }
  }

  private async once(): Promise<number> {
    const { board } = this.session;
    const robot = board.robot;
    if (!robot) return kSlowPause;
    if (this.wantsLocalize && board.can("LOCALIZE")) await this.askLocalize();
    let isBusy = false;
    if (board.can("WHY") && (this.wantsExpected || (this.wantsMap && !this.features.length))) {
      const at = robot.truth ?? robot.estimate;
      const why = at && (await this.askWhy(at));
      if (why) {
        this.features = why.features.map(({ feature }) => feature);
        this.expected = expectedOf(why);
        isBusy = true;
      }
    }
    if (this.wantsMap && board.can("HEATMAP")) {
      await this.askMaps();
      isBusy = true;
    } else if (this.map) {
      this.map = null;
      this.small = [];
    }
    if (!this.wantsExpected) this.expected = null;
    this.changed();
    return isBusy ? kPause : kSlowPause;
  }

  private get chosen(): string[] {
    const { without } = this.wish;
    return without.size ? this.features.filter((feature) => !without.has(feature)) : [];
  }

  private async askMaps(): Promise<void> {
    const { wish } = this;
    if (wish.of === "expectation" && this.features.length - wish.without.size !== 1) {
      this.error = "an expectation is that of one feature: choose it above";
      this.map = null;
      return;
    }
    this.map = await this.askMap("", this.chosen, 40000);
    this.error = "";
    const time = performance.now();
    if (this.lastMap) this.rate = 0.8 * this.rate + (0.2 * 1000) / Math.max(1, time - this.lastMap);
    this.lastMap = time;
    this.changed();
    if (!wish.each) {
      this.small = [];
      return;
    }
    const small: FeatureMap[] = [];
    for (const feature of this.features) {
      small.push(await this.askMap(feature, [feature], kSmallCells));
    }
    this.small = small;
  }

  private async askMap(feature: string, queries: string[], cells: number): Promise<FeatureMap> {
    const { wish } = this;
    const parts = [`HEATMAP robot=${this.session.board.selected}`, ...queries, `cells=${cells}`];
    if (wish.theta !== null) parts.push(`theta_deg=${plain(degrees(wish.theta))}`);
    if (wish.of === "expectation" && feature === "") parts.push("of=expectation", `index=${wish.index}`);
    return { feature, ...parseMap(await this.session.ask(parts.join(" "))) };
  }

  /** Why the filter finds @p pose as probable as it does. */
  async explain(pose: Pose): Promise<void> {
    this.why = await this.askWhy(pose);
    this.changed();
  }

  private async askWhy({ x, y, theta }: Pose): Promise<Why | null> {
    const { board } = this.session;
    const at = `x_m=${plain(x)} y_m=${plain(y)} theta_deg=${plain(degrees(theta))}`;
    return parseWhy(await this.session.ask(`WHY robot=${board.selected} ${at}`), { x, y, theta });
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
  if (!isMap) throw new BoardError("reply", "the map that came has not as many cells as it says", "HEATMAP");
  return {
    heat: { columns, rows, step, x: numberOf(keys, "x_min_m", 0), y: numberOf(keys, "y_min_m", 0), cells: bytes },
    low: numberOf(keys, "low", 0),
    high: numberOf(keys, "high", 1),
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
  return { pose, p: numberOf(keys, "p", 0), features };
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
