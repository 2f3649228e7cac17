import { useEffect, useState } from "preact/hooks";
import { Divider } from "../panels/Divider";
import type { Board } from "../model/Board";
import { GamePanel } from "../panels/Game";
import { Help } from "../panels/Help";
import { LocalizationPanel } from "../panels/Localization";
import { RobotsPanel } from "../panels/Robots";
import { SaidBar } from "../panels/Said";
import { SensorsPanel } from "../panels/Sensors";
import { TimeLine } from "../panels/TimeLine";
import { TopBar } from "../panels/TopBar";
import { useBoard, usePage } from "../ui/context";
import { kPanels, type Panel } from "../ui/Ui";
import { FieldView } from "./FieldView";

const kTitles: Record<Exclude<Panel, "game">, string> = {
  robots: "Robots",
  sensors: "Sensors",
  localization: "Localization",
};

/** What the panel of the world itself is called. */
function titleOfWorld(board: Board): string {
  if (board.kind === "record") return "Record";
  return board.isGame ? "Game" : "World";
}

export function App() {
  const board = useBoard(250);
  const { ui } = usePage();
  useEffect(() => {
    document.title = board.worldName ? `${board.worldName} – Ortung` : "Ortung";
  }, [board.worldName]);
  return (
    <div class="page">
      <TopBar />
      <LinkNote />
      <TokenNote />
      <main class="work" style={{ "--side": `${ui.sideWidth}px`, "--field": `${ui.fieldHeight}%` }}>
        <section class="stage" aria-label="Field">
          <FieldView />
          {board.world && board.world.kind === "record" && <TimeLine />}
        </section>
        <Divider />
        <aside class="side" aria-label="Panels">
          <div class="tabs" role="tablist" aria-label="Panels" onKeyDown={turn}>
            {kPanels.map((name) => (
              <button
                key={name}
                role="tab"
                id={`tab-${name}`}
                aria-controls="panel"
                aria-selected={ui.panel === name}
                tabIndex={ui.panel === name ? 0 : -1}
                onClick={() => ui.change({ panel: name })}
              >
                {name === "game" ? titleOfWorld(board) : kTitles[name]}
              </button>
            ))}
          </div>
          <div class="panel" role="tabpanel" id="panel" aria-labelledby={`tab-${ui.panel}`} tabIndex={0}>
            {ui.panel === "robots" && <RobotsPanel />}
            {ui.panel === "sensors" && <SensorsPanel />}
            {ui.panel === "localization" && <LocalizationPanel />}
            {ui.panel === "game" && <GamePanel />}
          </div>
        </aside>
      </main>
      <SaidBar />
      {ui.isHelpOpen && <Help />}
    </div>
  );

  /** Arrow keys go from tab to tab. */
  function turn(event: KeyboardEvent) {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    const next = kPanels[(kPanels.indexOf(ui.panel) + by + kPanels.length) % kPanels.length]!;
    ui.change({ panel: next });
    document.getElementById(`tab-${next}`)?.focus();
  }
}

/** Asks for the token that the server has printed. */
function TokenNote() {
  const board = useBoard();
  const { session, ui } = usePage();
  const [token, setToken] = useState("");
  if (!board.needsToken) return null;
  const why = board.needsToken === "wrong" ? "The token in this address is not, or no longer, valid" : "This server requires a token";
  return (
    <form
      class="token-note"
      onSubmit={(event) => {
        event.preventDefault();
        const given = token.trim();
        if (!/^[\x21-\x7e]{1,256}$/.test(given)) return;
        ui.useToken(given);
        session.useToken(given);
      }}
    >
      <span>{why}{board.link === "open" && ": view only"}. It printed one when it was started.</span>
      <input aria-label="Token" placeholder="token" value={token} onInput={(event) => setToken(event.currentTarget.value)} />
      <button type="submit">Use it</button>
    </form>
  );
}

function LinkNote() {
  const board = useBoard();
  const isBad = board.link === "lost" || board.link === "refused";
  const what = board.link === "refused" ? "the server refuses" : "connection lost, trying again";
  return (
    <div role="status" aria-live="polite" class={isBad ? "link-note bad" : "link-note"}>
      {isBad && (
        <>
          <strong>{what}</strong> <span>{board.linkText}</span>
        </>
      )}
    </div>
  );
}
