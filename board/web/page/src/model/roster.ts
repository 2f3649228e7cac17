import { numberOf, parseHead } from "../link/words";
import type { Board } from "./Board";
import { Robot } from "./Robot";

/** Takes over which robots there are (LIST robots). @returns the numbers of those that are gone */
export function takeRobots(board: Board, lines: string[]): number[] {
  const there = new Set<number>();
  for (const line of lines) {
    const { keys } = parseHead(line);
    const number = numberOf(keys, "robot", 0);
    if (!Number.isInteger(number) || number <= 0) continue;
    there.add(number);
    let robot = board.robots.get(number);
    if (!robot || (robot.name && robot.name !== keys.get("name"))) {
      robot = new Robot(number);
      board.robots.set(number, robot);
      board.scene++;
    }
    robot.name = keys.get("name") ?? "";
    robot.team = keys.get("team") ?? teamInName(robot.name);
    robot.player = keys.get("player") ?? "";
    robot.takenFrom = keys.get("taken_from") ?? "";
    robot.record = keys.get("record") ?? "";
    if (robot.record !== "failed") robot.recordProblem = "";
    robot.client = numberOf(keys, "client", 0);
  }
  const gone: number[] = [];
  for (const number of [...board.robots.keys()]) {
    if (there.has(number)) continue;
    board.robots.delete(number);
    board.scene++;
    gone.push(number);
  }
  return gone;
}

/** Older servers do not tell the team; a name such as blue2 does. */
function teamInName(name: string): string {
  return /^(blue|yellow|cyan|magenta|red|green)\d*$/i.exec(name)?.[1]?.toLowerCase() ?? "";
}
