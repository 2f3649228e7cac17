import { useState } from "preact/hooks";
import { numberOf } from "../link/words";
import { useBoard, usePage } from "../ui/context";
import type { Theme } from "../ui/Ui";
import { scoresOf } from "../model/soccer";
import { Icon } from "./Icon";
import { PageMenu } from "./PageMenu";
import { ErrorNote, Say, seconds } from "./parts";

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 0];
const kNext: Record<Theme, Theme> = { auto: "light", light: "dark", dark: "auto" };

export function TopBar() {
  const board = useBoard(100);
  const { ui } = usePage();
  const isLive = board.kind === "robot";
  const scores = board.isGame ? scoresOf(board.game) : [];
  return (
    <header class="top">
      <h1>
        <img src="./icon.svg" alt="" width="22" height="22" /> Ortung
      </h1>
      <span class="world" title="world">{board.worldName}</span>
      {!isLive && <TimeControls />}
      <span class="clock" role="timer" aria-label="time of the world">{seconds(board.now)}</span>
      {scores.length > 0 && (
        <span class="score" aria-label="score">
          {scores.map(({ team, score }, i) => (
            <span key={team} class={`team team-${i}`}>
              {team} <b>{score}</b>
            </span>
          ))}
        </span>
      )}
      <span class="spring" />
      <ErrorNote at="time" />
      <span class={`link ${board.link}`} title={board.linkText || "connection"}>
        <i class="dot" aria-hidden="true" />
        {board.link === "open" ? board.role : board.link}
      </span>
      <PageMenu />
      <button
        title={`colours: ${ui.theme}; next: ${kNext[ui.theme]}`}
        aria-label={`Colours: ${ui.theme}`}
        onClick={() => ui.change({ theme: kNext[ui.theme] })}
      >
        <Icon name={ui.theme} />
      </button>
      <button title="Keys (?)" aria-label="Help" onClick={() => ui.change({ isHelpOpen: true })}>?</button>
    </header>
  );
}

function TimeControls() {
  const { session } = usePage();
  const { board } = session;
  const [seed, setSeed] = useState("");
  const isPaused = board.state === "paused";
  const achieved = board.status.get("achieved");
  const speed = numberOf(board.status, "speed", 1);
  const speeds = kSpeeds.includes(speed) ? kSpeeds : [...kSpeeds, speed];
  const isRecord = board.kind === "record";
  return (
    <div class="time" role="group" aria-label="Time">
      {board.state === "ended" ? (
        <Say line="SEEK time_s=0" at="time" label="From the beginning" class="play" disabled={!board.can("SEEK")}>
          <Icon name="play" />
        </Say>
      ) : (
        <Say line={isPaused ? "RESUME" : "PAUSE"} at="time" label={isPaused ? "Go on" : "Pause"} class="play">
          <Icon name={isPaused ? "play" : "pause"} />
        </Say>
      )}
      <Say line="STEP" at="time" label="One cycle" disabled={!isPaused}><Icon name="step" /></Say>
      <label class="speed" title="SPEED FACTOR">
        <span class="sr">Speed</span>
        <select
          disabled={!board.isOperator}
          value={String(speed)}
          onChange={(event) => void session.act(`SPEED ${event.currentTarget.value}`, "time")}
        >
          {speeds.map((one) => (
            <option key={one} value={String(one)}>{one === 0 ? "free" : `${one}×`}</option>
          ))}
        </select>
      </label>
      {achieved !== undefined && (
        <span class="hint achieved" title="speed that is achieved">{Number(achieved).toFixed(2)}×</span>
      )}
      {!isRecord && !board.isGame && (
        <Say line="RESET" at="time">Reset</Say>
      )}
      {board.isGame && (
        <form
          class="reset"
          onSubmit={(event) => {
            event.preventDefault();
            void session.act(seed === "" ? "RESET" : `RESET seed=${seed}`, "time");
          }}
        >
          <input
            aria-label="Seed"
            title="seed of the next start; empty: as before"
            placeholder={board.status.has("seed") ? `seed ${board.status.get("seed")}` : "seed"}
            value={seed}
            inputMode="numeric"
            pattern="[0-9]*"
            disabled={!board.isOperator}
            onInput={(event) => setSeed(event.currentTarget.value)}
          />
          <button type="submit" disabled={!board.isOperator} title="RESET: time, random numbers, robots and score start over">
            Reset
          </button>
        </form>
      )}
      <span class="state">{board.state}</span>
    </div>
  );
}
