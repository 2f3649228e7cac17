// Makes the pictures of docs/pictures that show the page, from the real program: npm run pictures [FOLDER]
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { openPage, root, runProgram, startBrowser, startClient, startProgram, until } from "./program.mjs";

const folder = process.argv[2] ?? join(root, "docs", "pictures");
const kLocalized = ["maps/fields/f2000.toml", "--robot", "maps/robots/pioneer.toml", "--localize", "all"];
const browser = await startBrowser();

const seconds = async (page) => {
  const [minutes, rest] = (await page.locator(".clock").first().textContent()).split(":").map(Number);
  return minutes * 60 + rest;
};
const atTime = (page, time) => until(`the clock shows ${time} s`, async () => (await seconds(page)) >= time, 120);

/** A page of @p program with @p keys behind its #. */
async function pageOf(program, keys, colorScheme) {
  const url = new URL(program.url);
  url.hash += `&${keys}`;
  return openPage(browser, url, { colorScheme });
}

async function save(page, name) {
  await page.mouse.move(0, 700);
  await page.screenshot({ path: join(folder, name) });
  for (const problem of page.problems) console.log(name, problem);
  await page.close();
}

async function matches() {
  const program = await startProgram(["sim", "maps/scenes/f2000_match.toml"]);
  const light = await pageOf(program, "robot=4&panel=game", "light");
  const dark = await pageOf(program, "robot=3&panel=game", "dark");
  await dark.getByText("Layers", { exact: true }).click();
  await dark.getByLabel("trails").check();
  await dark.getByText("Layers", { exact: true }).click();
  await atTime(light, 14);
  await save(light, "viewer.png");
  await save(dark, "viewer_match.png");
  await program.stop();
}

async function localization() {
  const program = await startProgram(["sim", ...kLocalized]);
  const client = await startClient(program);
  const open = () => pageOf(program, "robot=1&panel=localization", "light");
  const curves = await open();
  const maps = await open();
  for (const page of [curves, maps]) {
    await page.getByText(/^tracking/).first().waitFor({ timeout: 120000 });
    await page.getByLabel("on the field").check();
    await page.getByLabel("each feature").check();
  }
  await atTime(curves, 18);
  await client.ask("PAUSE");
  for (const page of [curves, maps]) await page.locator("#panel canvas").nth(3).waitFor();
  await curves.getByText("Over time").scrollIntoViewIfNeeded();
  await curves.getByText("Over time").evaluate((title) => title.scrollIntoView());
  await save(curves, "viewer-localization.png");
  await maps.getByText("Map of p(s given l)").evaluate((title) => title.scrollIntoView());
  await save(maps, "viewer_map.png");
  client.close();
  await program.stop();
}

async function records() {
  const own = mkdtempSync(join(tmpdir(), "ortung-pictures-"));
  const tables = join(own, "f2000.ortung");
  const world = ["--world", "maps/fields/f2000.toml", "--robot", "maps/robots/pioneer.toml"];
  const check = ({ status, stderr }) => {
    if (status !== 0) throw new Error(stderr);
  };
  check(runProgram(["learn", ...world, "--out", tables]));
  const runs = [1, 2].map((seed) => join(own, `run${seed}.rec`));
  runs.forEach((run, index) => check(runProgram(["sim", "maps/fields/f2000.toml", "--robot", "maps/robots/pioneer.toml",
    "--seed", `${index + 1}`, "--duration", "30", "--free-run", "--record", run])));
  const program = await startProgram(["view", ...runs, ...world, "--tables", tables]);
  const page = await pageOf(program, "robot=1&panel=localization", "dark");
  await page.getByRole("slider", { name: "Time of the record" }).waitFor();
  await atTime(page, 11);
  await save(page, "viewer-record.png");
  await program.stop();
  rmSync(own, { recursive: true });
}

await matches();
await localization();
await records();
await browser.close();
