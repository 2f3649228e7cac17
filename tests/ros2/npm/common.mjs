// What the tests share: the program, records as lines of text, and schemas of others.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { parse } from "@foxglove/rosmsg";
import { ros2jazzy } from "@foxglove/rosmsg-msgs-common";

export const program = process.env.ORTUNG_PROGRAM;
export const source = process.env.ORTUNG_SOURCE;

export function folder(test) {
  const path = mkdtempSync(join(tmpdir(), "ortung-ros2-"));
  test.after(() => rmSync(path, { recursive: true }));
  return (name) => join(path, name);
}

export const ortung = (...words) => execFileSync(program, words, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });

/** Readings of a record in lines of text: {stamp, id, words}. */
export function record(file) {
  return readFileSync(file, "utf8")
    .split("\n")
    .filter((line) => line && !line.startsWith("#"))
    .map((line) => {
      const [stamp, id, , ...words] = line.split(" ");
      return { stamp: Number(stamp), id, words: words.map(Number) };
    });
}

/** A definition as ROS 2's own packages have it, and all that it is made of. */
export function definitions(type) {
  const found = new Map();
  const add = (name) => {
    const definition = ros2jazzy[name];
    if (!definition || found.has(name)) return;
    found.set(name, definition);
    for (const field of definition.definitions) if (field.isComplex) add(field.type);
  };
  add(type);
  return [...found.values()];
}

export const parseSchema = (text) => parse(text, { ros2: true });

/** Fields by type name, without constants: what two definitions must have in common. */
export const fieldsOf = (list, root) =>
  Object.fromEntries(
    list.map((one, i) => [
      one.name ?? (i === 0 ? root : "?"),
      one.definitions.filter((d) => !d.isConstant).map((d) => [d.type, d.name, !!d.isArray, d.arrayLength ?? 0]),
    ]),
  );

export const length = (word) => (word - 2 ** 31) / 1000;
export const angle = (word) => ((word - 18000) * Math.PI) / 18000;
export const heading = (q) => 2 * Math.atan2(q.z, q.w);
