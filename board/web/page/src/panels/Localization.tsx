import { useEffect, useRef, useState } from "preact/hooks";
import { putBack } from "../layout/moves";
import { useBoard, usePage } from "../ui/context";
import { kOpaque, paintHeat } from "../field/HeatLayer";
import type { Board } from "../model/Board";
import { fixOf, placesOf } from "../model/decode";
import { boundText, summary } from "../model/values";
import { degrees, radians, wrap } from "../model/geometry";
import type { FeatureMap, Why } from "../model/Insight";
import { kEstimate } from "../model/features";
import type { Robot } from "../model/Robot";
import { Curves } from "./Curves";
import { Icon } from "./Icon";
import { ageOf, ErrorNote, probability, Say, Section, seconds, shortName } from "./parts";
import { inWords } from "../model/why";
import { plain } from "../link/words";

export function LocalizationPanel() {
  const board = useBoard(100);
  const { robot } = board;
  if (!robot) return <p class="hint">No robot is selected.</p>;
  const isLocalized = robot.estimate !== null;
  return (
    <>
      <FilterSection robot={robot} />
      {isLocalized && <BeliefSection robot={robot} />}
      {(isLocalized || board.kind === "record") && <Curves only={["error", "apart"]} />}
      {board.can("HEATMAP") && <MapSection />}
      {board.kind === "record" && !board.can("HEATMAP") && (
        <Section title="Map of p(s given l)">
          <p class="hint">
            There are no tables to weigh readings by: --tables hall.ortung, or --robot robot.toml and --world hall.toml to learn
            them at once.
          </p>
        </Section>
      )}
    </>
  );
}

function FilterSection({ robot }: { robot: Robot }) {
  const { session, insight } = usePage();
  const { board } = session;
  const { status } = robot;
  const { localize } = insight;
  const isOn = localize !== null && /^(learning|searching|running)$/.test(localize.state);
  return (
    <Section title={`Estimated pose of ${robot.label}`}>
      {status ? (
        <p class={`verdict ${status.status}`} role="status">
          <strong>{status.status}</strong>: {status.reason}
          <span class="meter">
            <meter min={0} max={1} value={status.quality} aria-label="Probability that the error is below 0.5 m" />
            {(status.quality * 100).toFixed(0)} % probability of an error below 0.5 m
          </span>
        </p>
      ) : (
        <p class="hint">{whyNot(board)}</p>
      )}
      {board.can("LOCALIZE") && (
        <div class="row" role="group" aria-label="Filter">
          <Say line={`LOCALIZE robot=${robot.number} ${isOn ? "off" : "on"}`} at="localization" pressed={isOn}>
            {isOn ? "Localize: on" : "Localize: off"}
          </Say>
          <Say line={`LOCALIZE robot=${robot.number} anywhere`} at="localization" disabled={!isOn}>Anywhere</Say>
          {localize && localize.state !== "none" && <span class="state">{localize.state}</span>}
        </div>
      )}
      {localize?.state === "learning" && (
        <p class="row">
          <progress max={1} value={localize.progress} aria-label="Learning tables" />
          <span>{(localize.progress * 100).toFixed(0)} % learned</span>
          <Say line={`LOCALIZE robot=${robot.number} off`} at="localization">Cancel</Say>
        </p>
      )}
      {localize && (localize.state === "failed" || localize.state === "none") && localize.text && (
        <p class="hint">{localize.text}</p>
      )}
      {isOn && <p class="hint">Shift and drag on the field to give the filter the robot's approximate pose.</p>}
      <ErrorNote at="localization" />
    </Section>
  );
}

/** Why there is no estimate, and what to do. */
function whyNot(board: Board): string {
  if (board.can("LOCALIZE")) return "It is not localized.";
  if (board.kind !== "record") return "This server does not localize robots: start it with --localize.";
  return "The record has no estimates. With --tables hall.ortung it is localized when it is opened.";
}

const kAboutBound = "The error exceeds it once in a thousand while tracking, once in a hundred while uncertain.";

const kAboutChanges = "Where readings find something else than the map says; cells are sure after two passes.";

function BeliefSection({ robot }: { robot: Robot }) {
  const pose = robot.readings.get(kEstimate);
  const fix = pose && fixOf(pose.words);
  const truth = pose && robot.truthAt(pose.stamp);
  const { status, protection: bound } = robot;
  const work = robot.heldOf("work")?.words;
  const changes = robot.heldOf("changes");
  const places = robot.heldOf("clusters");
  const { session, ui } = usePage();
  const workName = robot.featureOf("work")?.name ?? "";
  const isFollowed = session.history.has(workName, "effective samples");
  return (
    <Section title="Belief">
      <dl class="facts">
        {fix && (
          <>
            <dt>estimate</dt>
            <dd>
              {fix.x.toFixed(2)}, {fix.y.toFixed(2)} m, {degrees(fix.theta).toFixed(1)}°
            </dd>
            <dt>sigmas</dt>
            <dd>
              {fix.sigmaX.toFixed(3)}, {fix.sigmaY.toFixed(3)} m, {degrees(fix.sigmaTheta).toFixed(1)}°
            </dd>
          </>
        )}
        {bound && (
          <>
            <dt>bound</dt>
            <dd title={kAboutBound}>{boundText(bound)}</dd>
          </>
        )}
        {changes && changes.words.length > 1 && (
          <>
            <dt>changes</dt>
            <dd title={kAboutChanges}>{summary({ name: "changes" }, changes.words)}</dd>
          </>
        )}
        {!!status?.relocalizations && (
          <>
            <dt>relocalized</dt>
            <dd>
              {status.relocalizations}×, last: {status.cause}
            </dd>
          </>
        )}
        {fix && truth && (
          <>
            <dt>error</dt>
            <dd>
              {Math.hypot(fix.x - truth.x, fix.y - truth.y).toFixed(3)} m,{" "}
              {Math.abs(degrees(wrap(fix.theta - truth.theta))).toFixed(1)}°
            </dd>
          </>
        )}
        {work && work.length >= 4 && (
          <>
            <dt>samples</dt>
            <dd>
              {work[0]}, {work[1]} effective{" "}
              <button
                class="small"
                aria-pressed={isFollowed}
                aria-label="Curve of effective samples"
                title="show over time (Sensors)"
                onClick={() => {
                  session.history.toggle(workName, "effective samples", "");
                  ui.change({ layout: putBack(ui.layout, `${workName} effective samples`) });
                }}
              >
                      <Icon name="curve" />
              </button>
            </dd>
            <dt>an update takes</dt>
            <dd>{(work[2]! / 1000).toFixed(2)} ms</dd>
          </>
        )}
      </dl>
      {places && (
        <ol class="places">
          {placesOf(places.words).slice(0, 8).map((place, i) => (
            <li key={i}>
              <span class="share">{(place.share * 100).toFixed(0)} %</span>
              {place.x.toFixed(2)}, {place.y.toFixed(2)}, {degrees(place.theta).toFixed(0)}°
              <span class="hint"> ± {Math.hypot(place.sigmaX, place.sigmaY).toFixed(2)} m</span>
            </li>
          ))}
        </ol>
      )}
    </Section>
  );
}

function MapSection() {
  const { insight, ui, session } = usePage();
  const { wish } = insight;
  const [headings, setHeadings] = useState<"best" | "robot" | "given">("best");
  const [given, setGiven] = useState(0);
  const robot = session.board.robot;
  if (headings === "robot") wish.theta = robot?.truth?.theta ?? robot?.estimate?.theta ?? 0;
  else wish.theta = headings === "best" ? null : radians(given);
  const redraw = () => ui.change({});
  const show = (isShown: boolean) => {
    insight.wantsMap = isShown;
    if (!isShown) {
      insight.map = null;
      insight.why = null;
      ui.change({ heat: null, asked: null });
    } else {
      redraw();
    }
  };
  return (
    <Section title="Map of p(s given l)">
      <div class="row">
        <label>
          <input type="checkbox" checked={insight.wantsMap} onChange={(event) => show(event.currentTarget.checked)} />
          on the field
        </label>
        <label>
          <input
            type="checkbox"
            checked={wish.each}
            disabled={!insight.wantsMap}
            onChange={(event) => { wish.each = event.currentTarget.checked; redraw(); }}
          />
          each feature
        </label>
        {insight.map && <span class="hint">{ageOf(insight.map.stamp, session.board)}</span>}
      </div>
      {robot && robot.mapMoments.length > 0 && <Moments stamps={robot.mapMoments} />}
      {insight.wantsMap && (
        <>
          <div class="row wrap">
            <label>
              <span class="key">heading</span>
              <select value={headings} onChange={(event) => setHeadings(event.currentTarget.value as typeof headings)}>
                <option value="best">the most probable</option>
                <option value="robot">the robot's</option>
                <option value="given">given</option>
              </select>
            </label>
            {headings === "given" && (
              <label class="grow">
                <span class="key">{given}°</span>
                <input
                  type="range" min="-180" max="180" step="5" value={given} aria-label="Heading"
                  onInput={(event) => setGiven(Number(event.currentTarget.value))}
                />
              </label>
            )}
            <label>
              <span class="key">of</span>
              <select
                value={wish.of}
                onChange={(event) => { wish.of = event.currentTarget.value as typeof wish.of; redraw(); }}
              >
                <option value="probability">probability</option>
                <option value="expectation">expectation</option>
              </select>
            </label>
            {wish.of === "probability" && (
              <label>
                <span class="key">scale</span>
                <select
                  value={wish.scale}
                  onChange={(event) => { wish.scale = event.currentTarget.value as typeof wish.scale; redraw(); }}
                >
                  <option value="log">logarithmic</option>
                  <option value="linear">linear</option>
                </select>
              </label>
            )}
            {wish.of === "expectation" && (
              <label>
                <span class="key">value</span>
                <input
                  type="number" min="0" max="8191" value={wish.index} class="short"
                  onInput={(event) => { wish.index = Math.max(0, Math.floor(Number(event.currentTarget.value) || 0)); }}
                />
              </label>
            )}
          </div>
          <Choice />
          {insight.error && <p class="error" role="alert">{insight.error}</p>}
          {insight.map && <Legend map={insight.map} />}
          <div class="maps">
            {insight.small.map((map) => <SmallMap key={map.feature} map={map} />)}
          </div>
          <p class="hint">Click on the field to see each feature's probability at a place.</p>
          <ErrorNote at="why" />
          {insight.why && <WhyList why={insight.why} />}
        </>
      )}
    </Section>
  );
}

/** A page without a server has maps of some moments; the one next to the time that is shown is drawn. */
function Moments({ stamps }: { stamps: number[] }) {
  return (
    <div class="moments" role="group" aria-label="Moments with maps">
      <span class="hint">{stamps.length} moments of this page have maps:</span>
      {stamps.map((stamp) => (
        <Say key={stamp} line={`SEEK time_s=${plain(stamp / 1e6)}`} at="time" class="small">{seconds(stamp)}</Say>
      ))}
    </div>
  );
}

/** Which features the map is of. */
function Choice() {
  const { insight, ui } = usePage();
  const { wish, features } = insight;
  const choose = (without: Iterable<string>) => {
    wish.without = new Set(without);
    ui.change({});
  };
  return (
    <details class="choice">
      <summary>
        {features.length - wish.without.size} of {features.length} features
      </summary>
      <div class="row">
        <button onClick={() => choose([])}>All</button>
        <button onClick={() => choose(features)}>None</button>
      </div>
      <div class="chosen">
        {features.map((feature) => (
          <label key={feature} title={feature}>
            <input
              type="checkbox"
              checked={!wish.without.has(feature)}
              onChange={(event) => {
                const without = new Set(wish.without);
                if (event.currentTarget.checked) without.delete(feature);
                else without.add(feature);
                choose(without);
              }}
            />
            {shortName(feature)}
          </label>
        ))}
      </div>
    </details>
  );
}

function Legend({ map }: { map: FeatureMap }) {
  const { insight } = usePage();
  const unit = insight.wish.of === "expectation" ? "expected" : "p";
  const top = brightest(map.heat);
  return (
    <>
      <div class="legend">
        <span>{probability(map.low)}</span>
        <span class="ramp" role="img" aria-label={`colours from ${probability(map.low)} to ${probability(map.high)}`} />
        <span>{probability(map.high)}</span>
        <span class="hint">{unit}</span>
      </div>
      {insight.wish.of === "probability" && top && (
        <p class="hint">brightest at {top.x.toFixed(2)}, {top.y.toFixed(2)}</p>
      )}
    </>
  );
}

/** The middle of the cells that are as bright as any. */
function brightest({ cells, columns, x, y, step }: FeatureMap["heat"]): { x: number; y: number } | null {
  let [most, count, sumX, sumY] = [0, 0, 0, 0];
  for (let i = 0; i < cells.length; ++i) {
    if (cells[i]! < most || cells[i] === 0) continue;
    if (cells[i]! > most) [most, count, sumX, sumY] = [cells[i]!, 0, 0, 0];
    count += 1;
    sumX += x + ((i % columns) + 0.5) * step;
    sumY += y + (Math.floor(i / columns) + 0.5) * step;
  }
  return count ? { x: sumX / count, y: sumY / count } : null;
}

function SmallMap({ map }: { map: FeatureMap }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    paintHeat(canvas.current!, map.heat, kOpaque);
  }, [map]);
  return (
    <figure>
      <canvas ref={canvas} role="img" aria-label={`map of ${map.feature}`} />
      <figcaption title={map.feature}>{shortName(map.feature)}</figcaption>
    </figure>
  );
}

function WhyList({ why }: { why: Why }) {
  const [open, setOpen] = useState("");
  const { insight } = usePage();
  const { x, y, theta } = why.pose;
  const head = useRef<HTMLHeadingElement>(null);
  // Whoever has asked on the field sees the answer.
  useEffect(() => head.current?.scrollIntoView({ block: "start" }), [why]);
  const best = insight.wish.of === "probability" ? (insight.map?.high ?? null) : null;
  return (
    <>
      <h3 ref={head}>
        Why {x.toFixed(2)}, {y.toFixed(2)}, {degrees(theta).toFixed(0)}°: p = {probability(why.p)}
      </h3>
      <p class="in-words">{inWords(why.p, best)}</p>
      <ul class="why">
        {why.features.map(({ feature, p, values }) => (
          <li key={feature}>
            <button aria-expanded={open === feature} onClick={() => setOpen(open === feature ? "" : feature)}>
              <span class="who">{shortName(feature)}</span>
              <meter min={0} max={1} value={Math.max(0, p)} aria-label={`probability of ${feature}`} />
              <span class="share" title={p < 0 ? "no reading, or nothing is expected here" : ""}>{p < 0 ? "–" : probability(p)}</span>
            </button>
            {open === feature && (
              <table class="values">
                <thead>
                  <tr>
                    <th scope="col">value</th>
                    <th scope="col">measured</th>
                    <th scope="col">expected</th>
                  </tr>
                </thead>
                <tbody>
                  {values.slice(0, 400).map(({ index, unit, measured, expected }) => (
                    <tr key={index}>
                      <th scope="row">{index}</th>
                      <td>{amount(measured, unit)}</td>
                      <td>{amount(expected, unit)}</td>
                    </tr>
                  ))}
                </tbody>
              </table>
            )}
          </li>
        ))}
      </ul>
    </>
  );
}

function amount(value: number | null, unit: string): string {
  if (value === null || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return "nothing";
  return unit === "rad" ? `${degrees(value).toFixed(1)}°` : `${value.toFixed(2)} ${unit}`;
}
