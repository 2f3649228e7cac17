import { curvesOf, nameOfKey, type PanelId } from "../layout/curves";
import type { Board } from "../model/Board";

const kTitles: Record<string, string> = { robots: "Robots", sensors: "Sensors", localization: "Localization" };

/** What the panel of the world itself is called. */
function titleOfWorld(board: Board): string {
  if (board.kind === "record") return "Record";
  return board.isGame ? "Game" : "World";
}

export function titleOf(panel: PanelId, board: Board): string {
  const curves = curvesOf(panel);
  if (curves) return curves.map(({ key }) => nameOfKey(key)).join(", ");
  return kTitles[panel] ?? titleOfWorld(board);
}
