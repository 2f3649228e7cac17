import type { Board } from "../model/Board";
import type { Ui } from "./Ui";

/** Browsers draw at most sixteen things with WebGL, and smaller fields show little. */
export const kMostFields = 6;

/** Whether there are runs that could be side by side. */
export const canBeApart = (board: Board): boolean =>
  board.kind === "record" && board.robots.size > 1 && board.robots.size <= kMostFields;

/** Whether runs are shown side by side, a field each. */
export const areApart = (board: Board, ui: Pick<Ui, "isOneField" | "is3d">): boolean =>
  canBeApart(board) && !ui.isOneField && !ui.is3d;
