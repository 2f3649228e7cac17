// Files that are dropped on the page, in a real browser with the real program: node --test e2e/
import assert from "node:assert/strict";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { openPage, out, root, runProgram, startBrowser, startProgram, until } from "./program.mjs";

let browser;
let folder;
const at = (name) => join(folder, name);
before(async () => {
  browser = await startBrowser();
  folder = mkdtempSync(join(tmpdir(), "ortung-page-"));
  const run = (words) => {
    const made = runProgram(words);
    assert.equal(made.status, 0, made.stderr);
  };
  const robot = ["--robot", "maps/robots/pioneer.toml"];
  for (const [name, duration] of [["first.rec", "4"], ["second.rec", "7"]]) {
    run(["sim", "maps/fields/f2000.toml", ...robot, "--duration", duration, "--free-run", "--record", at(name)]);
  }
  run(["export", "mcap", at("second.rec"), ...robot, "--out", at("bag.mcap")]);
  run(["export", "html", at("first.rec"), "--out", at("page.html")]);
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

/** Drops files where the pointer is at a share of the window's width. */
async function drop(page, files, across = 0.25) {
  const given = files.map((file) => ({ name: file.split("/").at(-1), bytes: readFileSync(file).toString("base64") }));
  await page.evaluate(({ given, across }) => {
    const dataTransfer = new DataTransfer();
    for (const { name, bytes } of given) dataTransfer.items.add(new File([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], name));
    const options = { dataTransfer, bubbles: true, cancelable: true, clientX: across * innerWidth, clientY: 300 };
    for (const type of ["dragenter", "dragover", "drop"]) document.body.dispatchEvent(new DragEvent(type, options));
  }, { given, across });
}

const named = (page, name) => page.getByRole("img", { name: new RegExp(`^${name} at `) });

describe("a file that is dropped on the page of a record", () => {
  it("is shown, alone or beside what is shown, and nothing of it is left", async () => {
    const temporary = mkdtempSync(join(tmpdir(), "ortung-page-"));
    process.env.TMPDIR = temporary;
    const program = await startProgram(["view", at("first.rec")]).finally(() => delete process.env.TMPDIR);
    const page = await openPage(browser, `${program.url}&panel=game`);
    await named(page, "first").waitFor();
    const length = async () => Number(await page.getByRole("slider", { name: "Time of the record" }).getAttribute("max")) / 1e6;
    assert.ok((await length()) < 5);
    await drop(page, [at("second.rec")]);
    await named(page, "second").waitFor();
    assert.equal(await named(page, "first").count(), 0);
    await until("it has its own length", async () => (await length()) > 6);
    await page.getByText("What second holds").waitFor();
    await drop(page, [at("first.rec")], 0.75);
    await page.getByRole("region", { name: /^Field of / }).nth(1).waitFor();
    await named(page, "first").waitFor();
    await page.locator(".link", { hasText: "operator" }).waitFor();
    await page.screenshot({ path: join(out, "dropped.png") });
    // A file of ROS is one, too; and by the menu.
    const chosen = page.waitForEvent("filechooser");
    await page.getByRole("button", { name: "Panels, layout, files" }).click();
    await page.getByRole("menuitem", { name: "Open a file …" }).click();
    await (await chosen).setFiles(at("bag.mcap"));
    await named(page, "bag").waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
    await program.stop();
    assert.deepEqual(readdirSync(temporary), []);
    rmSync(temporary, { recursive: true });
  });

  it("is told for what it is if it is something else", async () => {
    const program = await startProgram(["view", at("first.rec")]);
    const page = await openPage(browser, program.url);
    await named(page, "first").waitFor();
    writeFileSync(at("noise.rec"), Buffer.alloc(5000, 7));
    writeFileSync(at("cut.rec"), readFileSync(at("first.rec")).subarray(0, 3000));
    const said = async (file, text) => {
      await drop(page, [file]);
      await page.getByRole("alert").filter({ hasText: text }).waitFor();
      await page.getByRole("alert").getByRole("button", { name: "Close" }).click();
    };
    await said(join(root, "maps/robots/pioneer.toml"), /^pioneer\.toml is a robot file .*expected a record/);
    await said(at("page.html"), /page\.html is a page, as `ortung export html` writes them/);
    await said(at("noise.rec"), /noise\.rec is of no kind that is known here/);
    await drop(page, [at("first.rec"), at("second.rec")]);
    await page.getByRole("alert").filter({ hasText: "2 files were given" }).waitFor();
    await named(page, "first").waitFor();
    assert.deepEqual(page.problems.filter((text) => !/415|422/.test(text)), []);
    await page.close();
    await program.stop();
  });

  it("is opened for operators alone, and by programs that open files", async () => {
    const program = await startProgram(["view", at("first.rec"), "--drop-limit", "0"]);
    const page = await openPage(browser, program.url);
    await named(page, "first").waitFor();
    await drop(page, [at("second.rec")]);
    await page.getByRole("alert").filter({ hasText: /opens no files: open it by "ortung view second\.rec"/ }).waitFor();
    await page.close();
    await program.stop();
    const other = await startProgram(["view", at("first.rec")]);
    const guest = await openPage(browser, other.url.origin);
    await named(guest, "first").waitFor();
    await drop(guest, [at("second.rec")]);
    await guest.getByRole("alert").filter({ hasText: "Only operators open files" }).waitFor();
    await guest.close();
    await other.stop();
  });

  it("can't be opened by a page that stands alone, which says what can", async () => {
    const page = await openPage(browser, `file://${at("page.html")}`);
    await named(page, "first").waitFor();
    await drop(page, [at("second.rec")]);
    await page.getByRole("alert").filter({ hasText: /no program behind it .*ortung view second\.rec/ }).waitFor();
    assert.deepEqual(page.problems, []);
    await page.close();
  });
});
