import { useEffect, useRef, useState } from "preact/hooks";
import { usePage } from "../ui/context";
import { plain } from "../link/words";
import type { Robot } from "../model/Robot";
import { Say } from "./parts";

const kPeriod = 100;
const kDead = 0.12;

/** Drives the selected robot by keys, buttons or a gamepad: VELOCITY, while something is held. */
export function DriveControls({ robot }: { robot: Robot }) {
  const { session, ui } = usePage();
  const { board } = session;
  const [share, setShare] = useState(0.5);
  const shareNow = useRef(share);
  shareNow.current = share;
  const [pad, setPad] = useState("");
  const isOn = ui.drivesByKeys && board.isOperator;
  useEffect(() => {
    if (!isOn) return;
    const sender = new Sender(session, robot);
    const timer = setInterval(() => {
      let { v, w } = ui.drivingKeys.way();
      const stick = gamepad();
      setPad(stick?.id ?? "");
      if (stick) [v, w] = [v + stick.v, w + stick.w];
      sender.want(clamp(v) * shareNow.current * robot.speed, clamp(w) * shareNow.current * robot.turn);
    }, kPeriod);
    return () => {
      clearInterval(timer);
      void sender.end();
    };
  }, [isOn, session, ui, robot]);
  return (
    <div class="drive">
      <div class="row">
        <button
          aria-pressed={isOn}
          disabled={!board.isOperator}
          title="VELOCITY while keys are held (d)"
          onClick={() => ui.change({ drivesByKeys: !ui.drivesByKeys })}
        >
          Drive with keys or gamepad
        </button>
        <label class="grow">
          <span class="key">{Math.round(share * 100)} %</span>
          <input
            type="range"
            min="0.1"
            max="1"
            step="0.1"
            value={share}
            aria-label="Share of its greatest speed"
            onInput={(event) => setShare(Number(event.currentTarget.value))}
          />
        </label>
      </div>
      {isOn && (
        <p class="hint">
          <kbd>W</kbd> <kbd>A</kbd> <kbd>S</kbd> <kbd>D</kbd> or arrow keys drive {robot.label}
          {pad && `; gamepad: ${pad.slice(0, 40)}`}. <kbd>Esc</kbd> ends it.
        </p>
      )}
      {isOn && !robot.takenFrom && robot.player && (
        <p class="hint">
          Its player {robot.player} drives it now. One that wanders ends when you drive, and gets the robot back when you end; others
          go on commanding it.
        </p>
      )}
      {robot.takenFrom && (
        <p class="row taken" role="status">
          <span>{robot.label} was taken from its player {robot.takenFrom}.</span>
          {board.can("RETURN") && (
            <Say line={`RETURN robot=${robot.number}`} at="drive" class="small">Give it back</Say>
          )}
        </p>
      )}
    </div>
  );
}

const clamp = (value: number) => Math.max(-1, Math.min(1, value));

function gamepad(): { id: string; v: number; w: number } | null {
  const pad = navigator.getGamepads().find((one) => one?.connected);
  if (!pad) return null;
  const axis = (value = 0) => (Math.abs(value) < kDead ? 0 : -value);
  return { id: pad.id, v: axis(pad.axes[1]), w: axis(pad.axes[2] ?? pad.axes[0]) };
}

/** Says a velocity when it has changed, and not before the last one was answered; the last one is always said. */
class Sender {
  private said = "";
  private wanted = "";
  private isBusy = false;
  private saying: Promise<void> = Promise.resolve();

  constructor(
    private readonly session: ReturnType<typeof usePage>["session"],
    private readonly robot: Robot,
  ) {}

  want(v: number, w: number): void {
    if (v === 0 && w === 0 && this.said === "") return; // it was never told to move
    this.wanted = `VELOCITY v_m_s=${plain(v)} w_rad_s=${plain(w)} robot=${this.robot.number}`;
    void this.say();
  }

  /** Stops the robot, and gives it back to whoever it was taken from. */
  async end(): Promise<void> {
    if (this.said === "") return;
    this.want(0, 0);
    await this.saying;
    await this.session.giveBack(this.robot.number);
  }

  private say(): Promise<void> {
    if (!this.isBusy) this.saying = this.sayAll();
    return this.saying;
  }

  private async sayAll(): Promise<void> {
    this.isBusy = true;
    while (this.said !== this.wanted) {
      this.said = this.wanted;
      await this.session.act(this.said, "drive");
    }
    this.isBusy = false;
  }
}
