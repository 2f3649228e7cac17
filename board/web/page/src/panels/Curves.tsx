import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { useBoard, usePage } from "../ui/context";
import { kSafe } from "../field/palette";
import { plain } from "../link/words";
import { valueAt, type Series } from "../model/History";
import { kLongAgo, seconds, Section } from "./parts";

const kPeriod = 100;
const kHeight = 110;

/** Numbers over time: one chart a unit, all that somebody has chosen. */
/** @param only of keys that begin so */
export function Curves({ only }: { only?: string[] }) {
  const { session, ui } = usePage();
  useBoard(500);
  const shown = [...session.history.series.values()].filter(
    ({ key }) => only === undefined || only.some((begin) => key.startsWith(begin)),
  );
  // Runs are far apart where they are metres from each other: errors of centimetres have a chart of their own.
  const groupOf = ({ key, unit }: Series) => (key.startsWith("apart") ? `${unit} apart` : unit);
  const groups = [...new Set(shown.map(groupOf))];
  if (!shown.length) return null;
  return (
    <Section title="Over time">
      {groups.map((group) => {
        const series = shown.filter((one) => groupOf(one) === group);
        const { unit } = series[0]!;
        return <Chart key={`${group} ${series.map(({ key }) => key).join()}`} series={series} unit={unit} />;
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
  const { whole } = session.history;
  const place = useRef<HTMLDivElement>(null);
  const isDark = ui.isDark;
  useEffect(() => {
    const element = place.current!;
    const ink = getComputedStyle(element).color;
    /** A line where a record is. */
    const drawNow = (drawn: uPlot) => {
      if (!whole) return;
      const { ctx, bbox } = drawn;
      const x = Math.round(drawn.valToPos(session.board.now / 1e6, "x", true));
      ctx.fillStyle = ink;
      ctx.fillRect(x, bbox.top, Math.max(1, window.devicePixelRatio), bbox.height);
    };
    const grid = { stroke: isDark ? "#ffffff18" : "#00000014", width: 1 };
    const axis = { stroke: ink, grid, ticks: { show: false }, font: "11px system-ui" };
    const chart = new uPlot(
      {
        width: Math.max(160, element.clientWidth),
        height: kHeight,
        scales: { x: { time: false, ...(whole && { range: [whole.begin, whole.end] as [number, number] }) } },
        legend: { show: false },
        hooks: { draw: [drawNow] },
        cursor: { y: false, drag: { x: false, y: false } },
        axes: [
          { ...axis, size: 22, values: (_, ticks) => ticks.map(timeOf) },
          { ...axis, size: 46, values: (_, ticks) => ticks.map((t) => String(Number(t.toPrecision(4)))) },
        ],
        series: [{}, ...series.map(({ label }, i) => ({ label, stroke: kSafe[i % kSafe.length]!, width: 1.5, points: { show: false } }))],
      },
      joined(session.history.series, series),
      element,
    );
    let version = -1;
    let now = -1;
    const timer = setInterval(() => {
      if (version !== session.history.version) chart.setData(joined(session.history.series, series));
      else if (whole && now !== session.board.now) chart.redraw(false, false);
      version = session.history.version;
      now = session.board.now;
    }, kPeriod);
    const goThere = ({ offsetX }: MouseEvent) => {
      const { board } = session;
      if (!whole || !board.isOperator || !board.can("SEEK")) return;
      void session.act(`SEEK time_s=${plain(Math.max(0, chart.posToVal(offsetX, "x") - whole.begin))}`, "time");
    };
    chart.over.addEventListener("click", goThere);
    const watcher = new ResizeObserver(() => chart.setSize({ width: Math.max(160, element.clientWidth), height: kHeight }));
    watcher.observe(element);
    return () => {
      clearInterval(timer);
      watcher.disconnect();
      chart.destroy();
    };
  }, [series.map(({ key }) => key).join(), isDark, session, whole]);
  return (
    <figure class="chart">
      <figcaption>
        {series.map((one, i) => {
          const { key, label } = one;
          return (
          <span key={key}>
            <svg viewBox="0 0 10 10" class="swatch" aria-hidden="true">
              <rect y="3" width="10" height="4" fill={kSafe[i % kSafe.length]} />
            </svg>
            {label} <b>{(whole ? valueAt(one, session.board.now / 1e6) : one.values.at(-1))?.toFixed(2) ?? "–"}</b> {unit}
          </span>
          );
        })}
      </figcaption>
      <div ref={place} />
    </figure>
  );
}

/** Of a robot's own clock, which counts from 1970, the time of day. */
const timeOf = (time: number): string => (time < kLongAgo ? `${time} s` : seconds(time * 1e6));

/** One axis of time for all: where a series has no value it has a gap that is drawn over. */
function joined(known: Map<string, Series>, shown: Series[]): uPlot.AlignedData {
  // Series of a record are made anew when another run is selected.
  const series = shown.map((one) => known.get(one.key) ?? one);
  if (series.length === 1) return [series[0]!.times, series[0]!.values];
  return uPlot.join(series.map(({ times, values }) => [times, values]));
}
