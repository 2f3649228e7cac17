import { KeptMaps, type Answer, type PackedMoment } from "./KeptMaps";
import { parseHead, numberOf, type Head } from "./words";

/** A run within the page, as `ortung export html` writes it. */
export interface RecordedRun {
  world: string[];
  field: string[];
  truth: string[];
  events: string[];
  /**
   * By robot: its lines of DESCRIBE, its readings as lines, compressed (gzip) in base64, and moments that have maps, each
   * a text of JSON in the same way.
   */
  robots: { name: string; describe: string[]; readings: string; maps?: PackedMoment[] }[];
  end_us: number;
}

interface Track {
  stamps: Float64Array;
  features: string[];
  lines: string[];
}

interface Subscription {
  robot: number;
  queries: string[];
  told: number;
}

const kTick = 40;
const kBefore = 3_000_000;
const kTruth = "world/truth/robots";
const kCommands = [
  "HELLO", "HELP", "TIME", "STATUS", "LIST", "DESCRIBE", "READ", "SUBSCRIBE [robot=N]", "UNSUBSCRIBE", "SCORE",
  "PAUSE", "RESUME", "STEP", "SPEED", "SEEK", "RESET", "EVENTS", "CONTENTS", "HISTORY", "BYE",
];
const kOfMaps = ["HEATMAP", "WHY", "MOMENTS"];
const kMostReadings = 5000;

async function unpacked(base64: string): Promise<string> {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).text();
}

function trackOf(text: string): Track {
  const lines = text.split("\n").filter((line) => line !== "");
  return {
    stamps: Float64Array.from(lines, (line) => Number(line.slice(0, line.indexOf(" ")))),
    features: lines.map((line) => line.split(" ", 2)[1] ?? ""),
    lines,
  };
}

/** How many stamps are not behind a time. */
export function countUntil(stamps: Float64Array, time: number): number {
  let low = 0;
  let high = stamps.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (stamps[middle]! <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}

export function matches(queries: string[], feature: string): boolean {
  if (!queries.length) return true;
  const parts = feature.split("/");
  return queries.some((query) => query.split("/").every((part, i) => part === "*" || part === parts[i]));
}

/** A reading of `groundTruth` as the words of a robot of `world/truth/robots`. */
export function truthWords(number: number, line: string): string {
  const [x, y, heading] = line.split(" ").slice(3);
  return `${number} ${x} ${y} ${(Number(heading) + 18000) % 36000} 0`;
}

/** Time and readings of a run, which all connections of the page share. */
export class RecordedTime {
  now = 0;
  speed = 1;
  isPlaying = true;
  tracks: Track[] = [];
  readonly maps: KeptMaps[];
  readonly ready: Promise<void>;
  private ticked = performance.now();

  constructor(readonly run: RecordedRun) {
    this.maps = run.robots.map(({ maps }) => new KeptMaps(maps ?? [], unpacked));
    this.ready = Promise.all(run.robots.map((robot) => unpacked(robot.readings))).then((texts) => {
      this.tracks = texts.map(trackOf);
      this.ticked = performance.now();
    });
  }

  get hasMaps(): boolean {
    return this.maps.some(({ stamps }) => stamps.length > 0);
  }

  tick(): void {
    const wall = performance.now();
    const passed = (wall - this.ticked) * 1000 * this.speed;
    this.ticked = wall;
    if (this.isPlaying) this.now = Math.max(this.now, Math.min(this.run.end_us, this.now + passed));
  }

  goTo(time: number): void {
    this.now = Math.max(0, Math.min(this.run.end_us, time));
  }
}

/**
 * The message board of a run that is in the page itself: takes the place of a WebSocket, so that the
 * page shows a run without a server as it would with one.
 */
export class RecordedBoard {
  readyState: number = WebSocket.CONNECTING;
  binaryType: BinaryType = "arraybuffer";
  onopen: ((event: Event) => void) | null = null;
  onmessage: ((event: MessageEvent) => void) | null = null;
  onclose: ((event: CloseEvent) => void) | null = null;

  private subscriptions = new Map<number, Subscription>();
  private timer: ReturnType<typeof setInterval> | undefined;
  private pushed = -1;
  private readonly decoder = new TextDecoder();
  private readonly encoder = new TextEncoder();
  /** Answers come in the order of requests; some take long. */
  private answered: Promise<void> = Promise.resolve();

  constructor(private readonly time: RecordedTime) {
    void this.begin();
  }

  private get run(): RecordedRun {
    return this.time.run;
  }

  private get tracks(): Track[] {
    return this.time.tracks;
  }

  private get now(): number {
    return this.time.now;
  }

  send(data: string | ArrayBufferLike | ArrayBufferView | Blob): void {
    const text = typeof data === "string" ? data : this.decoder.decode(data as Uint8Array);
    for (const line of text.split("\n")) if (line) this.answered = this.answered.then(() => this.take(line));
  }

  close(): void {
    clearInterval(this.timer);
    this.readyState = WebSocket.CLOSED;
  }

  private async begin(): Promise<void> {
    await this.time.ready;
    if (this.readyState === WebSocket.CLOSED) return;
    this.readyState = WebSocket.OPEN;
    this.timer = setInterval(() => this.tick(), kTick);
    this.onopen?.(new Event("open"));
  }

  private say(line: string, lines: string[] | null = null): void {
    const head = lines ? `${line} lines=${lines.length}` : line;
    const data = [head, ...(lines ?? []), ""].join("\n");
    // Later, as over a network.
    queueMicrotask(() => this.onmessage?.(new MessageEvent("message", { data })));
  }

  private sayBytes(line: string, bytes: Uint8Array): void {
    const head = this.encoder.encode(`${line} bytes=${bytes.length}\n`);
    const data = new Uint8Array(head.length + bytes.length);
    data.set(head);
    data.set(bytes, head.length);
    queueMicrotask(() => this.onmessage?.(new MessageEvent("message", { data: data.buffer })));
  }

  private tick(): void {
    const { time } = this;
    time.tick();
    if (this.pushed === time.now) return;
    this.pushed = time.now;
    for (const subscription of this.subscriptions.values()) this.push(subscription);
  }

  private push(subscription: Subscription): void {
    const lines = this.newest(subscription.robot, subscription.queries, subscription.told);
    subscription.told = this.now;
    if (lines.length) this.say(`* UPDATE robot=${subscription.robot} now=${Math.round(this.now)}`, lines);
  }

  /** The last reading of each feature behind one time and up to now. */
  private newest(robot: number, queries: string[], since: number): string[] {
    if (robot === 0) return this.truth(queries, since);
    const track = this.tracks[robot - 1];
    if (!track) return [];
    const found = new Map<string, string>();
    const begin = countUntil(track.stamps, since);
    for (let i = countUntil(track.stamps, this.now) - 1; i >= begin; --i) {
      const feature = track.features[i]!;
      if (!found.has(feature) && matches(queries, feature)) found.set(feature, track.lines[i]!);
    }
    return [...found.values()].reverse();
  }

  private truth(queries: string[], since: number): string[] {
    if (!matches(queries, kTruth)) return [];
    const words: string[] = [];
    let stamp = 0;
    this.tracks.forEach((_, i) => {
      const lines = this.newest(i + 1, ["*/groundTruth/*"], Math.min(since, this.now - kBefore));
      const last = lines[lines.length - 1];
      if (!last) return;
      words.push(truthWords(i + 1, last));
      stamp = Math.max(stamp, Number(last.slice(0, last.indexOf(" "))));
    });
    if (!words.length) return [];
    return [`${stamp} ${kTruth} ${5 * words.length} ${words.join(" ")}`];
  }

  private get state(): string {
    return !this.time.isPlaying ? "paused" : this.now >= this.run.end_us ? "ended" : "running";
  }

  private async take(request: string): Promise<void> {
    const [, tag = "", text = ""] = /^(?:#(\S+) )?(.*)$/.exec(request) ?? [];
    const { words, keys } = parseHead(text);
    const command = words.shift() ?? "";
    const sign = tag ? `#${tag} ` : "";
    const ok = (more = "", lines: string[] | null = null) =>
      this.say(`${sign}OK ${command}${more ? ` ${more}` : ""}`, lines);
    const now = `now=${Math.round(this.now)}`;
    const robot = numberOf(keys, "robot", 1);
    switch (command) {
      case "HELLO":
        return ok(`ortung/1 client=1 role=operator kind=record world=run ${now} state=${this.state}`);
      case "HELP":
        return ok("", this.time.hasMaps ? [...kCommands, ...kOfMaps] : kCommands);
      case "TIME":
        return ok(`received=${Math.round(this.now)} sent=${Math.round(this.now)}`);
      case "STATUS": {
        const pace = `speed=${this.time.speed} achieved=${this.time.speed}`;
        return ok(`state=${this.state} ${now} cycles=0 missed=0 clients=1 robots=${this.tracks.length} ${pace}`);
      }
      case "LIST":
        return ok("", this.run.robots.map(({ name }, i) => `robot=${i + 1} name=${name} client=0`));
      case "DESCRIBE":
        return this.describe(words[0] ?? "", robot, ok, sign);
      case "READ":
        return ok(`robot=${robot} ${now}`, this.newest(robot, words, this.now - kBefore));
      case "SUBSCRIBE":
        ok(`robot=${robot}`);
        this.subscriptions.set(robot, { robot, queries: words, told: this.now - kBefore });
        return this.push(this.subscriptions.get(robot)!);
      case "UNSUBSCRIBE":
        this.subscriptions.delete(robot);
        return ok();
      case "SCORE":
        return ok("left=0 right=0");
      case "EVENTS": {
        const since = numberOf(keys, "since", 0);
        return ok(`next=${this.run.events.length}`, this.run.events.slice(since));
      }
      case "PAUSE":
      case "RESUME":
        this.time.isPlaying = command === "RESUME";
        return ok(now);
      case "SPEED":
        this.time.speed = Number(words[0]) || 1000;
        return ok();
      case "STEP":
        this.goTo(this.now + 20_000 * numberOf(keys, "cycles", 1));
        return ok();
      case "CONTENTS":
        return ok(`robot=${robot}`, this.contents(robot));
      case "HISTORY":
        return ok(`robot=${robot}`, this.history(robot, words, numberOf(keys, "most", 1000)));
      case "MOMENTS":
        return ok(`robot=${robot}`, (this.time.maps[robot - 1]?.stamps ?? []).map(String));
      case "HEATMAP":
      case "WHY":
        return this.answer(`${sign}OK ${command}`, sign, await this.insight(command, robot, { words, keys }));
      case "SEEK":
      case "RESET":
        this.goTo(1e6 * numberOf(keys, "time_s", 0));
        return ok(`now=${Math.round(this.now)}`);
      default:
        return this.say(`${sign}ERR unknown there is no command ${command}`);
    }
  }

  private insight(command: string, robot: number, head: Head): Promise<Answer> {
    const maps = this.time.maps[robot - 1];
    if (!maps?.stamps.length) return Promise.resolve({ error: "state this run was exported without maps: --maps N" });
    return command === "WHY" ? maps.why(this.now, head, robot) : maps.map(this.now, head, robot);
  }

  private answer(head: string, sign: string, answer: Answer): void {
    if ("error" in answer) this.say(`${sign}ERR ${answer.error}`);
    else if (answer.bytes) this.sayBytes(`${head} ${answer.words}`, answer.bytes);
    else this.say(`${head} ${answer.words}`, answer.lines ?? null);
  }

  private contents(robot: number): string[] {
    const track = this.tracks[robot - 1];
    const found = new Map<string, { count: number; first: number; last: number }>();
    track?.features.forEach((feature, i) => {
      const stamp = track.stamps[i]!;
      const one = found.get(feature) ?? { count: 0, first: stamp, last: stamp };
      found.set(feature, { count: one.count + 1, first: one.first, last: stamp });
    });
    return [...found].map(([feature, { count, first, last }]) => `${feature} readings=${count} first_us=${first} last_us=${last}`);
  }

  /** At most so many readings of each feature, evenly chosen, the last one among them. */
  private history(robot: number, queries: string[], most: number): string[] {
    const track = this.tracks[robot - 1];
    if (!track || !queries.length) return [];
    const limit = Math.max(1, Math.min(kMostReadings, most));
    const counts = new Map<string, number>();
    for (const feature of track.features) counts.set(feature, (counts.get(feature) ?? 0) + 1);
    const wanted = new Set([...counts.keys()].filter((feature) => matches(queries, feature)));
    const passed = new Map<string, number>();
    return track.lines.filter((_, at) => {
      const feature = track.features[at]!;
      if (!wanted.has(feature)) return false;
      const i = passed.get(feature) ?? 0;
      passed.set(feature, i + 1);
      const count = counts.get(feature)!;
      return count <= limit || Math.floor(((i + 1) * limit) / count) > Math.floor((i * limit) / count);
    });
  }

  private describe(
    what: string,
    robot: number,
    ok: (more: string, lines: string[]) => void,
    sign: string,
  ): void {
    if (what === "world") return ok("", this.run.world);
    if (what === "field") return ok("", this.run.field);
    if (what === "robot") return ok("", robot === 0 ? this.run.truth : (this.run.robots[robot - 1]?.describe ?? []));
    this.say(`${sign}ERR syntax this run has no ${what}`);
  }

  private goTo(time: number): void {
    this.time.goTo(time);
    for (const subscription of this.subscriptions.values()) {
      subscription.told = this.now - kBefore;
      this.push(subscription);
    }
  }
}
