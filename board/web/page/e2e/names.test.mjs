// Names and texts that want to be HTML, or to break the page, on their way from the board: the real program refuses them,
// so they are put in behind it.
import assert from "node:assert/strict";
import { after, before, describe, it } from "node:test";
import { openPage, out, startBrowser, startProgram, until } from "./program.mjs";
import { join } from "node:path";

const kEvil = {
  blue1: "<img/src=x:1/onerror=window.ran=1>",
  blue2: "\"><script>window.ran=1</script>",
  blue3: "javascript:window.ran=1",
  blue4: "\u202egnp.exe\u2066\u0000\u001b[31m",
  yellow1: "A".repeat(65536),
  yellow2: "'onmouseover='window.ran=1",
  yellow3: "{{constructor.constructor('window.ran=1')()}}",
  yellow4: "\u00e9\ud83d\ude00</text></svg><iframe/src=javascript:window.ran=1>",
};
const kTexts = {
  drives: `<img src=x:2 onerror=window.ran=1> ${"\u202e"}${"B".repeat(65536)}`,
  "odometry/odometry/pose": `<svg\fonload=window.ran=1>/${"D".repeat(4096)}/pose`,
  "there is no command": `<svg onload=window.ran=1> ${"C".repeat(65536)}`,
};

const latin = (text) => Buffer.from(text).toString("latin1"); // each byte a character, so that all stay as they are

function spoiltLine(line) {
  for (const [good, evil] of Object.entries({ ...kEvil, ...kTexts })) line = line.replaceAll(good, latin(evil));
  // A lone surrogate, and bytes that are no UTF-8.
  return line.replace(/ world=\S+/, " world=</span><b>\xed\xa0\x80\xff\xfe\x00");
}

/** What the board says, with evil names in place of the good ones, but for readings in binary form: they may be cut. */
function spoiler() {
  let raw = 0;
  return (message) => {
    let rest = Buffer.from(message).toString("latin1");
    let said = "";
    while (rest) {
      if (raw === 0) {
        const end = rest.indexOf("\n") < 0 ? rest.length : rest.indexOf("\n") + 1;
        const line = rest.slice(0, end);
        rest = rest.slice(end);
        said += spoiltLine(line);
        raw = Number(/ bytes=(\d+)/.exec(line)?.[1] ?? 0);
      }
      const bytes = rest.slice(0, raw);
      said += bytes;
      rest = rest.slice(bytes.length);
      raw -= bytes.length;
    }
    return Buffer.from(said, "latin1");
  };
}

describe("names and texts that want to be more", () => {
  let browser;
  let program;
  before(async () => {
    browser = await startBrowser();
    program = await startProgram(["sim", "maps/scenes/f2000_match.toml"]);
  });
  after(async () => {
    await browser.close();
    await program.stop();
  });

  it("are shown as they are, run nothing, ask for nothing and leave everything where it is", async () => {
    const requests = [];
    const page = await openPage(browser, "about:blank");
    page.on("request", (request) => requests.push(request.url()));
    page.on("dialog", (dialog) => page.problems.push(`dialog: ${dialog.message()}`));
    await page.routeWebSocket(/./, (socket) => {
      const spoil = spoiler();
      socket.connectToServer().onMessage((message) => socket.send(spoil(message)));
    });
    await page.goto(String(program.url));
    await page.getByRole("img", { name: /^<img\/src=x:1/ }).waitFor();
    await until("features have come", async () => (await page.evaluate(() => document.querySelectorAll(".robot").length)) === 8);
    const checkLayout = async (what) => {
      await page.screenshot({ path: join(out, `names-${what}.png`) });
      const found = await page.evaluate(() => {
        const rect = (query) => document.querySelector(query).getBoundingClientRect();
        const { scrollWidth, scrollHeight, clientWidth, clientHeight } = document.documentElement;
        const panel = document.querySelector(".panel");
        return {
          isPageWider: scrollWidth > clientWidth || scrollHeight > clientHeight,
          isPanelWider: panel.scrollWidth > panel.clientWidth,
          isPanelEndless: panel.scrollHeight > 6000,
          isTopTall: rect(".top").height > 120,
          isFieldGone: rect(".field").width < 300 || rect(".field").height < 300,
          isSaidGone: rect(".said").bottom > clientHeight + 1,
          strangers: document.querySelectorAll("img:not([src='./icon.svg']), iframe, object, embed, svg script, body script:not([src])").length,
          hasRun: window.ran !== undefined,
        };
      });
      const wrong = Object.entries(found).filter(([, value]) => value);
      assert.deepEqual(wrong, [], what);
    };
    for (const panel of ["Robots", "Sensors", "Localization", "Game"]) {
      await page.getByRole("tab", { name: panel }).click();
      await checkLayout(panel);
    }
    await page.getByRole("tab", { name: "Robots" }).click();
    for (const number of [0, 3, 4, 7]) {
      await page.locator(".robots button").nth(number).click();
      await checkLayout(`robot${number}`);
      await page.getByRole("tab", { name: "Sensors" }).click();
      await checkLayout(`sensors${number}`);
      await page.getByRole("tab", { name: "Robots" }).click();
    }
    await page.keyboard.press("l");
    await page.getByLabel("Send a line of the protocol").fill("NOSUCH <img src=x:3 onerror=window.ran=1>");
    await page.getByRole("button", { name: "Send", exact: true }).click();
    await page.getByRole("log").getByText("<svg onload").waitFor();
    await checkLayout("log");
    // Nothing of what the page holds turns the direction of other text, or is no character.
    const strange = await page.evaluate(() => /[\u0000-\u0008\u000e-\u001f\u200e\u200f\u202a-\u202e\u2066-\u2069]/.exec(document.documentElement.outerHTML)?.[0]);
    assert.equal(strange, undefined);
    const elsewhere = requests.filter((url) => new URL(url).host !== program.url.host);
    assert.deepEqual(elsewhere, []);
    assert.deepEqual(page.problems, []);
    await page.close();
  });
});
