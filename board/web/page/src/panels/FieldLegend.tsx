import type { ComponentChildren } from "preact";
import { useBoard, usePage } from "../ui/context";
import { ageOf, probability } from "./parts";

interface Entry { name: string; sign: ComponentChildren }

const line = (colour: string, dash = "") => <path d="M0 6H20" stroke={colour} stroke-width="2.5" stroke-dasharray={dash} />;
const dot = (colour: string) => <circle cx="10" cy="6" r="2.5" fill={colour} />;

/** What is drawn of the selected robot, in its colours. */
export function FieldLegend() {
  const board = useBoard(300);
  const { ui, insight } = usePage();
  const { robot } = board;
  const { layers } = ui;
  if (!layers.legend || ui.is3d) return null;
  const entries: Entry[] = [];
  const add = (isShown: boolean, name: string, sign: ComponentChildren) => isShown && entries.push({ name, sign });
  const has = (kind: Parameters<NonNullable<typeof robot>["heldOf"]>[0]) => robot?.heldOf(kind) !== undefined;
  const isBelieved = robot !== null && robot.estimate !== null;
  add(layers.samples && has("samples"), "samples", <path d="M5 2l10 4l-10 4z" fill="#ffa52e" />);
  add(layers.places && has("clusters"), "places, 2 σ", <ellipse cx="10" cy="6" rx="8" ry="4.5" class="place" style={{ strokeWidth: 1.5 }} />);
  add(layers.estimate && isBelieved && robot.truth !== null, "estimate", line("#ff9d2e", "4 3"));
  add(layers.bound && isBelieved && Number.isFinite(robot.protection?.metres), "bound of its error", line("#ff6b6b", "5 2"));
  add(layers.rays && (robot?.features.some(({ kind, name }) => kind.name === "scan" && robot.readings.has(name)) ?? false), "scan", dot("#57b5e8"));
  add(layers.sightings && (robot?.features.some(({ kind, name }) => kind.name === "rows" && robot.readings.get(name)?.words.length) ?? false), "sightings", dot("#cc78a6"));
  add(layers.expected && ui.expected !== null, "expected", dot("#f2d933"));
  add(layers.along && !!robot?.along?.length, "scans of the whole record", dot("#3380bf"));
  add(layers.ghost && robot?.ghost != null, "odometry", line("#e8edf3", "1 3"));
  const { map } = insight;
  if (!entries.length && !map) return null;
  return (
    <div class="field-legend" role="group" aria-label="Legend">
      {entries.map(({ name, sign }) => (
        <span key={name}>
          <svg viewBox="0 0 20 12" width="20" height="12" fill="none" aria-hidden="true">{sign}</svg> {name}
        </span>
      ))}
      {map && (
        <span>
          {probability(map.low)} <i class="ramp" aria-hidden="true" /> {probability(map.high)}
          {insight.wish.of === "probability" && insight.wish.scale === "log" && " (log)"}, {ageOf(map.stamp, board)}
        </span>
      )}
    </div>
  );
}
