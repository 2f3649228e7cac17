import { useEffect } from "preact/hooks";
import { curvesOf, nameOfKey, type CurveRef, type PanelId } from "../layout/curves";
import { keysOut, takenOut } from "../layout/moves";
import type { Series } from "../model/History";
import { useBoard, usePage } from "../ui/context";
import { Chart } from "./Chart";
import { Section } from "./parts";

// Runs are far apart where they are metres from each other: errors of centimetres have a chart of their own.
const groupOf = ({ key, unit }: Series) => (key.startsWith("apart") ? `${unit} apart` : unit);

/**
 * Numbers over time: one chart a unit, all that somebody has chosen and that have no panel of their own.
 * @param only of keys that begin so
 */
export function Curves({ only }: { only?: string[] }) {
  const { session, ui } = usePage();
  useBoard(500);
  const out = keysOut(ui.layout);
  const shown = [...session.history.series.values()].filter(
    ({ key }) => !out.has(key) && (only === undefined || only.some((begin) => key.startsWith(begin))),
  );
  const groups = [...new Set(shown.map(groupOf))];
  if (!shown.length) return null;
  return (
    <Section title="Over time">
      {groups.map((group) => {
        const series = shown.filter((one) => groupOf(one) === group);
        const { unit } = series[0]!;
        return (
          <Chart
            key={`${group} ${series.map(({ key }) => key).join()}`}
            series={series}
            unit={unit}
            fills={false}
            onOut={(curve) => {
              const { layout } = ui;
              ui.change({ layout: takenOut(layout, [curve], { area: "bottom", before: layout.groups.bottom.length }) });
            }}
          />
        );
      })}
      {only === undefined && (
        <button
          onClick={() => {
            for (const { key } of shown) session.history.series.delete(key);
            ui.change({});
          }}
        >
          Remove all curves
        </button>
      )}
    </Section>
  );
}

/** A panel of curves that were taken out, as large as its place is. */
export function CurvesPanel({ panel }: { panel: PanelId }) {
  const { session, ui } = usePage();
  const board = useBoard(500);
  const { history } = session;
  const curves = curvesOf(panel) ?? [];
  useEffect(() => {
    for (const { key, unit } of curves) history.follow(key, nameOfKey(key), unit);
  }, [panel, history]);
  const there = curves.flatMap(({ key }) => history.series.get(key) ?? []);
  if (!there.length) {
    const who = board.robot?.label ?? "the robot";
    return <p class="hint">{curves.map(({ key }) => nameOfKey(key)).join(", ")}: {who} has no values of it so far.</p>;
  }
  const out = (curve: CurveRef) => {
    const { layout } = ui;
    ui.change({ layout: takenOut(layout, [curve], { area: "bottom", before: layout.groups.bottom.length }) });
  };
  return (
    <Chart
      key={there.map(({ key }) => key).join()}
      series={there}
      unit={curves[0]!.unit}
      fills
      onOut={curves.length > 1 ? out : undefined}
    />
  );
}
