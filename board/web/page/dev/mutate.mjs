// Do the page's tests notice? Changes it at places drawn at random, one at a time, and runs the unit tests, then those in
// Chromium, until one fails.
//   node dev/mutate.mjs [--mutants 33] [--seed 1] [--report ../../../docs/testing.md]
// A run that was cut goes on where it was, if the page and its tests are the same.
// Stryker's instrumenter finds the places (all but texts) and puts each change behind a switch; a build has them all.
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { createRequire } from "node:module";
import { dirname, join, relative } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs } from "node:util";

const page = dirname(dirname(fileURLToPath(import.meta.url)));
const root = join(page, "..", "..", "..");
const work = join(root, "build", "mutants-page");
const { values } = parseArgs({
  options: { mutants: { type: "string", default: "33" }, seed: { type: "string", default: "1" }, report: { type: "string" } },
});
const [begin, end] = ["<!-- page mutants: begin -->", "<!-- page mutants: end -->"];

function run(command, words, options = {}) {
  return spawnSync(command, words, { encoding: "utf8", timeout: 600000, killSignal: "SIGKILL", ...options });
}

/** Stryker's instrumenter, which only this script needs. */
async function instrumenter() {
  const tools = join(work, "tools");
  const names = ["@stryker-mutator/instrumenter", "typed-inject"];
  if (!existsSync(join(tools, "node_modules"))) {
    mkdirSync(tools, { recursive: true });
    writeFileSync(join(tools, "package.json"), '{ "private": true }');
    const installed = run("npm", ["install", "--no-fund", "--no-audit", "--loglevel=error", ...names], { cwd: tools });
    if (installed.status !== 0) throw new Error(`npm install ${names.join(" ")}: ${installed.stderr}`);
  }
  const require = createRequire(join(tools, "package.json"));
  const [{ createInstrumenter }, { createInjector }] = await Promise.all(
    names.map((name) => import(pathToFileURL(require.resolve(name)))));
  const logger = new Proxy({}, { get: (_, name) => (name.startsWith("is") ? () => false : () => {}) });
  return createInjector().provideValue("logger", logger).injectFunction(createInstrumenter);
}

/** Numbers from 0 to 1, the same for a seed. */
function* randomNumbers(seed) {
  let state = 0;
  for (const letter of seed) state = (Math.imul(state, 31) + letter.codePointAt(0)) | 0;
  for (;;) {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    yield ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  }
}

/** First a kind of change, then a place, so that no kind prevails. */
function draw(mutants, count, seed) {
  const random = randomNumbers(seed);
  const take = (list) => list.splice(Math.floor(random.next().value * list.length), 1)[0];
  const byName = {};
  for (const mutant of mutants) (byName[mutant.mutatorName] ??= []).push(mutant);
  const kinds = Object.values(byName);
  const drawn = [];
  while (drawn.length < count && kinds.length > 0) {
    const at = Math.floor(random.next().value * kinds.length);
    drawn.push(take(kinds[at]));
    if (kinds[at].length === 0) kinds.splice(at, 1);
  }
  return drawn;
}

function original({ fileName, location: { start, end } }) {
  const lines = readFileSync(fileName, "utf8").split("\n").slice(start.line, end.line + 1);
  lines.push(lines.pop().slice(0, end.column));
  return [lines[0].slice(start.column), ...lines.slice(1)].join("\n");
}

/** "<" for "<=": numbers here are fractions, which are at a boundary by chance only. */
function isOfBoundary(mutant) {
  const plain = (text) => text.replace(/\s+/g, "").replace(/([<>])=/g, "$1");
  return mutant.mutatorName === "EqualityOperator" && plain(original(mutant)) === plain(mutant.replacement);
}

function sources(folder) {
  return readdirSync(folder, { recursive: true }).filter((name) => /\.tsx?$/.test(name)).map((name) => join(folder, name));
}

const copy = join(work, "page");
rmSync(copy, { recursive: true, force: true });
cpSync(page, copy, { recursive: true, filter: (name) => !/node_modules|e2e.out/.test(relative(page, name)) });
symlinkSync(join(page, "node_modules"), join(copy, "node_modules"));
const files = sources(join(page, "src")).map((name) => ({ name, content: readFileSync(name, "utf8"), mutate: true }));
const options = { plugins: null, excludedMutations: ["StringLiteral"], ignorers: [], noHeader: false };
const made = await (await instrumenter()).instrument(files, options);
for (const file of made.files) writeFileSync(join(copy, relative(page, file.name)), file.content);
const known = made.mutants.filter((mutant) => mutant.status !== "Ignored" && !isOfBoundary(mutant));
const built = join(work, "built");
const tests = readdirSync(join(page, "e2e")).filter((name) => name.endsWith(".test.mjs")).map((name) => join(page, "e2e", name));

function firstFailure(mutant) {
  const env = { ...process.env, ORTUNG_VIEW_PATH: built };
  if (mutant !== undefined) env.__STRYKER_ACTIVE_MUTANT__ = mutant;
  if (run("npx", ["vitest", "run", "--bail", "1"], { cwd: copy, env }).status !== 0) return "unit tests";
  if (run("node", ["--test", "--test-force-exit", ...tests], { cwd: page, env }).status !== 0) return "Chromium";
  return undefined;
}

const packed = run("npx", ["vite", "build", "--outDir", built, "--emptyOutDir", "--logLevel", "warn"], { cwd: copy });
if (packed.status !== 0) throw new Error(packed.stderr);
const without = firstFailure();
if (without) throw new Error(`without a mutant the ${without} fail`);
const drawn = draw(known, Number(values.mutants), values.seed);
const survivors = [];
const content = createHash("sha256");
for (const name of [...files.map((file) => file.name), ...sources(join(page, "test")), ...tests]) content.update(name).update(readFileSync(name));
const doneFile = join(work, `done-${content.digest("hex").slice(0, 16)}.json`);
const done = existsSync(doneFile) ? JSON.parse(readFileSync(doneFile, "utf8")) : {};
for (const [i, mutant] of drawn.entries()) {
  if (!(mutant.id in done)) done[mutant.id] = firstFailure(mutant.id) ?? null;
  writeFileSync(doneFile, JSON.stringify(done));
  const by = done[mutant.id];
  const { line } = mutant.location.start;
  const place = `${relative(root, mutant.fileName)}:${line + 1}`;
  const text = readFileSync(mutant.fileName, "utf8").split("\n")[line].trim().slice(0, 90);
  const change = `${mutant.mutatorName}: ${mutant.replacement.split("\n")[0].slice(0, 90)}`;
  console.error(`${i + 1}/${drawn.length} ${place} ${change}: ${by ?? "SURVIVED"}`);
  if (!by) survivors.push(`- \`${place}\` ${change} in \`${text}\``);
}
const commit = run("git", ["show", "-s", "--format=%h (%cs)", "HEAD"], { cwd: root }).stdout.trim();
const noticed = drawn.length - survivors.length;
const report = [`${noticed} of ${drawn.length} (${Math.round((100 * noticed) / drawn.length)} %) of ${known.length} places, seed ` +
  `${values.seed}, of commit ${commit}. Not noticed:`, "", ...survivors].join("\n");
console.log(report);
if (values.report) {
  const whole = readFileSync(values.report, "utf8");
  const [head, rest] = [whole.slice(0, whole.indexOf(begin)), whole.slice(whole.indexOf(end))];
  writeFileSync(values.report, `${head}${begin}\n${report}\n${rest}`);
}
