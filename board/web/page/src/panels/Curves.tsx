import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { useBoard, usePage } from "../ui/context";
import { kSafe } from "../field/palette";
import type { Series } from "../model/History";
import { kLongAgo, seconds, Section } from "./parts";

const kPeriod = 100;
const kHeight = 110;

/** Numbers over time: one chart a unit, all that somebody has chosen. */
export function Curves({ only }: { only?: string }) {
  const { session, ui } = usePage();
  useBoard(500);
  const shown = [...session.history.series.values()].filter(
    ({ key }) => only === undefined || key.startsWith(only),
  );
  const units = [...new Set(shown.map(({ unit }) => unit))];
  if (!shown.length) return null;
  return (
    <Section title="Over time">
      {units.map((unit) => {
        const series = shown.filter((one) => one.unit === unit);
        return <Chart key={`${unit} ${series.map(({ key }) => key).join()}`} series={series} unit={unit} />;
      })}
      {only === undefined && (
        <button
          onClick={() => {
            session.history.series.clear();
            ui.change({});
          }}
        >
          Remove all curves
        </button>
      )}
    </Section>
  );
}

function Chart({ series, unit }: { series: Series[]; unit: string }) {
  const { session, ui } = usePage();
  const place = useRef<HTMLDivElement>(null);
  const isDark = ui.isDark;
  useEffect(() => {
    const element = place.current!;
    const ink = getComputedStyle(element).color;
    const grid = { stroke: isDark ? "#ffffff18" : "#00000014", width: 1 };
    const axis = { stroke: ink, grid, ticks: { show: false }, font: "11px system-ui" };
    const chart = new uPlot(
      {
        width: Math.max(160, element.clientWidth),
        height: kHeight,
        scales: { x: { time: false } },
        legend: { show: false },
        cursor: { y: false, drag: { x: false, y: false } },
        axes: [
          { ...axis, size: 22, values: (_, ticks) => ticks.map(timeOf) },
          { ...axis, size: 46, values: (_, ticks) => ticks.map((t) => String(Number(t.toPrecision(4)))) },
        ],
        series: [{}, ...series.map(({ label }, i) => ({ label, stroke: kSafe[i % kSafe.length]!, width: 1.5, points: { show: false } }))],
      },
      joined(series),
      element,
    );
    let version = -1;
    const timer = setInterval(() => {
      if (version === session.history.version) return;
      version = session.history.version;
      chart.setData(joined(series));
    }, kPeriod);
    const watcher = new ResizeObserver(() => chart.setSize({ width: Math.max(160, element.clientWidth), height: kHeight }));
    watcher.observe(element);
    return () => {
      clearInterval(timer);
      watcher.disconnect();
      chart.destroy();
    };
  }, [series.map(({ key }) => key).join(), isDark, session]);
  return (
    <figure class="chart">
      <figcaption>
        {series.map(({ key, label, values }, i) => (
          <span key={key}>
            <svg viewBox="0 0 10 10" class="swatch" aria-hidden="true">
              <rect y="3" width="10" height="4" fill={kSafe[i % kSafe.length]} />
            </svg>
            {label} <b>{values.at(-1)?.toFixed(2) ?? "–"}</b> {unit}
          </span>
        ))}
      </figcaption>
      <div ref={place} />
    </figure>
  );
}

/** Of a robot's own clock, which counts from 1970, the time of day. */
const timeOf = (time: number): string => (time < kLongAgo ? `${time} s` : seconds(time * 1e6));

/** One axis of time for all: where a series has no value it has a gap that is drawn over. */
function joined(series: Series[]): uPlot.AlignedData {
  if (series.length === 1) return [series[0]!.times, series[0]!.values];
  return uPlot.join(series.map(({ times, values }) => [times, values]));
}
