// The page that `ortung eval --report` writes, in a real browser: its charts are the page's (uPlot).
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { pathToFileURL } from "node:url";
import { openPage, out, runProgram, startBrowser, until } from "./program.mjs";

const kCharts = ["position", "heading", "quality", "samples"];
const kWorld = "maps/fields/arena.toml";
const kRobot = ["--robot", "maps/robots/laboratory.toml"];

describe("the report of an evaluation", () => {
  let browser, page;
  const own = mkdtempSync(join(tmpdir(), "ortung-report-"));
  before(async () => {
    const tables = join(own, "arena.ortung");
    const report = join(own, "report.html");
    for (const words of [
      ["learn", "--world", kWorld, ...kRobot, "--out", tables],
      ["eval", "--source", `sim:${kWorld}?duration=20&seed=1`, ...kRobot, "--tables", tables, "--report", report],
    ]) {
      const { status, stderr } = runProgram(words);
      assert.equal(status, 0, stderr);
    }
    browser = await startBrowser();
    page = await openPage(browser, pathToFileURL(report), { colorScheme: "light" });
  });
  after(async () => {
    await browser?.close();
    rmSync(own, { recursive: true });
  });

  /** What stands above each chart behind the name, e.g. "time". */
  const values = (name) =>
    Promise.all(kCharts.map((id) => page.locator(`#${id} .u-series`).filter({ hasText: name }).locator(".u-value").textContent()));
  const plot = (id) => page.locator(`#${id} .u-over`).boundingBox();
  /** How many pixels of the chart are not of its background. */
  const drawn = (id) =>
    page.locator(`#${id} canvas`).evaluate((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return data.filter((value, i) => i % 4 === 3 && value > 0).length;
    });
  /** The times under the pointer at the left and right end of each chart. */
  async function ends(id) {
    const box = await plot(id);
    const times = [];
    for (const x of [box.x + 1, box.x + box.width - 1]) {
      await page.mouse.move(x, box.y + 10);
      times.push((await values("time")).map(parseFloat));
    }
    return times;
  }

  it("draws all charts and has no errors", async () => {
    await page.locator("#samples canvas").waitFor();
    for (const id of kCharts) assert.ok((await drawn(id)) > 1000, id);
    await page.screenshot({ path: join(out, "report-light.png"), fullPage: true });
    assert.deepEqual(page.problems, []);
  });

  it("shows the values under the pointer in all charts, and the robot on the map", async () => {
    assert.deepEqual(await values("time"), ["–", "–", "–", "–"]);
    await page.locator("#heading").scrollIntoViewIfNeeded();
    const box = await plot("heading");
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    for (const time of await values("time")) assert.ok(Math.abs(parseFloat(time) - 10) < 0.5, time);
    const shown = await page.locator(".u-legend .u-value").allTextContents();
    assert.ok(shown.some((text) => /^\d+\.\d{3} m$/.test(text)), shown.join());
    assert.ok(shown.some((text) => /^[01]\.\d{3}, tracking: /.test(text)), shown.join());
    assert.equal(await page.locator("#truth-now").getAttribute("visibility"), "visible");
    await page.mouse.move(box.x + box.width / 2, box.y - 30);
    assert.equal(await page.locator("#truth-now").getAttribute("visibility"), "hidden");
  });

  it("zooms all charts by dragging, moves them with Shift, and shows everything after a double click", async () => {
    const box = await plot("heading");
    const at = (share) => [box.x + share * box.width, box.y + 20];
    const drag = async (from, to) => {
      await page.mouse.move(...at(from));
      await page.mouse.down();
      await page.mouse.move(...at(to), { steps: 4 });
      await page.mouse.up();
    };
    const show = (what, from, to) =>
      until(what, async () => {
        const [left, right] = await ends("heading");
        return left.every((t) => Math.abs(t - from) < 0.8) && right.every((t) => Math.abs(t - to) < 0.8);
      });
    await drag(0.5, 0.75);
    await show("all charts show 10 to 15 s", 10, 15);
    await page.keyboard.down("Shift");
    await drag(0.2, 0.6);
    await page.keyboard.up("Shift");
    await show("all charts show 8 to 13 s", 8, 13);
    await page.mouse.dblclick(...at(0.5));
    await show("all charts show everything", 0, 20);
  });

  it("fits into a narrow window, and is dark where the system is", async () => {
    await page.emulateMedia({ colorScheme: "dark" });
    await page.setViewportSize({ width: 400, height: 800 });
    await until("the charts are narrow", async () => (await page.locator("#heading .uplot").boundingBox()).width < 400);
    for (const id of kCharts) {
      assert.ok((await drawn(id)) > 1000, id);
      const tooWide = await page.locator(`#${id}`).evaluate((chart) => chart.scrollWidth - chart.clientWidth);
      assert.ok(tooWide <= 0, `${id} is ${tooWide} px too wide`);
    }
    await page.screenshot({ path: join(out, "report-dark.png"), fullPage: true });
    assert.deepEqual(page.problems, []);
  });
});
