// A board with more on it than most: ten robots, a ball, 10,000 samples ten times a second, maps of 40,000 cells.
// It measures what the page makes of that (node e2e/load.mjs), where the real program would need the processor itself.
import { createServer } from "node:net";

const kRobots = 10;
const kSamples = 10_000;
const kMiddle = 2 ** 31;
const fields = [
  ...[[-6, -4, 6, -4], [6, -4, 6, 4], [6, 4, -6, 4], [-6, 4, -6, -4], [0, -4, 0, 4], [-6, -1.5, -5, -1.5], [-5, -1.5, -5, 1.5],
    [-5, 1.5, -6, 1.5], [6, -1.5, 5, -1.5], [5, -1.5, 5, 1.5], [5, 1.5, 6, 1.5]].map(
    ([x0, y0, x1, y1]) => `line x0_m=${x0} y0_m=${y0} x1_m=${x1} y1_m=${y1} width_m=0.05`),
  "arc x_m=0 y_m=0 rx_m=1 ry_m=1 angle_rad=0 from_rad=0 to_rad=6.283185307179586 width_m=0.05",
  ...[[-7, -5, 7, -5], [7, -5, 7, 5], [7, 5, -7, 5], [-7, 5, -7, -5]].map(
    ([x0, y0, x1, y1]) => `wall x0_m=${x0} y0_m=${y0} x1_m=${x1} y1_m=${y1} z0_m=0 z1_m=0.5`),
  "goal name=blue x_m=-6.25 y_m=0 theta_rad=0 dx_m=0.25 dy_m=1 height_m=1 colour=blue",
  "goal name=yellow x_m=6.25 y_m=0 theta_rad=3.141592653589793 dx_m=0.25 dy_m=1 height_m=1 colour=yellow",
  ...[[-6.5, -4.5], [-6.5, 4.5], [6.5, 4.5], [6.5, -4.5]].map(([x, y], i) => `landmark kind=post id=${i + 1} x_m=${x} y_m=${y} z_m=0`),
];
const formats = {
  "LMS200/LRF/180DegreeScan": "scan beams=180 first_deg=-90 step_deg=1.00558659 max_m=8",
  "mcl/LOCALIZATION/pose": "fix",
  "mcl/LOCALIZATION/status": "track status=tracking,uncertain,lost reason=readings_fit cause=none,a_pose_was_given",
  "mcl/LOCALIZATION/protection": "protection",
  "mcl/LOCALIZATION/samples": "samples",
  "mcl/LOCALIZATION/places": "clusters",
  "mcl/LOCALIZATION/work": "work",
};
const robot = [
  ...Object.keys(formats),
  ...Object.entries(formats).map(([name, format]) => `format ${name} ${format}`),
  "body radius_m=0.25 height_m=0.5 mass_kg=30",
  "limits v_m_s=1.5 w_rad_s=4 a_m_s2=2 alpha_rad_s2=15",
  "manipulator kicker rest kick",
  "outline z0_m=0 z1_m=0.5 -0.25,-0.2 0.1,-0.25 0.22,-0.15 0.22,0.15 0.1,0.25 -0.25,0.2",
  "outline manipulator=kicker state=kick z0_m=0.05 z1_m=0.2 0.22,-0.1 0.3,-0.1 0.3,0.1 0.22,0.1",
];

const poseAt = (time, n) => {
  const phase = time * 0.3 + n * 0.7;
  return { x: 5 * Math.sin(phase), y: 3.4 * Math.sin(2 * phase + n), theta: phase % (2 * Math.PI) };
};
const mm = (metres) => kMiddle + Math.round(metres * 1000);
const centidegrees = (angle) => ((Math.round((angle * 18000) / Math.PI) % 36000) + 36000) % 36000;

function reading(stamp, feature, words) {
  return Buffer.concat([Buffer.from(`${stamp} ${feature} ${words.length}\n`), Buffer.from(Uint32Array.from(words).buffer)]);
}

function readingsOf(number, time, wants) {
  const stamp = Math.round(time * 1e6);
  if (number === 0) {
    const robots = [];
    for (let n = 1; n <= kRobots; ++n) {
      const { x, y, theta } = poseAt(time, n);
      robots.push(n, mm(x), mm(y), centidegrees(theta), Math.floor(time) % 2);
    }
    return [reading(stamp, "world/truth/robots", robots),
      reading(stamp, "world/truth/objects", [mm(2 * Math.sin(time)), mm(Math.cos(1.3 * time)), mm(0.11), 0])];
  }
  const { x, y, theta } = poseAt(time, number);
  const samples = new Uint32Array(wants.includes("samples") ? 4 * kSamples : 0);
  for (let i = 0; i < samples.length; i += 4) {
    const [a, b, c] = [Math.sin(i * 12.9898), Math.sin(i * 78.233), Math.sin(i * 37.719)];
    samples[i] = mm(x + 0.7 * a * a * a);
    samples[i + 1] = mm(y + 0.5 * b * b * b);
    samples[i + 2] = centidegrees(theta + 0.4 * c);
    samples[i + 3] = 65535 * Math.exp(-2 * (a * a + b * b));
  }
  const fix = [mm(x + 0.05), mm(y - 0.04), centidegrees(theta + Math.PI), 120000, 60000, 20000, 14000, 10000, 10000];
  const readings = [
    reading(stamp, "LMS200/LRF/180DegreeScan", Array.from({ length: 180 }, (_, i) => 2500 + Math.round(1200 * Math.sin(i / 9)))),
    reading(stamp, "mcl/LOCALIZATION/pose", fix),
    reading(stamp, "mcl/LOCALIZATION/status", [0, 0, 9300, 9800, 1, 1]),
    reading(stamp, "mcl/LOCALIZATION/protection", [500000, 100000]),
    reading(stamp, "mcl/LOCALIZATION/places", [8800, ...fix, 1200, mm(-x), mm(-y), ...fix.slice(2)]),
    reading(stamp, "mcl/LOCALIZATION/work", [kSamples, 6200 + Math.round(800 * Math.sin(time)), 5400, Math.round(10 * time)]),
  ];
  if (samples.length) readings.push(reading(stamp, "mcl/LOCALIZATION/samples", samples));
  return readings;
}

function heat(time, cells) {
  const step = cells >= 40000 ? 0.06 : 0.22;
  const [columns, rows] = [Math.floor(14 / step), Math.floor(10 / step)];
  const bytes = Buffer.alloc(columns * rows);
  const { x, y } = poseAt(time, 1);
  for (let row = 0, i = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column, ++i) {
      const distance = Math.hypot(-7 + column * step - x, -5 + row * step - y);
      bytes[i] = Math.abs(-7 + column * step) > 6.8 ? 0 : 1 + Math.round(254 * Math.exp(-distance * distance));
    }
  }
  return { bytes, keys: `columns=${columns} rows=${rows} x_min_m=-7 y_min_m=-5 step_m=${step} low=0 high=0.94` };
}

function talk(socket) {
  const now = () => performance.now() / 1000; // one clock for all connections
  const timers = new Map();
  const update = (head, robotNumber, wants) => {
    const bytes = Buffer.concat(readingsOf(robotNumber, now(), wants));
    socket.write(`${head} robot=${robotNumber} now=${Math.round(now() * 1e6)} bytes=${bytes.length} readings=1\n`);
    socket.write(bytes);
  };
  const answers = {
    HELLO: () => "role=operator kind=simulation world=load now=0 state=running",
    HELP: () => ["DESCRIBE", "GAME", "HEATMAP", "WHY", "LOCALIZE", "PLACE", "EVENTS"],
    STATUS: () => `state=running now=${Math.round(now() * 1e6)} cycles=1 missed=0 speed=1 achieved=1 seed=7`,
    LIST: () => Array.from({ length: kRobots }, (_, i) => `robot=${i + 1} name=robot${i + 1} client=0 team=${i % 2 ? "blue" : "yellow"}`),
    GAME: () => "phase=playing half=1 clock_s=3 blue=1 yellow=2 left=blue",
    EVENTS: () => [],
    LOCALIZE: () => "robot=1 state=running progress=1",
    PLACE: () => "",
    UNSUBSCRIBE: () => "",
  };
  const perform = (tag, line) => {
    const [verb, what] = line.split(" ");
    const number = Number(/ robot=(\d+)/.exec(line)?.[1] ?? 1);
    if (verb === "DESCRIBE") {
      const lines = { world: ["world=load kind=simulation x_min_m=-7 y_min_m=-5 x_max_m=7 y_max_m=5 cycle_s=0.01", "object=ball kind=ball radius_m=0.11 colour=orange"], field: fields, robot, robots: [], players: [] }[what];
      return `${tag} OK DESCRIBE lines=${lines.length}\n${lines.map((one) => `${one}\n`).join("")}`;
    }
    if (verb === "SUBSCRIBE") {
      const period = number === 0 ? 20 : 100;
      clearInterval(timers.get(number));
      timers.set(number, setInterval(() => socket.writableLength < 1e6 && update("* UPDATE", number, line), period));
      return `${tag} OK SUBSCRIBE robot=${number}\n`;
    }
    if (verb === "READ") return update(`${tag} OK READ`, number, line), "";
    if (verb === "HEATMAP") {
      const { bytes, keys } = heat(now(), Number(/cells=(\d+)/.exec(line)?.[1] ?? 40000));
      socket.write(`${tag} OK HEATMAP robot=1 stamp=0 ${keys} bytes=${bytes.length}\n`);
      return socket.write(bytes), "";
    }
    if (verb === "WHY") {
      const lines = ["LMS200/LRF/180DegreeScan p=0.72 values=180", ...Array.from({ length: 180 }, (_, i) => `value LMS200/LRF/180DegreeScan ${i} unit=m measured=${(2.5 + 1.2 * Math.sin(i / 9)).toFixed(3)} expected=${(2.6 + 1.1 * Math.sin(i / 9)).toFixed(3)}`), "omnivision/camera/post1Bearing p=0.31 values=1", "value omnivision/camera/post1Bearing 0 unit=rad measured=0.2 expected=0.31"];
      return `${tag} OK WHY robot=1 p=0.22 lines=${lines.length}\n${lines.join("\n")}\n`;
    }
    const answer = answers[verb]?.();
    if (answer === undefined) return `${tag} ERR unknown there is no command ${verb}\n`;
    if (Array.isArray(answer)) return `${tag} OK ${verb} lines=${answer.length}\n${answer.map((one) => `${one}\n`).join("")}`;
    return `${tag} OK ${verb} ${answer}\n`;
  };
  let rest = "";
  socket.on("data", (bytes) => {
    const lines = (rest + bytes).split("\n");
    rest = lines.pop();
    for (const line of lines) {
      const match = /^(#\S+) (.*)$/.exec(line);
      if (match) socket.write(perform(match[1], match[2]));
    }
  });
  socket.on("error", () => {});
  socket.on("close", () => timers.forEach((timer) => clearInterval(timer)));
}

/** @returns the port that the board listens on */
export async function startLoad() {
  const server = createServer(talk);
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { port: server.address().port, close: () => server.close() };
}
