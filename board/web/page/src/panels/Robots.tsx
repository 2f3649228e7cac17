import { useBoard, usePage } from "../ui/context";
import { robotColour } from "../field/palette";
import { degrees } from "../model/geometry";
import { DriveControls } from "./Drive";
import type { Robot } from "../model/Robot";
import { ErrorNote, Say, Section } from "./parts";

export function RobotsPanel() {
  const board = useBoard(200);
  const { session } = usePage();
  const robots = [...board.robots.values()].sort((a, b) => a.number - b.number);
  return (
    <>
      <Section title="On the field">
        {!robots.length && <p class="hint">{board.link === "open" ? "No robot is there." : "Not connected."}</p>}
        <ul class="robots">
          {robots.map((robot) => {
            const { pose, status } = robot;
            return (
              <li key={robot.number}>
                <button aria-pressed={board.selected === robot.number} onClick={() => session.select(robot.number)}>
                  <Swatch colour={robotColour(robot, board.kind === "record")} />
                  <span class="who">{robot.label}</span>
                  <span class="what">{robot.player || (robot.client ? `client ${robot.client}` : "")}</span>
                  {isRecorded(robot) && <span class="badge recorded" title={robot.record}>rec</span>}
                  {status && <span class={`badge ${status.status}`}>{status.status}</span>}
                  <span class="where">
                    {pose ? `${pose.x.toFixed(2)}, ${pose.y.toFixed(2)}, ${degrees(pose.theta).toFixed(0)}°` : "no pose yet"}
                  </span>
                </button>
              </li>
            );
          })}
        </ul>
      </Section>
      {board.can("RECORD") && robots.length > 0 && (
        <Section title="Records">
          <Recording robots={robots} />
        </Section>
      )}
      {board.robot && <Selected />}
    </>
  );
}

const isRecorded = (robot: Robot) => robot.record !== "" && robot.record !== "failed";

/** Begins and ends records on the server: of the selected robot, and of all. */
function Recording({ robots }: { robots: Robot[] }) {
  const { board } = usePage().session;
  const { robot } = board;
  const recorded = robots.filter(isRecorded);
  const button = (who: string, isOn: boolean, label: string) => (
    <Say line={`RECORD robot=${who} ${isOn ? "off" : "on"}`} at="record" pressed={isOn} label={`Record ${label}`}>
      <i class="dot" aria-hidden="true" /> {label}
    </Say>
  );
  return (
    <>
      <div class="row wrap recording" role="group" aria-label="Records">
        {robot && button(String(robot.number), isRecorded(robot), robot.label)}
        {robots.length > 1 && button("all", recorded.length === robots.length, "all robots")}
      </div>
      {recorded.length > 0 && <p class="hint">{recorded.map(({ record }) => record).join(", ")}</p>}
      {robots.map(({ number, label, recordProblem }) => recordProblem && (
        <p class="error" role="alert" key={number}>{label}: {recordProblem}</p>
      ))}
      <ErrorNote at="record" />
    </>
  );
}

function Swatch({ colour }: { colour: string }) {
  return (
    <svg class="swatch" viewBox="0 0 10 10" aria-hidden="true">
      <circle cx="5" cy="5" r="4.5" fill={colour} />
    </svg>
  );
}

function Selected() {
  const { board } = usePage().session;
  const robot = board.robot!;
  return (
    <Section title={robot.label}>
      <dl class="facts">
        <dt>features</dt>
        <dd>{robot.features.length}</dd>
        <dt>at most</dt>
        <dd>
          {robot.speed.toFixed(1)} m/s, {degrees(robot.turn).toFixed(0)}°/s
        </dd>
      </dl>
      {board.kind !== "record" && <DriveControls robot={robot} />}
      {robot.manipulators.map(({ name, states }) => (
        <div class="row" role="group" aria-label={name} key={name}>
          <span class="key">{name}</span>
          {states.map((state) => (
            <Say key={state} line={`MANIPULATOR ${name} ${state} robot=${robot.number}`} at="drive">{state}</Say>
          ))}
        </div>
      ))}
      <ErrorNote at="drive" />
    </Section>
  );
}
