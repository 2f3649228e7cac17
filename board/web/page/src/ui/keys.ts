import { kPanels } from "../layout/Layout";
import { enlarged } from "../layout/moves";
import type { Context } from "./context";
import { isTypedInto } from "./typing";

/** Keys of the whole page: what they do, for the help and for `installKeys`. */
export const kKeys: { keys: string; about: string }[] = [
  { keys: "space", about: "pause, go on (Enter presses a button)" },
  { keys: ".", about: "one cycle, while it is paused" },
  { keys: "n, p", about: "next robot, previous robot" },
  { keys: "1 to 4", about: "panels" },
  { keys: "x", about: "the last panel over the field, and back" },
  { keys: "+ − 0", about: "larger, smaller, the whole field" },
  { keys: "f", about: "follow the selected robot" },
  { keys: "m", about: "measure" },
  { keys: "d", about: "drive with W A S D or the arrow keys" },
  { keys: "v", about: "two or three dimensions" },
  { keys: "l", about: "protocol log" },
  { keys: "?", about: "this help" },
];

export function installKeys({ session, ui }: Context): void {
  const { board } = session;
  const press = (selector: string) => document.querySelector<HTMLButtonElement>(selector)?.click();
  const select = (by: number) => {
    const numbers = [...board.robots.keys()].sort((a, b) => a - b);
    if (!numbers.length) return;
    const at = numbers.indexOf(board.selected);
    session.select(numbers[(at + by + numbers.length) % numbers.length]!);
  };
  const actions: Record<string, () => void> = {
    " ": () => {
      if (board.isOperator) void session.act(board.state === "paused" ? "RESUME" : "PAUSE", "time");
    },
    ".": () => {
      if (board.isOperator && board.state === "paused") void session.act("STEP", "time");
    },
    n: () => select(1),
    p: () => select(-1),
    "+": () => press('[aria-label="Larger"]'),
    "=": () => press('[aria-label="Larger"]'),
    "-": () => press('[aria-label="Smaller"]'),
    "0": () => press('[aria-label="Whole field"]'),
    f: () => ui.change({ follow: !ui.follow }),
    m: () => ui.change({ tool: ui.tool === "measure" ? "look" : "measure" }),
    d: () => ui.change({ drivesByKeys: !ui.drivesByKeys, panel: "robots" }),
    v: () => ui.change({ is3d: !ui.is3d }),
    l: () => ui.change({ isLogOpen: !ui.isLogOpen }),
    "?": () => ui.change({ isHelpOpen: !ui.isHelpOpen }),
    Escape: () => {
      // What was begun ends first; a panel over the field stays until nothing else is to end.
      const isBusy = ui.isHelpOpen || ui.drivesByKeys || ui.tool !== "look" || ui.asked !== null;
      const layout = isBusy ? ui.layout : enlarged(ui.layout, null);
      ui.change({ isHelpOpen: false, drivesByKeys: false, tool: "look", asked: null, layout });
    },
    x: () => ui.change({ layout: enlarged(ui.layout, ui.layout.large === null ? ui.panel : null) }),
  };
  kPanels.forEach((panel, i) => (actions[String(i + 1)] = () => ui.change({ panel })));
  window.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    // Enter presses what space does not; a box is checked by space alone.
    const isPressing = event.key === " " && target.closest('input[type="checkbox"]');
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || isPressing) return;
    if (isTypedInto(target) && event.key !== "Escape") return;
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
