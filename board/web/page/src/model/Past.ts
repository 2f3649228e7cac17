import { BoardError, type Reply } from "../link/Connection";
import { readingsOf, type Reading } from "../link/readingsIn";
import type { SideLine } from "../link/SideLine";
import { numberOf, parseHead } from "../link/words";
import type { Board } from "./Board";
import { poseOf } from "./decode";
import { bestOf, momentAt, type Content, type Way } from "./moments";
import { kEstimate } from "./features";
import type { History } from "./History";
import type { Robot } from "./Robot";

const kIdle = 1000;
const kPoses = 2000;
const kScans = 60;
const kOdometry = "odometry/odometry/pose";

export function wayOf(readings: Reading[]): Way {
  const way: Way = { truth: [], estimate: [], odometry: [] };
  for (const { stamp, feature, words } of readings) {
    const pose = poseOf(words);
    if (!pose) continue;
    const moment = { ...pose, stamp };
    if (feature === kEstimate) way.estimate.push(moment);
    else if (feature === kOdometry) way.odometry.push(moment);
    else if (feature.split("/")[1] === "groundTruth") way.truth.push(moment);
  }
  return way;
}

export function contentsOf(lines: string[]): Content[] {
  return lines.flatMap((line) => {
    const { words, keys } = parseHead(line);
    if (!words[0]) return [];
    const number = (key: string) => numberOf(keys, key, 0);
    return [{ feature: words[0], readings: number("readings"), first: number("first_us"), last: number("last_us") }];
  });
}

/** What records hold as a whole: asked once, over a connection of its own, beside what is played of them. */
export class Past {
  private isLearning = false;
  private isFilling = false;
  private asks = 0;

  constructor(
    private readonly board: Board,
    private readonly history: History,
    private readonly line: SideLine,
  ) {}

  get isThere(): boolean {
    return this.board.kind === "record" && this.board.can("HISTORY");
  }

  close(): void {
    this.line.close();
  }

  private async ask(line: string): Promise<Reply> {
    this.asks++;
    try {
      return await this.line.ask(line);
    } finally {
      this.asks--;
      // The next question often comes at once.
      setTimeout(() => this.asks || this.close(), kIdle);
    }
  }

  /** Contents and ways of all robots, and which moments have maps; then series have all of the time at once. */
  async learn(): Promise<void> {
    const { board, history } = this;
    if (!this.isThere || this.isLearning || !board.world) return;
    this.isLearning = true;
    history.whole = { begin: board.world.start / 1e6, end: board.world.end / 1e6, wanted: () => void this.fill() };
    try {
      for (const robot of [...board.robots.values()]) if (!robot.way) await this.learnOf(robot);
    } catch (error) {
      if (!(error instanceof BoardError)) throw error;
    } finally {
      this.isLearning = false;
    }
    await this.fill();
  }

  private async learnOf(robot: Robot): Promise<void> {
    const { board } = this;
    const of = `robot=${robot.number}`;
    robot.contents = contentsOf((await this.ask(`CONTENTS ${of}`)).lines);
    if (board.can("MOMENTS")) robot.mapMoments = (await this.ask(`MOMENTS ${of}`)).lines.map(Number).filter(Number.isFinite);
    robot.way = wayOf(await this.readings(robot, ["*/groundTruth/*", kEstimate, kOdometry], kPoses));
    board.scene++;
    board.frame++;
    board.touch();
  }

  /** Readings of the whole record, of each feature so many. */
  private async readings(robot: Robot, features: string[], most: number): Promise<Reading[]> {
    return readingsOf(await this.ask(`HISTORY robot=${robot.number} ${features.join(" ")} most=${most}`));
  }

  /** Gives the series of the selected robot their values. */
  private async fill(): Promise<void> {
    const { board, history } = this;
    const { robot } = board;
    if (!robot || this.isFilling) return;
    this.isFilling = true;
    try {
      const others = [...board.robots.values()].filter((one) => one !== robot && one.way);
      if (robot.way) history.takeWays(robot.way, new Map(others.map((one) => [one.label, one.way!])));
      const { missing } = history;
      if (missing.length) history.takeWhole(robot, await this.readings(robot, missing, kPoses));
    } catch (error) {
      if (!(error instanceof BoardError)) throw error;
    } finally {
      this.isFilling = false;
      board.touch();
    }
    if (board.robot !== robot) await this.fill();
  }

  /** Some scans of the whole record, each with the pose of the robot at its time. */
  async learnScans(robot: Robot): Promise<void> {
    const { way } = robot;
    if (!this.isThere || !way || !robot.isDescribed || robot.along) return;
    const scans = robot.features.filter(({ kind }) => kind.name === "scan").map(({ name }) => name);
    robot.along = [];
    try {
      for (const reading of scans.length ? await this.readings(robot, scans, kScans) : []) {
        const pose = momentAt(bestOf(way), reading.stamp);
        if (pose) robot.along.push({ ...reading, pose });
      }
    } catch (error) {
      if (!(error instanceof BoardError)) throw error;
    }
    this.board.frame++;
    this.board.touch();
  }
}
