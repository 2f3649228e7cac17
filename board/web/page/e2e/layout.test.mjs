// How the page is arranged, in a real browser with the real program: node --test e2e/
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { checkAccess, openPage, out, runProgram, startBrowser, startClient, startProgram, until } from "./program.mjs";

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

const tab = (page, name) => page.getByRole("tab", { name, exact: true });

/** The tabs of each group, by where it is. */
const arranged = (page) => page.locator(".group").evaluateAll((all) => all.map((group) =>
  `${group.dataset.area}: ${[...group.querySelectorAll('[role="tab"]')].map((one) => one.textContent).join(" ")}`));

async function isArranged(page, wanted) {
  let last;
  await until(`the panels are ${JSON.stringify(wanted)}`, async () => {
    last = await arranged(page);
    return JSON.stringify(last) === JSON.stringify(wanted);
  }, 10).catch((error) => {
    throw new Error(`${error.message}, but ${JSON.stringify(last)}`);
  });
}

/** By the menu on a panel's head. */
async function order(page, panel, item) {
  await page.getByRole("button", { name: `Panel ${panel}`, exact: true }).click();
  await page.getByRole("menuitem", { name: item, exact: true }).click();
}

/** Drags from the middle of one place to a part of another. */
async function dragTo(page, from, to, across, down) {
  const a = await from.boundingBox();
  const b = await to.boundingBox();
  await page.mouse.move(a.x + a.width / 2, a.y + a.height / 2);
  await page.mouse.down();
  await page.mouse.move(a.x + a.width / 2 + 10, a.y + a.height / 2 + 10);
  await page.mouse.move(b.x + across * b.width, b.y + down * b.height, { steps: 4 });
  await page.locator(".drop-mark").waitFor();
  await page.screenshot({ path: join(out, "dragged.png") });
  await page.mouse.up();
}

const kUsual = ["right: Robots Sensors Localization Game"];

describe("the panels of the page", () => {
  let program;
  before(async () => (program = await startProgram(["sim", "maps/scenes/f2000_match.toml"])));
  after(() => program.stop());
  const open = async (more = "", options = {}) => {
    const page = await openPage(browser, program.url + more, options);
    await page.getByRole("img", { name: /^blue2 at / }).waitFor();
    return page;
  };

  it("are dragged beside the field, below it, among others' tabs, and back", async () => {
    const page = await open();
    await isArranged(page, kUsual);
    const stage = page.locator(".stage");
    await dragTo(page, tab(page, "Robots"), stage, 0.1, 0.5);
    await isArranged(page, ["left: Robots", "right: Sensors Localization Game"]);
    await dragTo(page, tab(page, "Game"), stage, 0.5, 0.95);
    await isArranged(page, ["left: Robots", "bottom: Game", "right: Sensors Localization"]);
    await dragTo(page, tab(page, "Sensors"), page.locator("#group-left-0"), 0.5, 0.9);
    await isArranged(page, ["left: Robots", "left: Sensors", "bottom: Game", "right: Localization"]);
    await page.getByText("What blue1 senses").waitFor();
    await dragTo(page, tab(page, "Localization"), page.locator("#group-bottom-0"), 0.1, 0.5);
    await isArranged(page, ["left: Robots", "left: Sensors", "bottom: Localization", "bottom: Game"]);
    await dragTo(page, tab(page, "Game"), tab(page, "Robots"), 0.1, 0.5);
    await isArranged(page, ["left: Game Robots", "left: Sensors", "bottom: Localization"]);
    // Escape gives a drag up.
    const at = await tab(page, "Game").boundingBox();
    await page.mouse.move(at.x + 20, at.y + 10);
    await page.mouse.down();
    await page.mouse.move(500, 300, { steps: 3 });
    await page.locator(".drag-label").waitFor();
    await page.keyboard.press("Escape");
    await page.mouse.up();
    assert.equal(await page.locator(".drag-label, .drop-mark").count(), 0);
    await isArranged(page, ["left: Game Robots", "left: Sensors", "bottom: Localization"]);
    await checkAccess(page, "arranged");
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("are dragged by a finger", async () => {
    const page = await open("", { hasTouch: true });
    const from = await tab(page, "Robots").boundingBox();
    const to = await page.locator(".stage").boundingBox();
    const debug = await page.context().newCDPSession(page);
    const touch = (type, x, y) => debug.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x, y, id: 0 }] });
    const [x, y] = [from.x + from.width / 2, from.y + from.height / 2];
    await touch("touchStart", x, y);
    for (const share of [0.3, 0.7, 0.97]) await touch("touchMove", x + share * (to.x - x), y + share * 200);
    await page.locator(".drop-mark").waitFor();
    await touch("touchEnd");
    await isArranged(page, ["left: Robots", "right: Sensors Localization Game"]);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("are moved by keys alone, closed, brought back, and stay so", async () => {
    const page = await open();
    await page.getByRole("button", { name: "Panel Robots" }).focus();
    await page.keyboard.press("ArrowDown");
    for (const key of ["End", "ArrowUp", "Home", "m"]) await page.keyboard.press(key);
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "Move up");
    for (const key of ["m", "m", "Enter"]) await page.keyboard.press(key);
    await isArranged(page, ["left: Robots", "right: Sensors Localization Game"]);
    await page.getByRole("button", { name: "Panel Robots" }).focus();
    await page.keyboard.press("Enter");
    await page.keyboard.press("Escape");
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "Panel Robots");
    await order(page, "Sensors", "Close");
    await isArranged(page, ["left: Robots", "right: Localization Game"]);
    await order(page, "Localization", "Collapse");
    assert.equal(await page.getByText("Estimated pose of").count(), 0);
    await page.reload();
    await isArranged(page, ["left: Robots", "right: Localization Game"]);
    assert.equal(await page.getByText("Estimated pose of").count(), 0, "it is collapsed as before");
    await page.getByRole("button", { name: "Panels, layout, files" }).click();
    await page.getByRole("menuitemcheckbox", { name: "Sensors" }).click();
    await isArranged(page, ["left: Robots", "right: Localization Game Sensors"]);
    await page.getByText("What blue1 senses").waitFor();
    await page.getByRole("button", { name: "Panels, layout, files" }).click();
    await page.getByRole("menuitem", { name: "Reset layout" }).click();
    await isArranged(page, kUsual);
    assert.equal(await page.evaluate(() => location.hash.includes("layout")), false);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("have edges that share their room", async () => {
    const page = await open();
    await order(page, "Robots", "Move down");
    const edge = page.getByRole("separator", { name: "Edge behind panel group 1" });
    await edge.focus();
    const before = (await page.locator("#group-right-0").boundingBox()).height;
    for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowUp");
    assert.equal(await edge.getAttribute("aria-valuenow"), "30");
    await until("the upper one is lower", async () => (await page.locator("#group-right-0").boundingBox()).height < 0.7 * before);
    const { x, y, width } = await edge.boundingBox();
    await page.mouse.move(x + width / 2, y + 3);
    await page.mouse.down();
    await page.mouse.move(x + width / 2, y + 150);
    await page.mouse.up();
    await until("it is higher again", async () => Number(await edge.getAttribute("aria-valuenow")) > 45);
    await page.close();
  });

  it("are large over the field by a double click, and put back by Escape", async () => {
    const page = await open();
    await tab(page, "Robots").dblclick();
    const large = page.getByRole("region", { name: "Robots, large" });
    await large.getByText("On the field").waitFor();
    await page.getByText("It lies over the field.").waitFor();
    await checkAccess(page, "large");
    await page.keyboard.press("Escape");
    await large.waitFor({ state: "detached" });
    await page.keyboard.press("x");
    await large.waitFor();
    await large.getByRole("button", { name: "Put it back" }).click();
    await large.waitFor({ state: "detached" });
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("are tabs of one place where the page is narrow", async () => {
    const page = await open("", { viewport: { width: 420, height: 860 } });
    await order(page, "Robots", "Make large");
    await page.getByRole("region", { name: "Robots, large" }).waitFor();
    await page.keyboard.press("Escape");
    await page.setViewportSize({ width: 1280, height: 720 });
    await order(page, "Robots", "Move left");
    await order(page, "Sensors", "Move below");
    await page.setViewportSize({ width: 420, height: 860 });
    await until("all are tabs", async () => (await page.getByRole("tab").count()) === 4);
    assert.equal(await page.locator(".group").count(), 1);
    await tab(page, "Sensors").click();
    await page.getByText("What blue1 senses").waitFor();
    await checkAccess(page, "narrow");
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("are the same for others by the address, which wins over what is kept", async () => {
    const page = await open();
    await order(page, "Robots", "Move left");
    await page.getByText("Layers", { exact: true }).click();
    await page.getByLabel("trails").check();
    await page.getByRole("button", { name: "Panels, layout, files" }).click();
    await page.getByRole("menuitem", { name: "Copy a link to this layout" }).click();
    const link = await page.getByLabel("Link to this layout").inputValue();
    assert.ok(!link.includes(program.token), "the link has no token");
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
    const other = await context.newPage();
    await other.goto(program.url.origin);
    await isArranged(other, kUsual);
    await order(other, "Robots", "Close");
    await isArranged(other, ["right: Sensors Localization Game"]);
    await other.goto("about:blank");
    await other.goto(link);
    await isArranged(other, ["left: Robots", "right: Sensors Localization Game"]);
    await other.getByText("Layers", { exact: true }).click();
    assert.equal(await other.getByLabel("trails").isChecked(), true);
    await context.close();
    await page.close();
  });

  it("are as usual, which is said, where the address has a layout that can't be shown", async () => {
    for (const text of ["2*x", "1*s1.2.3*r1o0.robots", "<img src=x onerror=alert(1)>", "%u0000%", "1*s372.372.230*r100o0.weather"]) {
      const page = await open(`&layout=${encodeURIComponent(text)}`);
      await page.getByText("The layout in this address can't be shown, here is the usual one").waitFor();
      await isArranged(page, kUsual);
      await page.getByRole("button", { name: "Close this note" }).click();
      assert.equal(await page.getByText("can't be shown").count(), 0);
      assert.deepEqual(page.problems, []);
      await page.close();
    }
  });

  it("are arranged where a browser keeps nothing", async () => {
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
    const page = await context.newPage();
    const problems = [];
    page.on("pageerror", (error) => problems.push(String(error)));
    await page.addInitScript(() => Object.defineProperty(window, "localStorage", { get: () => { throw new DOMException("denied", "SecurityError"); } }));
    await page.goto(String(program.url));
    await order(page, "Robots", "Move left");
    await isArranged(page, ["left: Robots", "right: Sensors Localization Game"]);
    assert.deepEqual(problems, []);
    await context.close();
  });
});

describe("curves of the page", () => {
  let folder;
  before(() => {
    folder = mkdtempSync(join(tmpdir(), "ortung-page-"));
    const made = runProgram(["sim", "maps/fields/f2000.toml", "--robot", "maps/robots/pioneer.toml", "--duration", "8", "--free-run", "--record", join(folder, "run.rec")]);
    assert.equal(made.status, 0, made.stderr);
  });
  after(() => rmSync(folder, { recursive: true }));

  it("are dragged out, joined, made large, and go to a time of a record", async () => {
    const program = await startProgram(["view", join(folder, "run.rec")]);
    const client = await startClient(program);
    const page = await openPage(browser, `${program.url}&panel=sensors`);
    await page.getByRole("button", { name: "Pause" }).click();
    await page.locator(".features summary", { hasText: "odometry/odometry/pose" }).click();
    for (const name of ["x", "y", "heading"]) await page.getByRole("button", { name: `Curve of ${name}`, exact: true }).click();
    const caption = (name) => page.locator(".chart figcaption .handle", { hasText: name });
    await dragTo(page, caption("pose x"), page.locator(".stage"), 0.5, 0.95);
    await isArranged(page, ["bottom: pose x", "right: Robots Sensors Localization Record"]);
    // Dropped on a panel of its unit a curve joins it; one of another unit becomes a tab beside it.
    await dragTo(page, caption("pose y"), page.locator("#group-bottom-0"), 0.5, 0.5);
    await isArranged(page, ["bottom: pose x, pose y", "right: Robots Sensors Localization Record"]);
    await dragTo(page, caption("pose heading"), page.locator("#group-bottom-0 .panel"), 0.5, 0.5);
    await isArranged(page, ["bottom: pose x, pose y pose heading", "right: Robots Sensors Localization Record"]);
    assert.equal(await page.getByRole("button", { name: "Remove all curves" }).count(), 0);
    await tab(page, "pose x, pose y").dblclick();
    const large = page.getByRole("region", { name: "pose x, pose y, large" });
    const plot = large.locator(".u-over");
    await plot.waitFor();
    await checkAccess(page, "curves-large");
    const now = async () => Number(/now=(\d+)/.exec((await client.ask("STATUS"))[0])[1]) / 1e6;
    const end = await page.getByRole("slider", { name: "Time of the record" }).getAttribute("max") / 1e6;
    const { x, y, width, height } = await plot.boundingBox();
    await page.mouse.move(x + 0.25 * width, y + height / 2);
    await large.getByText(/^at 0:0/).waitFor();
    await page.mouse.down();
    await until("it is where it was clicked", async () => Math.abs((await now()) - 0.25 * end) < 0.2);
    await page.mouse.move(x + 0.75 * width, y + height / 2, { steps: 5 });
    await until("it is where it was dragged to", async () => Math.abs((await now()) - 0.75 * end) < 0.2);
    await page.mouse.up();
    await page.reload();
    await large.locator("canvas").waitFor();
    await page.keyboard.press("Escape");
    await order(page, "pose x, pose y", "Take out pose x");
    await isArranged(page, ["bottom: pose y pose heading", "bottom: pose x", "right: Robots Sensors Localization Record"]);
    await order(page, "pose x", "Join pose y");
    await isArranged(page, ["bottom: pose y, pose x pose heading", "right: Robots Sensors Localization Record"]);
    // Closed, they are among all others again.
    await order(page, "pose y, pose x", "Close");
    await order(page, "pose heading", "Close");
    await tab(page, "Sensors").click();
    await caption("pose y").waitFor();
    await page.getByRole("button", { name: "Take out pose y" }).click();
    await isArranged(page, ["bottom: pose y", "right: Robots Sensors Localization Record"]);
    assert.deepEqual(page.problems, []);
    client.close();
    await page.close();
    await program.stop();
  });
});
