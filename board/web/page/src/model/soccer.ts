import { parseHead } from "../link/words";
import type { Happening, PlayerKind, Playing } from "./Board";

export const parseGame = (keys: Map<string, string>): Map<string, string> => keys;

/** The teams of a game with their scores: those keys of GAME that are not its own. */
export function scoresOf(game: Map<string, string>): { team: string; score: string }[] {
  const own = new Set(["phase", "restart", "restart_of", "half", "clock_s"]);
  const isScore = game.has("phase");
  return [...game]
    .filter(([key]) => !own.has(key) && !(isScore && key === "left"))
    .map(([team, score]) => ({ team, score }));
}

export function parseHappenings(lines: string[]): Happening[] {
  const found: Happening[] = [];
  for (const line of lines) {
    const match = /^(\d+) (\d+) ([^:]+): ?(.*)$/.exec(line);
    if (match) found.push({ number: Number(match[1]), stamp: Number(match[2]), what: match[3]!, text: match[4]! });
  }
  return found;
}

export function parsePlayerKinds(lines: string[]): PlayerKind[] {
  const kinds: PlayerKind[] = [];
  for (const line of lines) {
    const player = /^player (\S+) ?(.*)$/.exec(line);
    if (player) kinds.push({ name: player[1]!, text: player[2]!, options: [] });
    const option = /^option (\S+) (\S+) (?:unit=(.*))?$/.exec(line) ?? /^option (\S+) (\S+) ?(.*)$/.exec(line);
    const kind = option && kinds.find(({ name }) => name === option[1]);
    if (!kind) continue;
    const isUnit = /^option \S+ \S+ unit=/.test(line);
    const rest = option[3] ?? "";
    const { unit, text } = isUnit ? splitUnit(rest) : { unit: "", text: rest };
    if (unit !== "file") kind.options.push({ key: option[2]!, unit, text });
  }
  return kinds;
}

/** A unit may have blanks in it (`x1,y1,... in m`); a choice and a plain unit have none. */
function splitUnit(rest: string): { unit: string; text: string } {
  const match = /^(\S+(?: in (?:m|deg|s))?) ?(.*)$/.exec(rest);
  return { unit: match?.[1] ?? "", text: match?.[2] ?? "" };
}

export function parsePlaying(lines: string[]): Playing[] {
  return lines.map((line) => {
    const { keys } = parseHead(line);
    return { robot: keys.get("robot") ?? "", player: keys.get("player") ?? "", team: keys.get("team") ?? "" };
  });
}
