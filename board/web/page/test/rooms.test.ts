import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, normalize } from "node:path";
import { describe, expect, it } from "vitest";

/** Whom the files of a room may import beside their own; "": files beside the rooms, where the page begins. */
const kMay: Record<string, string[]> = {
  link: [],
  model: ["link"],
  layout: [],
  ui: ["layout", "model", "link"],
  field: ["ui", "model", "link"],
  scene: ["field", "ui", "model", "link"],
  panels: ["field", "ui", "layout", "model", "link"],
  app: ["panels", "scene", "field", "ui", "layout", "model", "link"],
  "": ["app", "ui", "layout", "model", "link"],
};

const kSource = new URL("../src/", import.meta.url).pathname;
const files = readdirSync(kSource, { recursive: true, encoding: "utf8" }).filter((file) => /\.tsx?$/.test(file));
const roomOf = (file: string): string => (file.includes("/") ? file.slice(0, file.indexOf("/")) : "");

/** The files that @p file names behind `from`, `import` or in `import()`, types as well as values. */
function importsOf(file: string): string[] {
  const named = readFileSync(join(kSource, file), "utf8").matchAll(/(?:\bfrom |^import |\bimport\()"(\.[^"]*)"/gm);
  return [...named].flatMap(([, path]) => {
    const base = normalize(join(dirname(file), path!));
    return files.find((one) => one.replace(/\.tsx?$/, "") === base) ?? [];
  });
}

const imports = new Map(files.map((file) => [file, importsOf(file)]));

/** Files that import each other, from the first one back to it; empty without any. */
function circle(file: string, above: string[] = [], done = new Set<string>()): string[] {
  if (above.includes(file)) return [...above.slice(above.indexOf(file)), file];
  if (done.has(file)) return [];
  for (const next of imports.get(file) ?? []) {
    const found = circle(next, [...above, file], done);
    if (found.length) return found;
  }
  done.add(file);
  return [];
}

describe("the rooms of the page", () => {
  it("are all known, and their files are read", () => {
    expect([...new Set(files.map(roomOf))].sort()).toEqual(Object.keys(kMay).sort());
    expect(imports.get("main.tsx")).toContain("app/App.tsx");
    expect(imports.get("scene/lazy.ts")).toContain("scene/Scene3d.ts"); // by import()
    expect(imports.get("model/truth.ts")).toContain("model/Board.ts"); // a type
  });

  it("import from those below them alone", () => {
    const wrong = [...imports].flatMap(([from, to]) =>
      to
        .filter((file) => roomOf(file) !== roomOf(from) && !kMay[roomOf(from)]!.includes(roomOf(file)))
        .map((file) => `${from} -> ${file}`),
    );
    expect(wrong).toEqual([]);
  });

  it("have no files that import each other in a circle", () => {
    const done = new Set<string>();
    expect(files.map((file) => circle(file, [], done)).filter((found) => found.length)).toEqual([]);
  });
});
