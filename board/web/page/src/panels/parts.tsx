import type { ComponentChildren } from "preact";
import type { Board } from "../model/Board";
import { usePage } from "../ui/context";

/** The newest error of what was asked at a place of the page. */
export function ErrorNote({ at }: { at: string }) {
  const { board } = usePage().session;
  const text = board.errors.get(at);
  if (!text) return null;
  return (
    <p class="error" role="alert">
      {text}
      <button
        aria-label="Close"
        onClick={() => {
          board.errors.delete(at);
          board.touch();
        }}
      >
        ×
      </button>
    </p>
  );
}

/** A button that says a line of the protocol; the line is its tooltip. */
export function Say(props: {
  line: string;
  at: string;
  children: ComponentChildren;
  disabled?: boolean;
  label?: string;
  pressed?: boolean;
  class?: string;
}) {
  const { session } = usePage();
  const { board } = session;
  const forbids = board.link === "open" && !board.isOperator;
  return (
    <button
      class={props.class}
      disabled={props.disabled || !board.isOperator}
      title={forbids ? `${props.line} – needs the role operator` : props.line}
      aria-label={props.label}
      aria-pressed={props.pressed}
      onClick={() => void session.act(props.line, props.at)}
    >
      {props.children}
    </button>
  );
}

export function Section({ title, children }: { title: string; children: ComponentChildren }) {
  return (
    <section class="block">
      <h2>{title}</h2>
      {children}
    </section>
  );
}

/** From here on a time can't be one since a start [s]: it is since 1970. */
export const kLongAgo = 1e8;

/** Minutes and seconds since the start, or the time of day. @param stamp [us] */
export const seconds = (stamp: number): string => {
  const s = stamp / 1e6;
  if (s > kLongAgo) return timeOfDay(new Date(s * 1000));
  const minutes = Math.floor(s / 60);
  return `${minutes}:${(s - 60 * minutes).toFixed(1).padStart(4, "0")}`;
};

function timeOfDay(date: Date): string {
  const parts = [date.getHours(), date.getMinutes(), date.getSeconds()].map((part) => String(part).padStart(2, "0"));
  return parts.join(":");
}

export const shortName = (feature: string): string => feature.split("/").slice(1).join("/");

/** How old a map is. */
export function ageOf(stamp: number, board: Board): string {
  const age = (board.now - stamp) / 1e6;
  const long = `${Math.abs(age).toFixed(Math.abs(age) < 10 ? 1 : 0)} s`;
  return age < -0.05 ? `${long} ahead, of ${seconds(stamp)}` : `${long} old`;
}

export const probability = (p: number): string => (p !== 0 && Math.abs(p) < 0.001 ? p.toExponential(1) : p.toPrecision(2));
