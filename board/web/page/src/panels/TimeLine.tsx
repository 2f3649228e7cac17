import { useRef, useState } from "preact/hooks";
import { useBoard, usePage } from "../ui/context";
import { Seeker } from "../ui/Seeker";
import { seconds } from "./parts";

/** A record from its beginning to its end, with marks for what has happened. */
export function TimeLine() {
  const board = useBoard(100);
  const { session } = usePage();
  const world = board.world!;
  const length = Math.max(0, world.end - world.start);
  const [held, setHeld] = useState<number | null>(null);
  const seeker = useRef<Seeker | null>(null);
  const at = held ?? Math.min(length, Math.max(0, board.now - world.start));
  seeker.current ??= new Seeker(session);
  if (!board.can("SEEK") || length === 0) return null;
  return (
    <div class="time-line">
      <span>{seconds(at)}</span>
      <div class="bar">
        <input
          type="range"
          min={0}
          max={length}
          step={10000}
          value={at}
          disabled={!board.isOperator}
          aria-label="Time of the record"
          aria-valuetext={seconds(at)}
          onInput={(event) => {
            const to = Number(event.currentTarget.value);
            setHeld(to);
            void seeker.current!.goTo(to / 1e6);
          }}
          onChange={() => setHeld(null)}
        />
        <svg class="marks" viewBox="0 0 1000 10" preserveAspectRatio="none" aria-hidden="true">
          {board.robot?.mapMoments.map((stamp) => (
            <rect key={`map ${stamp}`} x={(1000 * (stamp - world.start)) / length - 1} y="5" width="2.5" height="5" class="mark map" />
          ))}
          {board.happenings.map(({ number, stamp, what, text }) => {
            const kind = /(?:^|: )(goal|lost|carried)\b/.exec(`${what}: ${text}`)?.[1] ?? "";
            const x = (1000 * (stamp - world.start)) / length - 1;
            return <rect key={number} x={x} y="0" width="2.5" height="10" class={`mark ${kind}`} />;
          })}
        </svg>
      </div>
      <span>{seconds(length)}</span>
    </div>
  );
}
