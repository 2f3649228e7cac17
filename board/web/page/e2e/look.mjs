// Pictures of the page beside a board that runs: node e2e/look.mjs BOARD_PORT OUT [fragment]
import { chromium } from "playwright-core";
import { serveBuilt } from "../dev/serve.mjs";

export const kFlags = ["--no-sandbox", "--enable-unsafe-swiftshader",
  "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync"];
const [port, out, fragment = ""] = process.argv.slice(2);
const server = await serveBuilt(() => Number(port));
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: kFlags });
for (const [name, width, height, colorScheme] of [["dark", 1280, 720, "dark"], ["light", 1280, 720, "light"], ["tablet", 820, 1180, "light"]]) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme });
  page.on("console", (message) => console.log(name, message.type(), message.text().slice(0, 300)));
  page.on("pageerror", (error) => console.log(name, "ERROR", String(error.stack).slice(0, 600)));
  await page.goto(`http://127.0.0.1:${server.port}/${fragment}`);
  await page.waitForTimeout(3000);
  await page.screenshot({ path: `${out}-${name}.png` });
  console.log(name, "fps", await page.locator(".stage2d").getAttribute("data-fps"));
  await page.close();
}
await browser.close();
server.close();
