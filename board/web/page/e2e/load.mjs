// How many frames a second the page draws with ten robots, 10,000 samples and a map: node e2e/load.mjs [OUT]
import { serveBuilt } from "../dev/serve.mjs";
import { startLoad } from "../dev/load.mjs";
import { openPage, startBrowser } from "./program.mjs";

const out = process.argv[2] ?? "e2e/out/load";
const board = await startLoad();
const server = await serveBuilt(() => board.port);
const browser = await startBrowser();
for (const colorScheme of ["dark", "light"]) {
  const page = await openPage(browser, `http://127.0.0.1:${server.port}/#robot=1&panel=localization`, { colorScheme });
  await page.getByRole("img", { name: /^robot1 at / }).waitFor();
  await page.waitForTimeout(3000);
  console.log(colorScheme, "samples:", await page.locator(".stage2d").getAttribute("data-fps"), "frames a second");
  await page.getByLabel("on the field").check();
  await page.getByLabel("each feature").check();
  await page.waitForTimeout(4000);
  console.log(colorScheme, "samples and maps:", await page.locator(".stage2d").getAttribute("data-fps"), "frames a second");
  await page.mouse.click(500, 300);
  await page.waitForTimeout(500);
  await page.screenshot({ path: `${out}-${colorScheme}.png` });
  await page.getByText("Layers").click();
  await page.getByLabel("expected").check();
  await page.getByLabel("trails").check();
  await page.getByLabel("on the field").uncheck();
  await page.getByRole("tab", { name: "Sensors" }).click();
  await page.waitForTimeout(1500);
  await page.screenshot({ path: `${out}-${colorScheme}-expected.png` });
  for (const problem of page.problems) console.log(problem);
  await page.close();
}
await browser.close();
server.close();
board.close();
process.exit(0);
