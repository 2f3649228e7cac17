import { useEffect, useState } from "preact/hooks";
import { usePage } from "../ui/context";
import { kFieldHeight, kSideWidth, within } from "../ui/sizes";

const kNarrow = "(max-width: 900px)";

/** The edge between field and panels: dragged, moved by arrow keys, put back by a double click. */
export function Divider() {
  const { ui } = usePage();
  const isNarrow = useNarrow();
  const range = isNarrow ? kFieldHeight : kSideWidth;
  const value = isNarrow ? ui.fieldHeight : ui.sideWidth;
  const set = (wanted: number) => {
    const next = within(wanted, range);
    if (next !== value) ui.change(isNarrow ? { fieldHeight: next } : { sideWidth: next });
  };
  const drag = (event: PointerEvent) => {
    const handle = event.currentTarget as HTMLElement;
    if (!handle.hasPointerCapture(event.pointerId)) return;
    const box = handle.parentElement!.getBoundingClientRect();
    set(isNarrow ? (100 * (event.clientY - box.top)) / box.height : box.right - event.clientX);
  };
  const press = (event: KeyboardEvent) => {
    // To the left and upwards the edge goes: panels get wider, the field lower.
    const by = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
    const end = { Home: range.least, End: range.most }[event.key];
    if (by === undefined && end === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    set(end ?? value + (isNarrow ? 1 : -1) * by! * range.step);
  };
  return (
    <div
      class="divider"
      role="separator"
      tabIndex={0}
      aria-label={isNarrow ? "Height of the field" : "Width of the panels"}
      aria-orientation={isNarrow ? "horizontal" : "vertical"}
      aria-controls="panel"
      aria-valuemin={range.least}
      aria-valuemax={range.most}
      aria-valuenow={value}
      title="drag, or arrow keys; double click: as it was"
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={drag}
      onKeyDown={press}
      onDblClick={() => set(range.usual)}
    />
  );
}

function useNarrow(): boolean {
  const [isNarrow, setNarrow] = useState(() => matchMedia(kNarrow).matches);
  useEffect(() => {
    const query = matchMedia(kNarrow);
    const changed = () => setNarrow(query.matches);
    query.addEventListener("change", changed);
    return () => query.removeEventListener("change", changed);
  }, []);
  return isNarrow;
}
