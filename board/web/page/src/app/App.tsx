import { useEffect, useState } from "preact/hooks";
import { oneGroup } from "../layout/Layout";
import { Divider } from "../panels/Divider";
import { Help } from "../panels/Help";
import { LayoutNote } from "../panels/PageMenu";
import { SaidBar } from "../panels/Said";
import { TimeLine } from "../panels/TimeLine";
import { TopBar } from "../panels/TopBar";
import { useBoard, usePage } from "../ui/context";
import { useNarrow } from "../ui/narrow";
import { kFieldHeight } from "../ui/sizes";
import { DropZone, OpeningNote } from "./DropZone";
import { FieldView } from "./FieldView";
import { AreaView, EdgeOf, GroupView } from "./Groups";
import { Large } from "./Large";

export function App() {
  const board = useBoard(250);
  const { ui } = usePage();
  const isNarrow = useNarrow();
  useEffect(() => {
    document.title = board.worldName ? `${board.worldName} – Ortung` : "Ortung";
  }, [board.worldName]);
  return (
    <div class="page">
      <TopBar />
      <LinkNote />
      <TokenNote />
      <LayoutNote />
      <OpeningNote />
      <main class="work" style={{ "--field": `${ui.fieldHeight}%` }}>
        {!isNarrow && <AreaView key="left" area="left" />}
        {!isNarrow && <EdgeOf key="edge-left" area="left" />}
        <div class="middle" key="middle">
          <div class="view">
            <section class="stage" aria-label="Field">
              <FieldView />
            </section>
            {!isNarrow && <EdgeOf area="bottom" />}
            {!isNarrow && <AreaView area="bottom" />}
            {!isNarrow && <Large />}
          </div>
          {board.world && board.world.kind === "record" && <TimeLine />}
        </div>
        {!isNarrow && <EdgeOf key="edge-right" area="right" />}
        {!isNarrow && <AreaView key="right" area="right" />}
        {isNarrow && <Narrow key="narrow" />}
      </main>
      <SaidBar />
      {ui.isHelpOpen && <Help />}
      <DropZone />
    </div>
  );
}

/** All panels as tabs below the field. */
function Narrow() {
  const { ui } = usePage();
  const group = oneGroup(ui.layout, ui.panel);
  return (
    <>
      <Divider
        label="Height of the field"
        axis="y"
        grows={1}
        range={kFieldHeight}
        value={ui.fieldHeight}
        controls="side-all"
        valueAt={(_, y, handle) => {
          const box = handle.parentElement!.getBoundingClientRect();
          return (100 * (y - box.top)) / box.height;
        }}
        onSet={(fieldHeight) => ui.change({ fieldHeight })}
      />
      <aside class="side all" id="side-all" aria-label="Panels">
        {group.panels.length > 0 && <GroupView group={group} id="all" />}
      </aside>
      <Large />
    </>
  );
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
