import { useEffect, useRef, useState } from "preact/hooks";
import { useBoard, usePage } from "../ui/context";

/** What was said to the server, line by line, and a place to say more. */
export function SaidBar() {
  const board = useBoard(100);
  const { session, ui } = usePage();
  const [text, setText] = useState("");
  const list = useRef<HTMLDivElement>(null);
  const last = board.said.at(-1);
  useEffect(() => {
    if (list.current) list.current.scrollTop = list.current.scrollHeight;
  }, [last?.id, ui.isLogOpen]);
  const clock = (time: number) => new Date(time).toTimeString().slice(0, 8);
  return (
    <footer class={ui.isLogOpen ? "said open" : "said"}>
      <button
        class="toggle"
        aria-expanded={ui.isLogOpen}
        title="Requests of this page to the server, and the replies (l)"
        onClick={() => ui.change({ isLogOpen: !ui.isLogOpen })}
      >
        Protocol log
      </button>
      {!ui.isLogOpen && last && (
        <span class={last.isError ? "last bad" : "last"}>
          <code>{last.line}</code> {last.times > 1 && `×${last.times} `}
          <span class="outcome">{last.outcome}</span>
        </span>
      )}
      {!ui.isLogOpen && !last && <span class="last hint">every action shows its line of the protocol here</span>}
      {ui.isLogOpen && (
        <>
          <div ref={list} class="lines" role="log" aria-label="Protocol log" tabIndex={0}>
            <ol>
            {board.said.map(({ id, time, line, outcome, isError, times }) => (
              <li key={id} class={isError ? "bad" : ""}>
                <time>{clock(time)}</time> <code>{line}</code> {times > 1 && `×${times} `}
                <span class="outcome">{outcome}</span>
              </li>
              ))}
            </ol>
          </div>
          <form
            onSubmit={(event) => {
              event.preventDefault();
              if (text.trim()) void session.act(text.trim(), "said");
              setText("");
            }}
          >
            <input
              aria-label="Send a line of the protocol"
              placeholder="send a line of the protocol, e.g. STATUS"
              value={text}
              disabled={board.link !== "open"}
              onInput={(event) => setText(event.currentTarget.value)}
            />
            <button type="submit" disabled={board.link !== "open"}>Send</button>
          </form>
        </>
      )}
    </footer>
  );
}
