// The page of the viewer in a real browser, with the real program: node --test e2e/
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, beforeEach, describe, it } from "node:test";
import { checkAccess, onScreen, openPage, out, runProgram, startBrowser, startClient, startProgram, until } from "./program.mjs";

const kMatch = ["sim", "maps/scenes/f2000_match.toml"];

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

const robot = (page, name) => page.getByRole("img", { name: new RegExp(`^${name} at `) });
const tab = (page, name) => page.getByRole("tab", { name });

/** Each feature of the robot is of a format that the page knows, and its scan and its localization read what they do. */
async function checkReadings(page, what) {
  await tab(page, "Sensors").click();
  const read = () => page.locator(".features .reading").allTextContents();
  await until("all features have readings", async () => (await read()).every((text) => text !== "–"));
  const texts = await read();
  assert.deepEqual(texts.filter((text) => / words: /.test(text)), []);
  assert.match(texts.join("\n"), /^180 beams, \d+ valid, nearest /m);
  assert.match(texts.join("\n"), /^(tracking|uncertain|lost): [a-z ]+, \d+ %$/m);
  await page.screenshot({ path: join(out, `${what}-readings.png`) });
  await tab(page, "Localization").click();
}

async function checkPanels(page, what, last = "Game") {
  for (const panel of ["Robots", "Sensors", "Localization", last]) {
    await tab(page, panel).click();
    await page.waitForFunction(() => document.querySelector(".panel .block"));
    await checkAccess(page, `${what}-${panel}`);
  }
}

describe("the page of a match", () => {
  let program;
  let client;
  before(async () => {
    program = await startProgram(kMatch);
    client = await startClient(program);
  });
  beforeEach(() => client.ask("RESUME"));
  after(async () => {
    client.close();
    await program.stop();
  });

  it("shows all robots by name where they are, and says nothing wrong to its console", async () => {
    const page = await openPage(browser, program.url);
    await robot(page, "blue2").waitFor();
    assert.equal(await page.getByRole("img", { name: /^(blue|yellow)\d at / }).count(), 8);
    assert.equal(await page.locator(".landmark").count(), 4, "posts; goals are drawn as such");
    await client.ask("PAUSE");
    const truth = await client.pose(2);
    // What the robot sensed last is from the beginning of the cycle, so they differ by a cycle's way.
    await until("it is shown where it is", async () => {
      const [x, y] = /at (\S+), (\S+)$/.exec(await robot(page, "blue2").getAttribute("aria-label")).slice(1).map(Number);
      return Math.hypot(x - truth.x, y - truth.y) < 0.12;
    });
    await client.ask("RESUME");
    await page.getByText("operator").waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  /// Pauses the game with robot 3 at (-4, 3.5), once nobody else is there.
  const placeThird = () =>
    until("there is room for robot 3", async () => {
      await client.ask("PAUSE");
      const error = await client.ask("PLACE robot=3 x_m=-4 y_m=3.5 theta_deg=0").then(() => null, (error) => error);
      if (!error) return true;
      if (!/no-room/.test(error.message)) throw error;
      await client.ask("RESUME");
      return false;
    });

  it("only looks without the token", async () => {
    const page = await openPage(browser, program.url.origin);
    await robot(page, "blue2").waitFor();
    await page.locator(".link", { hasText: "viewer" }).waitFor();
    assert.equal(await page.getByRole("button", { name: "Pause" }).isDisabled(), true);
    await page.close();
  });

  it("moves a robot in the simulation when it is dragged", async () => {
    await placeThird();
    await client.ask("STEP");
    const page = await openPage(browser, program.url);
    await until("the robot is shown at its place", async () => /at -4.0, 3.5/.test(await robot(page, "blue3").getAttribute("aria-label")));
    const from = await onScreen(page, -4, 3.5);
    const to = await onScreen(page, -5.2, -3.1);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2);
    await page.mouse.move(to.x, to.y);
    await page.mouse.up();
    await until("the robot is there", async () => {
      await client.ask("STEP");
      const { x, y } = await client.pose(3);
      return Math.hypot(x + 5.2, y + 3.1) < 0.05;
    });
    await page.getByText(/^PLACE robot=3 x_m=-5\./).first().waitFor();
    await client.ask("RESUME");
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("starts a player from the menu and stops it again", async () => {
    const page = await openPage(browser, program.url);
    await tab(page, "Game").click();
    const form = page.getByRole("form", { name: "Start a player" });
    await form.getByLabel("player").selectOption("wander");
    await form.getByLabel("name", { exact: false }).nth(1).waitFor();
    await form.locator("label", { hasText: /^name/ }).locator("input").fill("guest");
    await form.locator("label", { hasText: /^robot/ }).locator("input").fill("pioneer.toml");
    await form.locator("label", { hasText: /^start/ }).locator("input").fill("0,-3.9,0");
    await form.getByRole("button", { name: "Start" }).click();
    await robot(page, "guest").waitFor();
    await until("the player is told by the server", async () => (await client.ask("PLAYERS")).some((line) => /robot=guest player=wander/.test(line)));
    await page.getByRole("button", { name: "Stop guest" }).click();
    await robot(page, "guest").waitFor({ state: "detached" });
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("counts a goal that the referee is told of", async () => {
    const page = await openPage(browser, program.url);
    await tab(page, "Game").click();
    const before = Number(await client.key("GAME", "blue"));
    await page.getByRole("group", { name: "Orders for blue" }).getByRole("button", { name: "goal", exact: true }).click();
    await until("the score is one more", async () => Number(await client.key("GAME", "blue")) > before);
    await until("the page shows it", async () => Number(await page.locator(".top .score b").first().textContent()) > before);
    await page.close();
  });

  it("shows an error of the server where the action is", async () => {
    const page = await openPage(browser, program.url);
    await tab(page, "Game").click();
    const form = page.getByRole("form", { name: "Start a player" });
    await form.locator("label", { hasText: /^robot/ }).locator("input").fill("nosuchrobot");
    await form.getByRole("button", { name: "Start" }).click();
    await form.getByRole("alert").filter({ hasText: "nosuchrobot" }).waitFor();
    await page.close();
  });

  it("is one of two pages at once that show the same", async () => {
    const pages = await Promise.all([openPage(browser, program.url), openPage(browser, program.url)]);
    await pages[0].getByRole("button", { name: "Pause" }).click();
    await pages[1].getByRole("button", { name: "Go on" }).click();
    await pages[0].getByRole("button", { name: "Pause" }).waitFor();
    assert.equal(await until("it runs", async () => (await client.key("STATUS", "state")) === "running"), true);
    await Promise.all(pages.map((page) => page.close()));
  });

  it("never makes HTML of what clients say", async () => {
    const guest = await startClient(program, "guest");
    const page = await openPage(browser, program.url);
    await robot(page, "blue2").waitFor();
    await page.keyboard.press("l");
    const evil = "<img src=x onerror=alert(1)>";
    await page.getByLabel("Send a line of the protocol").fill(`SAY ${evil}`);
    await page.getByRole("button", { name: "Send", exact: true }).click();
    await page.getByRole("log").getByText(`SAY ${evil}`).waitFor();
    assert.equal(await page.locator("img[src=x]").count(), 0);
    assert.deepEqual(page.problems, []);
    guest.close();
    await page.close();
  });

  for (const [name, width, height] of [["desktop", 1280, 720], ["tablet", 820, 1180]]) {
    it(`has no findings of axe: ${name}`, async () => {
      const page = await openPage(browser, program.url, { viewport: { width, height } });
      await robot(page, "blue2").waitFor();
      await robot(page, "blue2").focus();
      await page.keyboard.press("Enter");
      await checkPanels(page, name);
      await page.getByText("Layers", { exact: true }).click();
      await page.keyboard.press("l");
      await page.getByText(/^\d+ options$/).click();
      await tab(page, "Sensors").click();
      await page.locator(".features summary").first().click();
      await page.getByRole("button", { name: "Curve of x" }).click();
      await page.locator(".chart canvas").waitFor();
      await checkAccess(page, `${name}-open`);
      await page.keyboard.press("?");
      await page.getByRole("dialog").waitFor();
      await checkAccess(page, `${name}-help`);
      assert.deepEqual(page.problems, []);
      await page.close();
    });
  }

  it("has panels that are as wide as the user makes them, and stay so", async () => {
    const page = await openPage(browser, program.url);
    const edge = page.getByRole("separator", { name: "Width of the panels" });
    const side = page.getByRole("complementary", { name: "Panels" });
    const { x, y, width, height } = await edge.boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x - 100, y + height / 2);
    await page.mouse.up();
    await until("they are wider", async () => Math.abs((await side.boundingBox()).width - 476) < 4);
    const before = Number(await edge.getAttribute("aria-valuenow"));
    await edge.focus();
    await page.keyboard.press("ArrowLeft");
    await page.reload();
    await until("they are as before", async () => Math.round((await side.boundingBox()).width) === before + 20);
    await edge.dblclick();
    await until("they are as usual", async () => Math.round((await side.boundingBox()).width) === 372);
    await page.close();
  });

  it("is steered by two fingers, by a gamepad, and turns a robot", async () => {
    await placeThird();
    // Where there is room, as the others and the ball are wherever the game has left them.
    const placed = async ([y, ...others]) => {
      const error = await client.ask(`PLACE robot=4 x_m=1 y_m=${y} theta_deg=0`).then(() => null, (error) => error);
      if (!error) return y;
      if (!/no-room/.test(error.message) || others.length === 0) throw error;
      return placed(others);
    };
    const height = await placed([-2, -3, -1, 2]);
    await client.ask("STEP");
    const page = await openPage(browser, `${program.url}&robot=3`, { hasTouch: true });
    await until("the robot is shown at its place", async () => /at -4.0, 3.5/.test(await robot(page, "blue3").getAttribute("aria-label")));
    const from = await onScreen(page, -4, 3.5);
    const below = await onScreen(page, -4, 2.5);
    await page.keyboard.down("Alt");
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(below.x, below.y, { steps: 3 });
    await page.mouse.up();
    await page.keyboard.up("Alt");
    await page.getByText(/^PLACE robot=3 x_m=-4\S* y_m=3\.\S* theta_deg=-(89\.|90)/).first().waitFor();
    const scale = () => page.locator(".over > g").first().evaluate((group) => Number(/matrix\((\S+)/.exec(group.getAttribute("transform"))[1]));
    const before = await scale();
    const debug = await page.context().newCDPSession(page);
    const { x, y } = await onScreen(page, 1, height);
    // One of the fingers is on another robot, which is neither selected nor moved by that.
    const touch = (type, apart) => {
      const touchPoints = apart ? [{ x, y, id: 0 }, { x: x + 2 * apart, y, id: 1 }] : [];
      return debug.send("Input.dispatchTouchEvent", { type, touchPoints });
    };
    await touch("touchStart", 40);
    for (const apart of [55, 70, 80]) await touch("touchMove", apart);
    await touch("touchEnd", 0);
    await until("the field is twice as large", async () => Math.abs((await scale()) / before - 2) < 0.01);
    await page.evaluate(() => {
      window.pad = { id: "pad of a test", connected: true, axes: [0, -1, 0, 0], buttons: [] };
      navigator.getGamepads = () => [window.pad];
    });
    await page.keyboard.press("d");
    await page.getByText(/gamepad: pad of a test/).waitFor();
    await page.getByText(/^VELOCITY v_m_s=0\.\d+ w_rad_s=0 robot=3/).first().waitFor();
    await page.keyboard.press("Escape");
    await page.getByText(/^VELOCITY v_m_s=0 w_rad_s=0 robot=3/).first().waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("shows the same in three dimensions", async () => {
    const page = await openPage(browser, program.url);
    await robot(page, "blue2").waitFor();
    await page.keyboard.press("v");
    await page.getByRole("img", { name: "Field in three dimensions" }).waitFor();
    await page.waitForFunction(() => document.querySelector(".stage3d canvas").dataset.drawn > 2);
    await page.screenshot({ path: join(out, "3d.png") });
    assert.deepEqual(page.problems, []);
    await page.close();
  });
});

describe("the page of a game without players", () => {
  it("shows the goal of a player that was started from its menu", async () => {
    const program = await startProgram(["sim", "maps/fields/f2000.toml", "--referee", "soccer"]);
    const page = await openPage(browser, `${program.url}&panel=game`);
    const form = page.getByRole("form", { name: "Start a player" });
    await form.getByLabel("player").selectOption("footballer");
    const values = { team: "blue", name: "nine", robot: "f2000_player", start: "2,0,0" };
    await page.locator("#robot-kinds option").nth(10).waitFor({ state: "attached" });
    for (const [key, value] of Object.entries(values)) {
      await form.locator("label", { hasText: new RegExp(`^${key}`) }).locator("input").fill(value);
    }
    await form.getByRole("button", { name: "Start" }).click();
    await robot(page, "nine").waitFor();
    await page.getByRole("combobox", { name: "Speed", exact: true }).selectOption("10");
    await until("it has scored", async () => Number(await page.locator(".top .score b").first().textContent()) > 0, 90);
    await page.getByText("goal blue").first().waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
    await program.stop();
  });

  it("has a button for each state of a manipulator", async () => {
    const program = await startProgram(["sim", "maps/scenes/kick.toml"]);
    const page = await openPage(browser, `${program.url}&panel=robots&robot=1`);
    const kicker = page.getByRole("group", { name: "kicker" });
    await kicker.waitFor();
    assert.deepEqual(await kicker.getByRole("button").allTextContents(), ["rest", "kick", "pass"]);
    await kicker.getByRole("button", { name: "kick" }).click();
    await page.getByText("MANIPULATOR kicker kick robot=1").first().waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
    await program.stop();
  });
});

describe("the page of a server that is started again", () => {
  it("says that the connection is lost, and comes back", async () => {
    const first = await startProgram(["sim", "maps/scenes/kick.toml"]);
    const page = await openPage(browser, first.url);
    await page.getByRole("img", { name: /at / }).first().waitFor();
    await first.stop();
    await page.getByText("connection lost, trying again").waitFor();
    await page.screenshot({ path: join(out, "lost.png") });
    const second = await startProgram(["sim", "maps/scenes/kick.toml"], first.port);
    await page.getByText("connection lost, trying again").waitFor({ state: "hidden" });
    // It has another token now.
    await page.getByLabel("Token").fill(second.token);
    await page.getByRole("button", { name: "Use it" }).click();
    await page.locator(".link", { hasText: "operator" }).waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
    await second.stop();
  });
});

describe("the page of a robot that is localized", () => {
  it("localizes it, drives it by keys, and tells its filter where it is by hand", async () => {
    const words = ["sim", "maps/fields/f2000.toml", "--robot", "maps/robots/pioneer.toml"];
    const program = await startProgram(words);
    const client = await startClient(program);
    const page = await openPage(browser, `${program.url}&panel=localization`);
    await page.getByRole("button", { name: "Localize: off" }).click();
    // Learning may take less time than the page needs to ask how far it is.
    await page.getByRole("button", { name: "Localize: on" }).waitFor({ timeout: 90000 });
    await page.getByText("tracking").first().waitFor({ timeout: 90000 });
    // Both keys before the page can draw anything.
    await page.evaluate(() => {
      for (const [type, key] of [["keydown", "d"], ["keyup", "d"], ["keydown", "a"]]) {
        document.body.dispatchEvent(new KeyboardEvent(type, { key, bubbles: true, cancelable: true }));
      }
    });
    await page.getByText("drive pioneer").waitFor();
    await page.getByText(/^VELOCITY v_m_s=0 w_rad_s=1\.0\d* robot=1/).first().waitFor();
    await page.keyboard.up("a");
    await page.getByText(/^VELOCITY v_m_s=0 w_rad_s=0 robot=1/).first().waitFor();
    await until("it stands", async () => {
      const [before, now] = [await client.pose(1), await client.pose(1)];
      return Math.hypot(now.x - before.x, now.y - before.y) < 0.005;
    });
    await page.keyboard.press("Escape");
    await tab(page, "Localization").click();
    const truth = await client.pose(1);
    const from = await onScreen(page, truth.x > 0 ? -4 : 4, 2);
    await page.keyboard.down("Shift");
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + 50, from.y);
    await page.mouse.up();
    await page.keyboard.up("Shift");
    await page.getByText(/^LOCALIZE robot=1 x_m=-?[34]\S* y_m=[12]\S* theta_deg=0/).first().waitFor();
    await page.locator(".said .outcome", { hasText: "OK" }).waitFor();
    assert.deepEqual(page.problems, []);
    client.close();
    await page.close();
    await program.stop();
  });

  it("has its map brightest where the robot is, and tells why", async () => {
    const words = ["sim", "maps/fields/f2000.toml", "--robot", "maps/robots/pioneer.toml", "--localize", "all"];
    const program = await startProgram(words);
    const client = await startClient(program);
    const page = await openPage(browser, `${program.url}&panel=localization`);
    await page.getByText("tracking").first().waitFor({ timeout: 60000 });
    await checkReadings(page, "localized");
    await client.ask("PAUSE");
    // The same readings in every run: a map is of one moment, whose false sightings may move its brightest cell.
    await client.ask("RESET seed=1");
    await client.ask("PLACE robot=1 x_m=-2.5 y_m=1.5 theta_deg=30");
    await client.ask("STEP cycles=20");
    const first = page.waitForEvent("websocket");
    await page.getByLabel("on the field").check();
    // Maps come over a connection of their own, so that nothing waits behind them.
    await (await first).waitForEvent("framesent", { predicate: ({ payload }) => /HEATMAP/.test(String(payload)) });
    const truth = await client.pose(1);
    await until("the map is brightest where the robot is", async () => {
      const text = await page.getByText(/^brightest at/).textContent();
      const [x, y] = /at (\S+), (\S+)$/.exec(text).slice(1).map(Number);
      return Math.hypot(x - truth.x, y - truth.y) < 0.3;
    });
    await page.getByLabel("each feature").check();
    await page.getByRole("img", { name: /^map of LMS200\/LRF/ }).waitFor();
    const there = await onScreen(page, truth.x + 0.6, truth.y + 0.6);
    await page.mouse.click(there.x, there.y);
    await page.getByRole("heading", { name: /^Why / }).waitFor();
    await page.getByText(/^(Possible|Improbable|Practically ruled out): .* times less probable/).waitFor();
    await until("the answer is in sight", async () => {
      const { y } = await page.getByRole("heading", { name: /^Why / }).boundingBox();
      return y > 80 && y < 640;
    });
    await page.getByRole("button", { name: /180DegreeScan/ }).click();
    await page.getByRole("columnheader", { name: "expected" }).waitFor();
    const legend = page.getByRole("group", { name: "Legend" });
    await legend.getByText(/\(log\), \d/).waitFor();
    await legend.getByText("scan", { exact: true }).waitFor();
    await checkAccess(page, "map");
    assert.deepEqual(page.problems, []);
    client.close();
    await page.close();
    await program.stop();
  });
});

describe("the page of a server that records", () => {
  it("begins and ends a record that can be read then", async () => {
    const folder = mkdtempSync(join(tmpdir(), "ortung-page-"));
    const program = await startProgram(["sim", "maps/scenes/f2000_match.toml", "--record-into", folder]);
    const page = await openPage(browser, program.url);
    const client = await startClient(program);
    await robot(page, "blue2").waitFor();
    const { number } = (await client.robots()).find(({ name }) => name === "blue2");
    await robot(page, "blue2").focus();
    await page.keyboard.press("Enter");
    const one = page.getByRole("button", { name: "Record blue2" });
    await one.click();
    await page.getByText("blue2-1.rec", { exact: true }).waitFor();
    assert.equal(await one.getAttribute("aria-pressed"), "true");
    await page.locator(".said code", { hasText: `RECORD robot=${number} on` }).waitFor();
    await client.ask("RECORD robot=all on"); // by another client
    const all = page.getByRole("button", { name: "Record all robots", pressed: true });
    await all.waitFor();
    await until("something was recorded", async () => Number(await client.key(`RECORD robot=${number}`, "moments")) > 20);
    await page.screenshot({ path: join(out, "recording.png") });
    await all.click();
    await page.getByRole("button", { name: "Record blue2", pressed: false }).waitFor();
    const moments = await client.key(`RECORD robot=${number}`, "moments");
    assert.ok(Number(moments) > 20);
    const checked = runProgram(["check", join(folder, "blue2-1.rec")]);
    assert.equal(checked.status, 0, checked.stderr);
    assert.match(checked.stdout, /reference\/groundTruth\/pose/);
    const viewed = await startProgram(["view", join(folder, "blue2-1.rec"), "--world", "maps/fields/f2000.toml"]);
    const other = await startClient(viewed);
    assert.equal((await other.robots()).length, 1);
    assert.deepEqual(page.problems, []);
    other.close();
    client.close();
    await page.close();
    await viewed.stop();
    await program.stop();
    rmSync(folder, { recursive: true });
  });

  it("says what it must be started with", async () => {
    const program = await startProgram(["sim", "maps/scenes/kick.toml"]);
    const page = await openPage(browser, program.url);
    await page.getByRole("button", { name: /^Record / }).first().click();
    await page.getByRole("alert").filter({ hasText: "--record-into FOLDER" }).waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
    await program.stop();
  });
});

/** What of a record is the same with a server and without one: a map with its age, why, and curves of all of its time. */
async function checkMapOfRecord(page, what) {
  await page.getByLabel("on the field").check();
  await page.getByText(/^brightest at/).waitFor();
  await page.getByText(/^\d+(\.\d)? s (old|ahead)/).waitFor();
  await page.locator(".chart canvas").first().waitFor();
  const there = await onScreen(page, 0.5, 0.5);
  await page.mouse.click(there.x, there.y);
  await page.getByRole("heading", { name: /^Why / }).waitFor();
  await page.getByRole("button", { name: /180DegreeScan/ }).click();
  await page.getByRole("columnheader", { name: "expected" }).waitFor();
  await page.screenshot({ path: join(out, `${what}.png`) });
  assert.deepEqual(page.problems, []);
}

describe("the page of a record that is weighed", () => {
  let folder;
  const at = (name) => join(folder, name);
  const run = (words) => {
    const made = runProgram(words);
    assert.equal(made.status, 0, made.stderr);
  };
  before(() => {
    folder = mkdtempSync(join(tmpdir(), "ortung-page-"));
    const kRobot = ["--robot", "maps/robots/pioneer.toml"];
    run(["learn", "--world", "maps/fields/f2000.toml", ...kRobot, "--out", at("f2000.ortung"), "--cell", "0.2"]);
    run(["sim", "maps/fields/f2000.toml", ...kRobot, "--duration", "8", "--free-run", "--record", at("run.rec")]);
  });
  after(() => rmSync(folder, { recursive: true }));

  it("has maps of any moment, and tells why, by its tables alone", async () => {
    const program = await startProgram(["view", at("run.rec"), "--tables", at("f2000.ortung")]);
    const page = await openPage(browser, `${program.url}&panel=localization`);
    const client = await startClient(program);
    await page.getByRole("button", { name: "Pause" }).click();
    for (const time of [6, 2]) {
      await client.ask(`SEEK time_s=${time}`);
      const [, line] = await client.ask("READ */groundTruth/* robot=1");
      const [x, y] = line.split(" ").slice(3, 5).map((word) => (Number(word) - 2 ** 31) / 1000);
      await page.getByLabel("on the field").check();
      await until(`the map of ${time} s is brightest where the robot was`, async () => {
        const text = await page.getByText(/^brightest at/).textContent();
        const [a, b] = /at (\S+), (\S+)$/.exec(text).slice(1).map(Number);
        return Math.hypot(a - x, b - y) < 0.5;
      });
    }
    await checkMapOfRecord(page, "record-map");
    client.close();
    await page.close();
    await program.stop();
  });

  it("has those of some moments without a server", async () => {
    run(["export", "html", at("run.rec"), "--tables", at("f2000.ortung"), "--maps", "3", "--out", at("run.html")]);
    const page = await openPage(browser, `file://${at("run.html")}#panel=localization`);
    const moments = page.getByRole("group", { name: "Moments with maps" });
    await until("it says which", async () => (await moments.getByRole("button").count()) === 3);
    await page.getByRole("button", { name: "Pause" }).click();
    await moments.getByRole("button").last().click();
    await checkMapOfRecord(page, "exported-map");
    await page.getByLabel("each feature").check();
    await page.getByRole("img", { name: /^map of LMS200\/LRF/ }).waitFor();
    await tab(page, "Record").click();
    await page.getByRole("rowheader", { name: "LMS200/LRF/180DegreeScan" }).waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  it("has two runs side by side, seen alike, or upon each other", async () => {
    const program = await startProgram(["view", at("run.rec"), at("run.rec"), "--tables", at("f2000.ortung")]);
    const page = await openPage(browser, `${program.url}&panel=localization`);
    const fields = page.getByRole("region", { name: /^Field of run/ });
    await until("there are two fields", async () => (await fields.count()) === 2);
    const scales = () => page.locator(".over").evaluateAll((all) =>
      all.map((svg) => svg.querySelector("g").getAttribute("transform").split(" ", 4).join(" ")));
    await until("each is drawn", async () => (await page.getByRole("img", { name: /^run(-2)? at / }).count()) === 2);
    const [before] = await scales();
    const box = await fields.last().boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.wheel(0, -400);
    await until("both are larger", async () => {
      const [a, b] = await scales();
      return a === b && a !== before;
    });
    await page.getByRole("button", { name: "run-2", exact: true }).click();
    await page.getByRole("heading", { name: "Estimated pose of run-2" }).waitFor();
    // It is the same record with the same seed: nothing is between its two localizations.
    await page.locator(".chart figcaption", { hasText: /from run 0\.00/ }).waitFor();
    await checkAccess(page, "side-by-side");
    await page.getByRole("button", { name: "Side by side" }).click();
    await until("there is one field", async () => (await fields.count()) === 0);
    await until("their names do not lie upon each other", async () => {
      const ys = await page.locator(".name").evaluateAll((all) => all.filter((one) => one.textContent).map((one) => Number(one.getAttribute("y"))));
      return ys.length === 2 && Math.abs(ys[0] - ys[1]) >= 12;
    });
    await page.screenshot({ path: join(out, "upon-each-other.png") });
    assert.deepEqual(page.problems, []);
    await page.close();
    await program.stop();
  });

  it("shows what there is of a record of which nothing is known", async () => {
    const lines = at("lines.txt");
    run(["import", "record", at("run.rec"), "--out", lines]);
    // Of no world, and without true poses: odometry and scans are all that is left.
    const kept = readFileSync(lines, "utf8").split("\n").filter((line) => !/^# world|groundTruth/.test(line));
    writeFileSync(at("bare.rec"), kept.join("\n"));
    const program = await startProgram(["view", at("bare.rec")]);
    const page = await openPage(browser, `${program.url}&panel=game`);
    await page.getByRole("img", { name: /^bare at / }).waitFor();
    await until("the whole way is drawn", async () => /^M.*L/.test((await page.locator(".way").getAttribute("d")) ?? ""));
    assert.equal(await page.locator(".border").count(), 0, "there is no field whose edge could be drawn");
    await page.getByText("Layers", { exact: true }).click();
    await until("scans are along it", () => page.getByLabel("scans along it").isChecked());
    await page.getByRole("rowheader", { name: "odometry/odometry/pose" }).waitFor();
    await tab(page, "Localization").click();
    await page.getByText(/With --tables hall.ortung/).waitFor();
    await checkAccess(page, "bare");
    assert.deepEqual(page.problems, []);
    await page.close();
    await program.stop();
  });
});

describe("the page of a record", () => {
  it("goes to any time of it, and to what happened", async () => {
    const folder = mkdtempSync(join(tmpdir(), "ortung-page-"));
    const record = join(folder, "run.rec");
    const made = runProgram(["sim", "maps/scenes/f2000_match.toml", "--duration", "20", "--free-run", "--recorded", "blue2", "--record", record]);
    assert.equal(made.status, 0, made.stderr);
    const program = await startProgram(["view", record, "--world", "maps/fields/f2000.toml"]);
    const page = await openPage(browser, `${program.url}&panel=game`);
    const client = await startClient(program);
    await page.getByRole("button", { name: "Pause" }).click();
    const bar = page.getByRole("slider", { name: "Time of the record" });
    await bar.focus();
    await page.keyboard.press("End");
    await until("it is at its end", async () => Number(/now=(\d+)/.exec((await client.ask("STATUS"))[0])[1]) > 19e6);
    await page.locator(".events button").last().click();
    await until("it is at its first event", async () => Number(/now=(\d+)/.exec((await client.ask("STATUS"))[0])[1]) < 1e6);
    const { x, y } = await client.pose(1);
    await until("the robot is shown where it was", async () => {
      const label = await page.getByRole("img", { name: /^run at / }).getAttribute("aria-label");
      const [a, b] = /at (\S+), (\S+)$/.exec(label).slice(1).map(Number);
      return Math.hypot(a - x, b - y) < 0.12;
    });
    await checkPanels(page, "record", "Record");
    assert.deepEqual(page.problems, []);
    client.close();
    await page.close();
    await program.stop();
    rmSync(folder, { recursive: true });
  });
});

describe("the page of the demo", () => {
  it("shows how the robot finds its place, lends it out, and records", async () => {
    const folder = mkdtempSync(join(tmpdir(), "ortung-page-"));
    const program = await startProgram(["demo", "--record-into", folder]);
    const page = await openPage(browser, program.url);
    const story = page.locator(".story");
    await until("several places fit", async () => /^2 places fit what it senses/.test(await story.textContent()), 90);
    await page.screenshot({ path: join(out, "demo.png") });
    await until("one is left", async () => /^Found: of \d places one is left/.test(await story.textContent()), 90);
    await page.getByRole("combobox", { name: "Speed", exact: true }).evaluate((one) => one.value).then((speed) => assert.equal(speed, "1"));
    // Space pauses, whatever has the focus.
    await tab(page, "Robots").click();
    await page.keyboard.press("Space");
    await page.getByRole("button", { name: "Go on" }).waitFor();
    await page.getByRole("button", { name: "Go on" }).focus();
    await page.keyboard.press("Space");
    await page.getByRole("button", { name: "Pause" }).waitFor();
    const client = await startClient(program);
    const listed = async () => (await client.ask("LIST robots"))[1];
    assert.match(await listed(), / player=wander/);
    await page.keyboard.press("d");
    await page.keyboard.down("a");
    await page.getByText("pioneer was taken from its player wander.").waitFor();
    assert.match(await listed(), / taken_from=wander/);
    await page.screenshot({ path: join(out, "taken.png") });
    await page.keyboard.up("a");
    await page.keyboard.press("Escape");
    await page.getByText(/^RETURN robot=1/).first().waitFor();
    await until("it wanders again", async () => / player=wander/.test(await listed()));
    await page.getByRole("button", { name: "Record pioneer" }).click();
    await page.getByText("pioneer-1.rec", { exact: true }).waitFor();
    assert.deepEqual(page.problems, []);
    client.close();
    await page.close();
    await program.stop();
    rmSync(folder, { recursive: true });
  });
});

describe("the page of a building", () => {
  it("has a floor as of a map, and no game", async () => {
    const program = await startProgram(["sim", "maps/fields/offices.toml", "--robot", "maps/robots/pioneer_lrf.toml"]);
    const page = await openPage(browser, `${program.url}&panel=game`);
    await robot(page, "pioneer_lrf").waitFor();
    await tab(page, "World").waitFor();
    assert.equal(await page.locator(".score, .big-score").count(), 0);
    assert.equal(await page.getByRole("group", { name: "Orders" }).count(), 0);
    assert.equal(await page.locator(".floor.pitch").count(), 0);
    assert.ok((await page.locator(".solid").count()) > 3, "furniture");
    const shares = await page.locator("canvas.free").evaluate((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return data.filter((_, i) => i % 4 === 3).reduce((sum, alpha) => sum + alpha / 255, 0) / (data.length / 4);
    });
    // Three floors are 0.7 of the picture, walls and furniture included; the rest lies between them.
    assert.ok(shares > 0.5 && shares < 0.75, `${shares} of all cells are free`);
    await checkAccess(page, "building");
    assert.deepEqual(page.problems, []);
    await page.close();
    await program.stop();
  });
});
