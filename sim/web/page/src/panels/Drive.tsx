import { useEffect, useState } from "preact/hooks";
import { usePage } from "../app/context";
import { plain } from "../link/words";
import type { Robot } from "../model/Robot";

const kPeriod = 100;
const kDead = 0.12;
const kWays: Record<string, [number, number]> = {
  w: [1, 0], s: [-1, 0], a: [0, 1], d: [0, -1], ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1],
};

/** Drives the selected robot by keys, buttons or a gamepad: VELOCITY, while something is held. */
export function DriveControls({ robot }: { robot: Robot }) {
  const { session, ui } = usePage();
  const { board } = session;
  const [share, setShare] = useState(0.5);
  const [pad, setPad] = useState("");
  const isOn = ui.drivesByKeys && board.isOperator;
  useEffect(() => {
    if (!isOn) return;
    const held = new Set<string>();
    const sender = new Sender(session, robot);
    const press = (event: KeyboardEvent) => {
      const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
      if (!kWays[key] || /^(INPUT|SELECT)$/.test((event.target as Element).tagName)) return;
      event.preventDefault();
      if (event.type === "keydown") held.add(key);
      else held.delete(key);
    };
    const drop = () => held.clear();
    const timer = setInterval(() => {
      let [v, w] = [0, 0];
      for (const key of held) {
        v += kWays[key]![0];
        w += kWays[key]![1];
      }
      const stick = gamepad();
      setPad(stick?.id ?? "");
      if (stick) [v, w] = [v + stick.v, w + stick.w];
      sender.want(clamp(v) * share * robot.speed, clamp(w) * share * robot.turn);
    }, kPeriod);
    window.addEventListener("keydown", press, true);
    window.addEventListener("keyup", press, true);
    window.addEventListener("blur", drop);
    return () => {
      clearInterval(timer);
      window.removeEventListener("keydown", press, true);
      window.removeEventListener("keyup", press, true);
      window.removeEventListener("blur", drop);
      sender.want(0, 0);
    };
  }, [isOn, session, robot, share]);
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

  constructor(
    private readonly session: ReturnType<typeof usePage>["session"],
    private readonly robot: Robot,
  ) {}

  want(v: number, w: number): void {
    if (v === 0 && w === 0 && this.said === "") return; // it was never told to move
    this.wanted = `VELOCITY v_m_s=${plain(v)} w_rad_s=${plain(w)} robot=${this.robot.number}`;
    void this.say();
  }

  private async say(): Promise<void> {
    if (this.isBusy) return;
    this.isBusy = true;
    while (this.said !== this.wanted) {
      this.said = this.wanted;
      await this.session.act(this.said, "drive");
    }
    this.isBusy = false;
  }
}
