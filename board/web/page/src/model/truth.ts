import type { Reading } from "../link/readingsIn";
import type { Board } from "./Board";
import { headingOf, lengthOf } from "./decode";

/** What robot 0, the world itself, reads: where all robots and objects are. */
export function takeWorld(board: Board, { stamp, feature, words }: Reading): void {
  if (feature === "world/truth/robots") {
    for (let i = 0; i + 5 <= words.length; i += 5) {
      const robot = board.robots.get(words[i]!);
      if (!robot) continue;
      const pose = { x: lengthOf(words[i + 1]!), y: lengthOf(words[i + 2]!), theta: headingOf(words[i + 3]!) };
      robot.setTruth(pose, stamp);
      robot.states = words[i + 4]!;
    }
  } else if (feature === "world/truth/objects") {
    const names = board.world?.objects ?? [];
    board.objects = names.slice(0, words.length >> 2).map(({ name }, n) => ({
      name,
      x: lengthOf(words[4 * n]!),
      y: lengthOf(words[4 * n + 1]!),
      z: lengthOf(words[4 * n + 2]!),
      theta: headingOf(words[4 * n + 3]!),
    }));
  }
}
