import { within } from "../layout/Layout";

/** An edge that is dragged, moved by arrow keys, put back by a double click. */
export function Divider(props: {
  label: string;
  /** Along which the edge moves. */
  axis: "x" | "y";
  /** 1: what it sizes grows to the right or downwards; -1: to the left or upwards. */
  grows: 1 | -1;
  range: { least: number; most: number; usual: number; step: number };
  value: number;
  controls: string;
  /** The value that puts the edge under a pointer. */
  valueAt(x: number, y: number, handle: HTMLElement): number;
  onSet(value: number): void;
}) {
  const { axis, grows, range, value, onSet } = props;
  const set = (wanted: number) => {
    const next = within(wanted, range);
    if (next !== value) onSet(next);
  };
  const drag = (event: PointerEvent) => {
    const handle = event.currentTarget as HTMLElement;
    if (handle.hasPointerCapture(event.pointerId)) set(props.valueAt(event.clientX, event.clientY, handle));
  };
  const press = (event: KeyboardEvent) => {
    // To the left and upwards the edge goes: panels at the right get wider, the field lower.
    const by = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
    const end = { Home: range.least, End: range.most }[event.key];
    if (by === undefined && end === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    set(end ?? value + grows * by! * range.step);
  };
  return (
    <div
      class={`divider along-${axis}`}
      role="separator"
      tabIndex={0}
      aria-label={props.label}
      aria-orientation={axis === "y" ? "horizontal" : "vertical"}
      aria-controls={props.controls}
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
