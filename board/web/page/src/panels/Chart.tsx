import { useEffect, useRef, useState } from "preact/hooks";
import uPlot from "uplot";
import { kSafe } from "../field/palette";
import type { CurveRef } from "../layout/curves";
import { valueAt, type Series } from "../model/History";
import { useBoard, usePage } from "../ui/context";
import { Seeker } from "../ui/Seeker";
import { Icon } from "./Icon";
import { kLongAgo, seconds } from "./parts";

const kPeriod = 100;
const kHeight = 110;
const kLeast = { width: 160, height: 70 };

/** How a chart stands where it is. */
export interface ChartLook {
  /** Whether it is as high as its place is, with its axes named; otherwise it is low. */
  fills: boolean;
  /** Takes one of its curves to a panel of its own; missing: it can't be. */
  onOut?: (curve: CurveRef) => void;
}

const nameOf = (series: Series[]) => series.map(({ label }) => label).join(", ");

/** Numbers of one unit over time. In a record a click or a drag goes to that time. */
export function Chart({ series, unit, fills, onOut }: { series: Series[]; unit: string } & ChartLook) {
  const { session, ui } = usePage();
  useBoard(250);
  const { whole } = session.history;
  const place = useRef<HTMLDivElement>(null);
  const [pointed, setPointed] = useState<number | null>(null);
  const { isDark } = ui;
  useEffect(() => {
    const element = place.current!;
    const size = () => ({
      width: Math.max(kLeast.width, element.clientWidth),
      height: fills ? Math.max(kLeast.height, element.clientHeight) : kHeight,
    });
    const seeker = new Seeker(session);
    const chart = new uPlot(
      optionsOf({ series, unit, fills, size: size(), ink: getComputedStyle(element).color, isDark, whole, now: () => session.board.now, onPoint: setPointed }),
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
    const goThere = (event: PointerEvent) => {
      if (!whole || !(event.buttons & 1) || !seeker.canSeek) return;
      if (event.type === "pointerdown") chart.over.setPointerCapture(event.pointerId);
      const x = event.clientX - chart.over.getBoundingClientRect().left;
      void seeker.goTo(Math.min(whole.end, chart.posToVal(x, "x")) - whole.begin);
    };
    chart.over.addEventListener("pointerdown", goThere);
    chart.over.addEventListener("pointermove", goThere);
    const watcher = new ResizeObserver(() => chart.setSize(size()));
    watcher.observe(element);
    return () => {
      clearInterval(timer);
      watcher.disconnect();
      chart.destroy();
    };
  }, [series.map(({ key }) => key).join(), unit, fills, isDark, session, whole]);
  return (
    <figure class={fills ? "chart fills" : "chart"} aria-label={`Chart of ${nameOf(series)}`}>
      <Caption series={series} unit={unit} digits={fills ? 3 : 2} pointed={pointed} onOut={onOut} />
      <div ref={place} class={whole ? "plot seekable" : "plot"} />
    </figure>
  );
}

/** What each curve is called, with its value now, or where the pointer is. */
function Caption({ series, unit, digits, pointed, onOut }: {
  series: Series[]; unit: string; digits: number; pointed: number | null; onOut: ChartLook["onOut"];
}) {
  const { session, ui } = usePage();
  const { whole } = session.history;
  const valueOf = (one: Series) => {
    const known = session.history.series.get(one.key) ?? one;
    const time = pointed ?? (whole ? session.board.now / 1e6 : null);
    return (time === null ? known.values.at(-1) : valueAt(known, time))?.toFixed(digits) ?? "–";
  };
  return (
    <figcaption>
      {series.map((one, i) => (
        <span
          key={one.key}
          class={onOut && "handle"}
          title={onOut && "drag: a panel of its own"}
          onPointerDown={(event) => onOut && ui.drag.begin(event, { curve: { key: one.key, unit: one.unit } }, one.label)}
        >
          <svg viewBox="0 0 10 10" class="swatch" aria-hidden="true">
            <rect y="3" width="10" height="4" fill={kSafe[i % kSafe.length]} />
          </svg>
          {one.label} <b>{valueOf(one)}</b> {unit}
          {onOut && (
            <button
              class="quiet small"
              aria-label={`Take out ${one.label}`}
              title="a panel of its own"
              onPointerDown={(event) => event.stopPropagation()}
              onClick={() => onOut({ key: one.key, unit: one.unit })}
            >
              <Icon name="out" />
            </button>
          )}
        </span>
      ))}
      {pointed !== null && <span>at {seconds(pointed * 1e6)}</span>}
    </figcaption>
  );
}

interface Drawn {
  series: Series[];
  unit: string;
  fills: boolean;
  size: { width: number; height: number };
  ink: string;
  isDark: boolean;
  whole: { begin: number; end: number } | null;
  now(): number;
  onPoint(time: number | null): void;
}

function optionsOf({ series, unit, fills, size, ink, isDark, whole, now, onPoint }: Drawn): uPlot.Options {
  /** A line where a record is. */
  const drawNow = (drawn: uPlot) => {
    if (!whole) return;
    const { ctx, bbox } = drawn;
    const x = Math.round(drawn.valToPos(now() / 1e6, "x", true));
    ctx.fillStyle = ink;
    ctx.fillRect(x, bbox.top, Math.max(1, window.devicePixelRatio) * (fills ? 2 : 1), bbox.height);
  };
  const point = (chart: uPlot) => {
    const { left = -1 } = chart.cursor;
    onPoint(left >= 0 ? chart.posToVal(left, "x") : null);
  };
  const grid = { stroke: isDark ? "#ffffff18" : "#00000014", width: 1 };
  const font = `${fills ? 12 : 11}px system-ui`;
  const axis = { stroke: ink, grid, ticks: { show: fills, stroke: ink, width: 1, size: 4 }, font, labelFont: font, labelSize: 18 };
  const named = (label: string) => (fills && label ? { label } : {});
  return {
    ...size,
    scales: { x: { time: false, ...(whole && { range: [whole.begin, whole.end] as [number, number] }) } },
    legend: { show: false },
    hooks: { draw: [drawNow], setCursor: [point] },
    cursor: { y: false, drag: { x: false, y: false } },
    axes: [
      { ...axis, size: fills ? 26 : 22, values: (_, ticks) => ticks.map(timeOf), ...named("time") },
      { ...axis, size: fills ? 52 : 46, values: (_, ticks) => ticks.map((t) => String(Number(t.toPrecision(4)))), ...named(unit && `[${unit}]`) },
    ],
    series: [{}, ...series.map(({ label }, i) => ({ label, stroke: kSafe[i % kSafe.length]!, width: fills ? 2 : 1.5, points: { show: false } }))],
  };
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
