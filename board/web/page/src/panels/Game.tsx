import { useState } from "preact/hooks";
import { useBoard, usePage } from "../ui/context";
import type { PlayerKind } from "../model/Board";
import { plain } from "../link/words";
import { scoresOf } from "../model/soccer";
import { Contents } from "./Contents";
import { ErrorNote, Say, Section, seconds } from "./parts";

const kOrders = ["start", "stop", "half-time", "end", "reset", "dropped-ball"];
const kTeamOrders = ["kick-off", "throw-in", "goal-kick", "corner", "free-kick", "penalty", "goal", "no-goal", "yellow-card", "red-card"];

export function GamePanel() {
  const board = useBoard(200);
  const hasReferee = board.game.has("phase");
  return (
    <>
      {board.kind === "record" && <Contents />}
      {board.isGame && (
        <Section title="Score">
          <Score />
        </Section>
      )}
      {!board.isGame && board.kind === "simulation" && (
        <Section title="Chance">
          <Seed />
        </Section>
      )}
      {hasReferee && board.isGame && board.can("REFEREE") && (
        <Section title="Referee">
          <Orders />
        </Section>
      )}
      {board.can("PLAY") && (
        <Section title="Players">
          <Playing />
          <StartPlayer />
        </Section>
      )}
      {board.can("EVENTS") && (
        <Section title="Events">
          <Events />
        </Section>
      )}
    </>
  );
}

function Score() {
  const { session } = usePage();
  const { game } = session.board;
  const scores = scoresOf(game);
  const clock = Number(game.get("clock_s") ?? NaN);
  const sides = !game.has("phase") && scores.length === 2;
  return (
    <>
      <p class="big-score">
        {scores.map(({ team, score }, i) => (
          <span key={team}>
            {i > 0 && " : "}
            <small>{team}</small> <b>{score}</b>
          </span>
        ))}
        {!scores.length && <span class="hint">There is no score.</span>}
      </p>
      {game.has("phase") && (
        <p class="hint">
          {game.get("phase")}
          {game.get("restart") && game.get("restart") !== "none" && `, ${game.get("restart")} ${game.get("restart_of") ?? ""}`}, half{" "}
          {game.get("half")}
          {Number.isFinite(clock) && `, ${seconds(clock * 1e6)}`}
        </p>
      )}
      {sides && (
        <div class="row">
          <Say line={`SCORE left=${Number(scores[0]!.score) + 1} right=${scores[1]!.score}`} at="score">Left +1</Say>
          <Say line={`SCORE left=${scores[0]!.score} right=${Number(scores[1]!.score) + 1}`} at="score">Right +1</Say>
          <Say line="SCORE left=0 right=0" at="score">0 : 0</Say>
        </div>
      )}
      <ErrorNote at="score" />
    </>
  );
}

/** Where there is no game, starting over with another seed is seldom wanted: it has its place here. */
function Seed() {
  const { session } = usePage();
  const { board } = session;
  const [seed, setSeed] = useState("");
  return (
    <form
      class="row"
      onSubmit={(event) => {
        event.preventDefault();
        void session.act(seed === "" ? "RESET" : `RESET seed=${seed}`, "time");
      }}
    >
      <label>
        <span class="key">seed</span>
        <input
          class="short" placeholder={board.status.get("seed") ?? ""} value={seed} inputMode="numeric" pattern="[0-9]*"
          disabled={!board.isOperator} onInput={(event) => setSeed(event.currentTarget.value)}
        />
      </label>
      <button type="submit" disabled={!board.isOperator} title="RESET: time, random numbers and robots start over">
        Start over
      </button>
    </form>
  );
}

function Orders() {
  const { board } = usePage().session;
  const teams = scoresOf(board.game).map(({ team }) => team);
  return (
    <>
      <div class="row wrap" role="group" aria-label="Orders">
        {kOrders.map((order) => (
          <Say key={order} line={`REFEREE ${order}`} at="referee">{order}</Say>
        ))}
      </div>
      {teams.map((team) => (
        <div class="row wrap" role="group" aria-label={`Orders for ${team}`} key={team}>
          <span class="key">{team}</span>
          {kTeamOrders.map((order) => (
            <Say key={order} line={`REFEREE ${order} ${team}`} at="referee" class="small">{order}</Say>
          ))}
        </div>
      ))}
      <ErrorNote at="referee" />
    </>
  );
}

function Playing() {
  const { board } = usePage().session;
  if (!board.playing.length) return <p class="hint">No player is on the field.</p>;
  return (
    <ul class="playing">
      {board.playing.map(({ robot, player, team }) => (
        <li key={robot}>
          <span class="who">{robot}</span> <span class="what">{player}</span> <span class="what">{team}</span>
          <Say line={`STOP ${robot}`} at="players" class="small" label={`Stop ${robot}`}>Stop</Say>
        </li>
      ))}
    </ul>
  );
}

/** A form made of what DESCRIBE players says. */
function StartPlayer() {
  const { session } = usePage();
  const { board } = session;
  const [name, setName] = useState("");
  const [values, setValues] = useState<Record<string, string>>({});
  const kind = board.playerKinds.find((one) => one.name === name) ?? board.playerKinds[0];
  if (!kind) return <p class="hint">This server has no players.</p>;
  const set = (key: string, value: string) => setValues({ ...values, [key]: value });
  const general = [
    { key: "team", unit: "name", text: "team that it plays for" },
    { key: "name", unit: "name", text: "name of its robot" },
    { key: "robot", unit: "name", text: "kind of robot: a file that ships with the program" },
    { key: "start", unit: "x,y,deg", text: "pose at the start" },
  ];
  const line = playLine(kind, general.map(({ key }) => key), values);
  return (
    <form
      class="start-player"
      aria-label="Start a player"
      onSubmit={(event) => {
        event.preventDefault();
        void session.act(line, "players");
      }}
    >
      <label>
        <span class="key">player</span>
        <select value={kind.name} onChange={(event) => { setName(event.currentTarget.value); setValues({}); }}>
          {board.playerKinds.map((one) => <option key={one.name} value={one.name}>{one.name}</option>)}
        </select>
      </label>
      <p class="hint">{kind.text}</p>
      <div class="grid">
        {general.map((option) => <Option key={option.key} name={option.key} unit={option.unit} text={option.text} value={values[option.key] ?? ""} set={set} />)}
      </div>
      {kind.options.length > 0 && (
        <details>
          <summary>{kind.options.length} options</summary>
          <div class="grid">
            {kind.options.map((option) => (
              <Option key={option.key} name={option.key} unit={option.unit} text={option.text} value={values[option.key] ?? ""} set={set} />
            ))}
          </div>
        </details>
      )}
      <datalist id="robot-kinds">
        {board.robotKinds.map((one) => <option key={one} value={one} />)}
      </datalist>
      <div class="row">
        <button type="submit" disabled={!board.isOperator} class="primary">Start</button>
        <code>{line}</code>
      </div>
      <ErrorNote at="players" />
    </form>
  );
}

export function playLine(kind: PlayerKind, general: string[], values: Record<string, string>): string {
  const keys = [...general, ...kind.options.map(({ key }) => key)];
  // The protocol has no quotes: a blank would begin another word.
  const given = keys.filter((key) => values[key]?.trim()).map((key) => `${key}=${values[key]!.replace(/\s+/g, "")}`);
  return ["PLAY", kind.name, ...given].join(" ");
}

function Option({ name, unit, text, value, set }: {
  name: string; unit: string; text: string; value: string; set(key: string, value: string): void;
}) {
  const choices = unit.includes("|") ? unit.split("|") : null;
  const example = name === "robot" ? "pioneer" : "";
  const otherwise = /default: (.*)$/.exec(text)?.[1] ?? "";
  return (
    <label title={text}>
      <span class="key">
        {name}
        {!choices && unit && <small> {unit}</small>}
      </span>
      {choices ? (
        <select value={value} onChange={(event) => set(name, event.currentTarget.value)}>
          <option value="">{otherwise ? `default (${otherwise})` : "default"}</option>
          {choices.map((one) => <option key={one} value={one}>{one}</option>)}
        </select>
      ) : (
        <input value={value} list={name === "robot" ? "robot-kinds" : undefined} placeholder={otherwise || example} onInput={(event) => set(name, event.currentTarget.value)} />
      )}
    </label>
  );
}

/** More events are a list that nobody reads. */
const kShown = 60;

function Events() {
  const { board } = usePage().session;
  const { happenings } = board;
  const begin = board.world?.start ?? 0;
  if (!happenings.length) return <p class="hint">Nothing yet.</p>;
  return (
    <>
      {happenings.length > kShown && <p class="hint">the latest {kShown} of {happenings.length}</p>}
      <ol class="events" reversed>
        {happenings.slice(-kShown).reverse().map(({ number, stamp, what, text }) => (
          <li key={number}>
            {board.can("SEEK") ? (
              <Say line={`SEEK time_s=${plain(Math.max(0, stamp - begin) / 1e6)}`} at="time">{seconds(stamp)}</Say>
            ) : (
              <time>{seconds(stamp)}</time>
            )}{" "}
            <b>{what}</b> {text}
          </li>
        ))}
      </ol>
    </>
  );
}
