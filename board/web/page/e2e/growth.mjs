// Whether the page's memory grows, with ten robots, 10,000 samples, maps and curves: node e2e/growth.mjs [MINUTES]
import { serveBuilt } from "../dev/serve.mjs";
import { startLoad } from "../dev/load.mjs";
import { openPage, startBrowser } from "./program.mjs";

const minutes = Number(process.argv[2] ?? 30);
const board = await startLoad();
const server = await serveBuilt(() => board.port);
const browser = await startBrowser();
const page = await openPage(browser, `http://127.0.0.1:${server.port}/#robot=1&panel=localization`);
await page.getByRole("img", { name: /^robot1 at / }).waitFor();
await page.getByLabel("on the field").check();
await page.getByLabel("each feature").check();
const debug = await page.context().newCDPSession(page);
await debug.send("Performance.enable");
const begin = Date.now();
for (;;) {
  await debug.send("HeapProfiler.collectGarbage");
  const { metrics } = await debug.send("Performance.getMetrics");
  const of = (name) => metrics.find((metric) => metric.name === name).value;
  const time = (Date.now() - begin) / 60000;
  console.log(`${time.toFixed(1)} min: ${(of("JSHeapUsedSize") / 1e6).toFixed(2)} MB, ${of("Nodes")} nodes, ${of("JSEventListeners")} listeners`);
  if (time > minutes) break;
  await page.waitForTimeout(Math.min(60000, minutes * 6000));
}
for (const problem of page.problems) console.log(problem);
await browser.close();
server.close();
board.close();
process.exit(0);
