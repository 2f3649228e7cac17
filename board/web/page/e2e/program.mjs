// The real program, a second client of its board, and a real browser, for the tests.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { createConnection } from "node:net";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { createInterface } from "node:readline";
import { chromium } from "playwright-core";

const here = dirname(fileURLToPath(import.meta.url));
export const root = join(here, "..", "..", "..", "..");
export const out = join(here, "out");
const program = process.env.ORTUNG ?? join(root, "build", "dev", "bin", "ortung");
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
mkdirSync(out, { recursive: true });

/** Asks again until the answer is not false; @throws what it last said after @p seconds */
export async function until(what, ask, seconds = 30) {
  const end = Date.now() + seconds * 1000;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (Date.now() > end) throw new Error(`it never came about that ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Runs `ortung WORDS` to its end. */
export function runProgram(words) {
  return spawnSync(program, words, { cwd: root, encoding: "utf8" });
}

/** Starts `ortung WORDS --listen PORT --view` and reads the address that it prints. */
export async function startProgram(words, port = 0) {
  const all = [...words, "--listen", String(port), "--view", "--no-browser", ...(words[0] === "sim" ? ["--idle", "600"] : [])];
  const env = { ...process.env, ORTUNG_VIEW_PATH: process.env.ORTUNG_VIEW_PATH ?? join(root, "board", "web", "built") };
  const child = spawn(program, all, { cwd: root, env, stdio: ["ignore", "pipe", "pipe"] });
  process.on("exit", () => child.kill()); // also after a test that failed
  let errors = "";
  child.stderr.on("data", (bytes) => (errors += bytes));
  const ended = new Promise((resolve) => child.on("exit", resolve));
  const url = await new Promise((resolve, reject) => {
    createInterface({ input: child.stdout }).on("line", (line) => {
      const match = /view and control: +(http\S+)/.exec(line);
      if (match) resolve(new URL(match[1]));
    });
    ended.then(() => reject(new Error(`the program ended before it listened: ${errors.slice(0, 500)}`)));
  });
  const stop = async () => {
    child.kill("SIGTERM");
    await ended;
  };
  return { url, port: Number(url.port), token: new URLSearchParams(url.hash.slice(1)).get("token"), stop };
}

/** A client that speaks the protocol over TCP: what the page does must be seen by others. */
export async function startClient({ port, token }, name = "view") {
  const socket = createConnection({ host: "127.0.0.1", port });
  const lines = createInterface({ input: socket })[Symbol.asyncIterator]();
  const next = async () => (await lines.next()).value ?? "";
  const ask = async (line) => {
    socket.write(`${line}\n`);
    let reply = await next();
    while (reply.startsWith("* SAY ")) reply = await next();
    if (!reply.startsWith("OK ")) throw new Error(`${line}: ${reply}`);
    const count = Number(/ lines=(\d+)/.exec(reply)?.[1] ?? 0);
    const rest = [];
    for (let i = 0; i < count; ++i) rest.push(await next());
    return [reply, ...rest];
  };
  await ask(name === "view" ? `HELLO ortung/1 name=view role=operator token=${token}` : `HELLO ortung/1 name=${name}`);
  return {
    ask,
    close: () => socket.destroy(),
    async robots() {
      const [, ...found] = await ask("LIST robots");
      return found.map((line) => ({ number: Number(/robot=(\d+)/.exec(line)[1]), name: / name=(\S+)/.exec(line)[1] }));
    },
    async pose(robot) {
      const [, line] = await ask(`READ */groundTruth/* robot=${robot}`);
      const words = line.split(" ").slice(3).map(Number);
      return { x: (words[0] - 2 ** 31) / 1000, y: (words[1] - 2 ** 31) / 1000, theta: (words[2] - 18000) / 100 };
    },
    async key(command, key) {
      return new RegExp(` ${key}=(\\S+)`).exec((await ask(command))[0])?.[1];
    },
  };
}

export function startBrowser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--enable-unsafe-swiftshader",
      "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
}

/** A page that fails the test if its console has an error: a broken policy, a shader, an exception. */
export async function openPage(browser, url, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, ...options });
  page.setDefaultTimeout(15000);
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error.stack ?? error)));
  page.on("console", (message) => {
    const isOfNetwork = /ERR_CONNECTION|WebSocket connection to/.test(message.text());
    if (message.type() === "error" && !isOfNetwork) page.problems.push(message.text());
  });
  const mutant = process.env.__STRYKER_ACTIVE_MUTANT__; // of dev/mutate.mjs
  if (mutant) await page.addInitScript((id) => (globalThis.__stryker__ = { activeMutant: id }), mutant);
  await page.goto(String(url));
  return page;
}

/** Where a point of the field is on the screen. */
export async function onScreen(page, x, y) {
  const [a, b, c, d, e, f] = await page.locator(".over > g").first().evaluate((group) =>
    /matrix\((.*)\)/.exec(group.getAttribute("transform"))[1].split(" ").map(Number));
  const box = await page.locator(".over").boundingBox();
  return { x: box.x + a * x + c * y + e, y: box.y + b * x + d * y + f };
}

/** Nothing in a panel is wider than it is, and nothing that axe finds fault with, in dark and in light; a picture of each. */
export async function checkAccess(page, what) {
  const tooWide = await page.locator(".panel").evaluateAll((all) => Math.max(...all.map((panel) => panel.scrollWidth - panel.clientWidth)));
  assert.ok(tooWide <= 0, `${what}: the panel's contents are ${tooWide} px wider than the panel`);
  for (const colorScheme of ["dark", "light"]) {
    await page.emulateMedia({ colorScheme });
    // Until the page has seen it: colours are of the system, not of the style sheet alone.
    await page.waitForFunction((scheme) => document.documentElement.dataset.theme === scheme, colorScheme);
    // Colours fade into each other.
    await page.evaluate(() => Promise.all(document.getAnimations().map((animation) => animation.finished.catch(() => {}))));
    // The policy of the page permits no script from elsewhere: the debugger puts it in.
    const found = await page.evaluate(`${axe}; axe.run()`);
    const texts = found.violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 160)).join(" | ")}`);
    assert.deepEqual(texts, [], `${what}, ${colorScheme}`);
    await page.screenshot({ path: join(out, `${what}-${colorScheme}.png`) });
  }
}
