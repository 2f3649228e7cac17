import { greeting } from "../link/address";
import { BoardError, Connection, type Reply, type Unasked, type Line } from "../link/Connection";
import { SideLine } from "../link/SideLine";
import { readingsOf, type Reading } from "../link/readingsIn";
import { numberOf, plain } from "../link/words";
import { Board, type Wishes } from "./Board";
import { poseOf } from "./decode";
import { History } from "./History";
import { Past } from "./Past";
import type { Robot } from "./Robot";
import { takeRobots } from "./roster";
import { parseGame, parseHappenings, parsePlayerKinds, parsePlaying } from "./soccer";
import { takeWorld } from "./truth";
import { emptyDrawing, parseDrawing, parseWorld } from "./world";

const kWorldPeriod = 0.02;
const kFeaturePeriod = 0.05;
const kMostQueries = 60;
const kPoll = 1000;
const kAhead = 2;
const kTruth = "reference/groundTruth/pose";

/** Keeps a Board like the world of a server, as long as there is one. */
export class Session {
  readonly board = new Board();
  readonly history = new History();
  readonly wishes: Wishes = { samples: true, pictures: new Set(), all: false };
  readonly connection: Connection;
  /** For what takes long: maps, and why a place is probable. */
  readonly side: SideLine;
  /** What records hold as a whole, over a connection of its own. */
  readonly past: Past;
  /** Counts what came of the selected robot. */
  readings = 0;
  private polling: ReturnType<typeof setInterval> | undefined;
  private truthPolling: ReturnType<typeof setInterval> | undefined;
  private isPolling = false;
  private isReadingTruth = false;
  private subscribed = "";
  private worldPeriod = 0;
  /** " ahead=N" if the server lets us say how many updates may be under way. */
  private ahead = "";
  /** Called when the user has begun or ended a robot's localization. */
  onLocalize: () => void = () => {};
  /** Updates that were read and not yet acknowledged, by robot. */
  private readonly got: number[] = [];

  constructor(
    dial: () => Line,
    private token: string,
  ) {
    this.connection = new Connection(dial, {
      opened: () => void this.greet(),
      closed: (why, againIn) => this.lost(why, againIn),
      unasked: (unasked) => this.unasked(unasked),
    });
    this.side = new SideLine(dial, () => greeting(this.token, "viewer"));
    this.past = new Past(this.board, this.history, new SideLine(dial, () => greeting(this.token, "viewer")));
  }

  start(): void {
    this.connection.open();
  }

  ask(line: string): Promise<Reply> {
    return this.connection.request(line);
  }

  /** Asks what an older server may not know: null if it refuses. */
  async tryAsk(line: string): Promise<Reply | null> {
    try {
      return await this.ask(line);
    } catch (error) {
      if (error instanceof BoardError && error.code === "closed") throw error;
      return null;
    }
  }

  /**
   * Does what the user wants: says it, notes the line and what became of it; an error is shown at
   * @p where.
   */
  async act(line: string, where: string): Promise<Reply | null> {
    const { board } = this;
    const said = board.say(line);
    try {
      const reply = await this.ask(line);
      said.outcome = "OK";
      board.errors.delete(where);
      this.acted(line.split(" ")[0]!.toUpperCase());
      return reply;
    } catch (error) {
      said.isError = true;
      said.outcome = error instanceof BoardError ? `ERR ${error.code} ${error.message}` : String(error);
      board.errors.set(where, error instanceof Error ? error.message : String(error));
      return null;
    } finally {
      board.touch();
    }
  }

  select(robot: number): void {
    const { board } = this;
    if (board.selected === robot) return;
    board.selected = robot;
    this.history.clear();
    board.frame++;
    board.touch();
    if (board.link === "open") void this.follow();
  }

  /** To be called when `wishes` have changed. */
  wish(): void {
    if (this.board.link === "open") void this.follow();
  }

  /** Gives a robot that was driven back to the player that it was taken from, if there was one. */
  async giveBack(number: number): Promise<void> {
    if (!this.board.can("RETURN") || !this.board.isOperator) return;
    try {
      await this.listRobots();
    } catch (error) {
      if (!(error instanceof BoardError)) throw error;
    }
    if (this.board.robots.get(number)?.takenFrom) await this.act(`RETURN robot=${number}`, "drive");
  }

  private acted(verb: string): void {
    if (verb === "LOCALIZE") this.onLocalize();
    if (verb === "PLAY" || verb === "STOP" || verb === "RESET" || verb === "RECORD" || verb === "RETURN") void this.poll();
    if (verb === "RESET") this.startOver();
    if (verb === "PAUSE" || verb === "RESUME" || verb === "SPEED" || verb === "REFEREE") void this.poll();
    if (verb === "SEEK") {
      for (const robot of this.board.robots.values()) robot.startOver();
      void this.readOnce();
    }
    if ((verb === "PLACE" || verb === "STEP") && this.board.state !== "running") void this.readOnce();
  }

  /** What stands still is not sent again: asks for it. */
  private async readOnce(): Promise<void> {
    try {
      if (this.board.hasWorldTruth) this.takeReadings(0, await this.ask("READ robot=0 form=binary"));
      else await this.readTruth();
      for (const robot of this.followed) {
        const features = this.wanted(robot);
        if (features.length) this.takeReadings(robot.number, await this.ask(`READ robot=${robot.number} form=binary ${features.join(" ")}`));
      }
    } catch {
      // the connection is gone: all is read anew with the next one
    }
  }

  private async greet(): Promise<void> {
    const { board } = this;
    try {
      const hello = await this.ask(greeting(this.token, "operator"));
      board.role = hello.keys.get("role") ?? "viewer";
      board.kind = hello.keys.get("kind") ?? "";
      board.worldName = hello.keys.get("world") ?? "";
      board.state = hello.keys.get("state") ?? "";
      board.setNow(numberOf(hello.keys, "now", 0));
      board.link = "open";
      this.connection.settled();
      board.touch();
      await this.learnAll();
    } catch (error) {
      if (error instanceof BoardError && error.code !== "closed") {
        board.link = "refused";
        this.connection.fail(error.message);
      } else if (!(error instanceof BoardError)) {
        throw error;
      }
    }
  }

  /** A server that was started anew has another token: then we look on until we get it. */
  private withoutToken(): void {
    this.board.needsToken = this.token ? "wrong" : "missing";
    this.token = "";
  }

  /** Comes in again with a token. */
  useToken(token: string): void {
    this.token = token;
    this.board.needsToken = null;
    this.connection.comeAgain();
  }

  private async learnAll(): Promise<void> {
    const { board } = this;
    const help = await this.tryAsk("HELP");
    // A line of HELP begins with the command, with square brackets around what may be left out.
    board.commands = new Set(help?.lines.map((line) => /^[A-Z]+/.exec(line)?.[0] ?? "") ?? []);
    this.ahead = help?.lines.some((line) => /^SUBSCRIBE .*\[ahead=N\]/.test(line)) ? ` ahead=${kAhead}` : "";
    this.got.length = 0;
    this.subscribed = "";
    this.worldPeriod = 0;
    board.nextHappening = 0;
    board.happenings = [];
    this.forgetRecord();
    const world = await this.tryAsk("DESCRIBE world");
    if (world) board.world = parseWorld(world.lines);
    const drawing = await this.tryAsk("DESCRIBE field");
    if (drawing) board.drawing = parseDrawing(drawing.lines);
    board.scene++;
    board.frame++;
    await this.listRobots();
    await this.followWorld();
    await this.follow();
    void this.past.learn();
    const kinds = board.kind === "simulation" ? await this.tryAsk("DESCRIBE players") : null;
    board.playerKinds = kinds ? parsePlayerKinds(kinds.lines) : [];
    const robots = board.kind === "simulation" ? await this.tryAsk("DESCRIBE robots") : null;
    board.robotKinds = robots?.lines.flatMap((line) => /^robot (\S+)/.exec(line)?.[1] ?? []) ?? [];
    await this.poll();
    clearInterval(this.polling);
    this.polling = setInterval(() => void this.poll(), kPoll);
  }

  /** Another record may be shown now by the same server: of robots and field nothing is sure any more. */
  private forgetRecord(): void {
    const { board } = this;
    if (board.kind !== "record") return;
    board.robots.clear();
    board.drawing = emptyDrawing();
    this.history.whole = null;
    this.history.clear();
  }

  private lost(why: string, againIn: number): void {
    const { board } = this;
    clearInterval(this.polling);
    clearInterval(this.truthPolling);
    this.side.close();
    this.past.close();
    board.link = board.link === "refused" ? "refused" : "lost";
    board.linkText = `${why}; trying again${againIn >= 1 ? ` in ${Math.round(againIn)} s` : ""}`;
    board.touch();
  }

  private async poll(): Promise<void> {
    if (this.isPolling || this.board.link !== "open") return;
    this.isPolling = true;
    try {
      await this.pollOnce();
    } catch (error) {
      if (!(error instanceof BoardError)) throw error;
    } finally {
      this.isPolling = false;
    }
  }

  private async pollOnce(): Promise<void> {
    const { board } = this;
    const status = await this.ask("STATUS");
    board.status = status.keys;
    board.state = status.keys.get("state") ?? board.state;
    board.setNow(numberOf(status.keys, "now", board.now));
    await this.listRobots();
    await this.followWorld();
    if (board.can("GAME")) {
      const game = await this.tryAsk("GAME");
      if (game) board.game = parseGame(game.keys);
    } else {
      const score = await this.tryAsk("SCORE");
      if (score) board.game = score.keys;
    }
    if (board.can("PLAYERS")) {
      const players = await this.tryAsk("PLAYERS");
      if (players) board.playing = parsePlaying(players.lines);
    }
    if (board.can("EVENTS")) {
      const events = await this.tryAsk(`EVENTS since=${board.nextHappening}`);
      if (events) {
        board.happenings = [...board.happenings, ...parseHappenings(events.lines)].slice(-1000);
        board.nextHappening = numberOf(events.keys, "next", board.nextHappening);
      }
    }
    // Updates come with cycles: what changed since the last one that we could take would not come.
    if (board.state !== "running") await this.readOnce();
    board.touch();
  }

  private async listRobots(): Promise<void> {
    const { board } = this;
    const list = await this.ask("LIST robots");
    for (const number of takeRobots(board, list.lines)) {
      if (this.subscribed.includes(` robot=${number} `)) this.subscribed = "";
    }
    for (const robot of board.robots.values()) {
      if (robot.record === "failed" && !robot.recordProblem) {
        robot.recordProblem = (await this.tryAsk(`RECORD robot=${robot.number}`))?.words.join(" ") || "it has failed";
      }
      if (robot.isDescribed) continue;
      const text = await this.tryAsk(`DESCRIBE robot robot=${robot.number}`);
      robot.describe(text?.lines ?? []);
      board.scene++;
    }
    board.frame++;
    if (!board.robots.has(board.selected) && board.robots.size) {
      board.selected = Math.min(...board.robots.keys());
      this.history.clear();
    }
    if (this.board.link === "open" && this.subscribed === "") await this.follow();
  }

  /** How many seconds of the world pass in one: periods of subscriptions are the world's. */
  private get hurry(): number {
    const { status } = this.board;
    const achieved = numberOf(status, "achieved", 1);
    // What was asked bounds it: a seek looks like a moment of great hurry.
    const asked = numberOf(status, "speed", 1) || Infinity;
    return 2 ** Math.max(0, Math.round(Math.log2(Math.max(1, Math.min(asked, achieved)))));
  }

  private async followWorld(): Promise<void> {
    const { board } = this;
    const period = kWorldPeriod * this.hurry;
    if (period === this.worldPeriod) return;
    this.worldPeriod = period;
    clearInterval(this.truthPolling);
    const reply = await this.tryAsk(`SUBSCRIBE robot=0 period_s=${plain(period)}${this.ahead} form=binary */truth/*`);
    board.hasWorldTruth = reply !== null;
    if (reply) return void this.readOnce();
    this.truthPolling = setInterval(() => void this.readTruth(), 100);
    await this.readTruth();
  }

  /** Of a server that does not show the world itself: each robot's own ground truth. */
  private async readTruth(): Promise<void> {
    if (this.isReadingTruth) return;
    this.isReadingTruth = true;
    try {
      await Promise.all(
        [...this.board.robots.values()].map(async (robot) => {
          const reply = await this.tryAsk(`READ */groundTruth/* robot=${robot.number}`);
          for (const reading of reply ? readingsOf(reply) : []) this.takeTruth(robot, reading);
        }),
      );
    } catch (error) {
      if (!(error instanceof BoardError)) throw error;
    } finally {
      this.isReadingTruth = false;
    }
  }

  private takeTruth(robot: Robot, reading: Reading): void {
    const pose = poseOf(reading.words);
    if (!pose) return;
    robot.setTruth(pose, reading.stamp);
    this.board.frame++;
  }

  /** Names of the features of a robot that are looked at. */
  private wanted(robot: Robot): string[] {
    const { pictures, samples } = this.wishes;
    return robot.features
      .filter(({ kind, name }) => (kind.name !== "image" || pictures.has(name)) && (kind.name !== "samples" || samples))
      .map(({ name }) => name)
      .slice(0, kMostQueries);
  }

  /** The robots whose readings are looked at. */
  private get followed(): Robot[] {
    const { board, wishes } = this;
    return wishes.all ? [...board.robots.values()] : board.robot ? [board.robot] : [];
  }

  /** Subscribes to what is wanted of them, and ends what was subscribed of others. */
  private async follow(): Promise<void> {
    const { board, followed } = this;
    const period = plain(kFeaturePeriod * this.hurry);
    const wanted = followed.map((robot) => ({ robot, features: this.wanted(robot) })).filter(({ features }) => features.length);
    const lines = wanted.map(({ robot, features }) =>
      `SUBSCRIBE robot=${robot.number} period_s=${period}${this.ahead} form=binary ${features.join(" ")}`);
    if (!lines.length || lines.join("\n") === this.subscribed) return;
    const before = [...this.subscribed.matchAll(/ robot=(\d+) /g)].map(([, number]) => Number(number));
    this.subscribed = lines.join("\n");
    try {
      for (const number of before) {
        if (board.hasWorldTruth && wanted.every(({ robot }) => robot.number !== number)) await this.tryAsk(`UNSUBSCRIBE robot=${number}`);
      }
      for (const line of lines) await this.tryAsk(line);
      for (const { robot, features } of wanted) {
        const newest = await this.tryAsk(`READ robot=${robot.number} form=binary ${features.join(" ")}`);
        if (newest) this.takeReadings(robot.number, newest);
      }
    } catch (error) {
      if (!(error instanceof BoardError)) throw error;
    }
  }

  private unasked({ word, keys, text, message }: Unasked): void {
    const { board } = this;
    const robot = numberOf(keys, "robot", -1);
    if (word === "UPDATE") {
      this.takeReadings(robot, { ...message, keys });
      if (this.ahead) this.got.push(robot);
    }
    if (word === "RESET") this.startOver();
    else if (word === "REMOVE") void this.poll();
    else if (word === "ERR" && text.startsWith("token ")) this.withoutToken();
    board.touch();
  }

  /** To be called each frame: what was read is drawn, so the server may send what is newest then. */
  drawn(): void {
    for (const robot of this.got.splice(0)) this.ask(`GOT robot=${robot}`).catch(() => {});
  }

  private startOver(): void {
    const { board } = this;
    for (const robot of board.robots.values()) robot.startOver();
    this.history.clear();
    board.happenings = [];
    board.nextHappening = 0;
    board.frame++;
    this.subscribed = "";
    void this.poll().then(() => this.readOnce());
  }

  private takeReadings(number: number, from: { keys: Map<string, string>; lines: string[]; bytes: Uint8Array | null }): void {
    const { board } = this;
    if (from.keys.has("now")) board.setNow(numberOf(from.keys, "now", board.now));
    const readings = readingsOf(from);
    if (number === 0) {
      for (const reading of readings) takeWorld(board, reading);
    } else {
      const robot = board.robots.get(number);
      if (!robot) return;
      for (const reading of readings) {
        robot.readings.set(reading.feature, reading);
        if (!board.hasWorldTruth && reading.feature === kTruth) this.takeTruth(robot, reading);
        if (number === board.selected) this.history.take(robot, reading);
      }
      robot.version++;
      if (number === board.selected) this.readings++;
    }
    board.frame++;
    board.touch();
  }
}
