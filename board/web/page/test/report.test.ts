import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";

const kPackage = new URL("../node_modules/uplot/", import.meta.url);
const kReport = new URL("../../../../app/report/uplot/", import.meta.url);

/** The program's build has no npm, so the charts of its report are a committed copy. */
describe("the charts of the report", () => {
  it.each(["LICENSE", "dist/uPlot.iife.min.js", "dist/uPlot.min.css"])("have the package's %s: npm run charts", (path) => {
    const copy = readFileSync(new URL(path.replace("dist/", ""), kReport), "utf8");
    expect(copy === readFileSync(new URL(path, kPackage), "utf8")).toBe(true);
  });

  it("can be put into a page", () => {
    expect(readFileSync(new URL("uPlot.iife.min.js", kReport), "utf8")).not.toMatch(/<\/script|<!--/i);
    expect(readFileSync(new URL("LICENSE", kReport), "utf8")).not.toMatch(/\*\/|<\/script/i);
  });
});
