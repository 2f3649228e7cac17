// Pictures of the page beside a board that runs: node e2e/look.mjs BOARD_PORT OUT [fragment]
import { serveBuilt } from "../dev/serve.mjs";
import { openPage, startBrowser } from "./program.mjs";

const [port, out, fragment = ""] = process.argv.slice(2);
const server = await serveBuilt(() => Number(port));
const browser = await startBrowser();
for (const [name, width, height, colorScheme] of [["dark", 1280, 720, "dark"], ["light", 1280, 720, "light"], ["tablet", 820, 1180, "light"]]) {
  const page = await openPage(browser, `http://127.0.0.1:${server.port}/${fragment}`, { viewport: { width, height }, colorScheme });
  await page.waitForTimeout(3000);
  await page.screenshot({ path: `${out}-${name}.png` });
  console.log(name, "fps", await page.locator(".stage2d").getAttribute("data-fps"));
  for (const problem of page.problems) console.log(name, problem);
  await page.close();
}
await browser.close();
server.close();
