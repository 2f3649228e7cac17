import { createContext } from "preact";
import { useContext, useEffect, useState } from "preact/hooks";
import type { FileOpening } from "../model/FileOpening";
import type { Insight } from "../model/Insight";
import type { Session } from "../model/Session";
import type { Ui } from "./Ui";

export interface Context {
  session: Session;
  ui: Ui;
  insight: Insight;
  opening: FileOpening;
}

export const PageContext = createContext<Context | null>(null);

export function usePage(): Context {
  const context = useContext(PageContext);
  if (!context) throw new Error("a panel is outside of the page");
  return context;
}

/** Draws the calling component again when the board changes, but at most every @p period ms. */
export function useBoard(period = 100) {
  const { session, ui } = usePage();
  const [, redraw] = useState(0);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const touched = () => {
      timer ??= setTimeout(() => {
        timer = undefined;
        redraw((count) => count + 1);
      }, period);
    };
    const changed = () => redraw((count) => count + 1);
    const ends = [session.board.onTouch(touched), ui.onChange(changed)];
    return () => {
      clearTimeout(timer);
      ends.forEach((end) => end());
    };
  }, [session, ui, period]);
  return session.board;
}
