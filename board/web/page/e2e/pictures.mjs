// Makes the pictures of docs/pictures that show the page, from the real program: npm run pictures [FOLDER]
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { openPage, root, runProgram, startBrowser, startClient, startProgram, until } from "./program.mjs";

const folder = process.argv[2] ?? join(root, "docs", "pictures");
const kField = "maps/fields/f2000.toml";
const kRobot = ["--robot", "maps/robots/pioneer.toml"];
const browser = await startBrowser();

const seconds = async (page) => {
  const [minutes, rest] = (await page.locator(".clock").first().textContent()).split(":").map(Number);
  return minutes * 60 + rest;
};
const atTime = (page, time) => until(`the clock shows ${time} s`, async () => (await seconds(page)) >= time, 120);

/** A page of @p program with @p keys behind its #. */
const pageOf = (program, keys, colorScheme) => openPage(browser, `${program.url}&${keys}`, { colorScheme });

async function save(page, name) {
  await page.mouse.move(0, 700);
  await page.screenshot({ path: join(folder, name) });
  for (const problem of page.problems) console.log(name, problem);
  await page.close();
}

async function ofMatch() {
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

async function ofLocalization() {
  const program = await startProgram(["sim", kField, ...kRobot, "--localize", "all"]);
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
  for (const page of [curves, maps]) {
    await page.locator(".panel canvas").nth(12).waitFor({ timeout: 120000 });
    // The map of what stands still is that of its last readings.
    await until("the map is up to date", async () => /^0\.[0-2] s old/.test((await page.locator(".panel").first().getByText(/ s old$/).textContent()) ?? ""), 120);
  }
  await curves.getByText("Over time").evaluate((title) => title.scrollIntoView());
  await save(curves, "viewer-localization.png");
  await maps.getByText("Map of p(s given l)").evaluate((title) => title.scrollIntoView());
  await save(maps, "viewer_map.png");
  client.close();
  await program.stop();
}

async function ofRecords() {
  const own = mkdtempSync(join(tmpdir(), "ortung-pictures-"));
  const tables = join(own, "f2000.ortung");
  const run = (words) => {
    const { status, stderr } = runProgram(words);
    if (status !== 0) throw new Error(stderr);
  };
  run(["learn", "--world", kField, ...kRobot, "--out", tables]);
  const records = ["1", "2"].map((seed) => {
    const record = join(own, `run${seed}.rec`);
    run(["sim", kField, ...kRobot, "--seed", seed, "--duration", "30", "--free-run", "--record", record]);
    return record;
  });
  const program = await startProgram(["view", ...records, "--world", kField, ...kRobot, "--tables", tables]);
  const page = await pageOf(program, "robot=1&panel=localization", "dark");
  await page.getByRole("slider", { name: "Time of the record" }).waitFor();
  await atTime(page, 11);
  await save(page, "viewer-record.png");
  const arranged = await pageOf(program, "robot=1&panel=localization", "light");
  for (const name of ["error", "heading error"]) await arranged.getByRole("button", { name: `Take out ${name}`, exact: true }).click();
  await arranged.getByRole("button", { name: "Panel Localization" }).click();
  await arranged.getByRole("menuitem", { name: "Move left" }).click();
  await arranged.getByRole("tab", { name: "Sensors" }).click();
  await arranged.locator(".features li").nth(3).waitFor();
  await atTime(arranged, 14);
  await save(arranged, "viewer_arranged.png");
  await program.stop();
  rmSync(own, { recursive: true });
}

await ofMatch();
await ofLocalization();
await ofRecords();
await browser.close();
