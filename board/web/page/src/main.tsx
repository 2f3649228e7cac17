import "uplot/dist/uPlot.min.css";
import "./page.css";
import { render } from "preact";
import { App } from "./app/App";
import { boardAddress, fileAddress, parseAddress } from "./link/address";
import type { Line } from "./link/Connection";
import { RecordedBoard, RecordedTime, type RecordedRun } from "./link/RecordedBoard";
import { Demo } from "./model/Demo";
import { FileOpening } from "./model/FileOpening";
import { Insight } from "./model/Insight";
import { Session } from "./model/Session";
import type { World } from "./model/world";
import { PageContext, type Context } from "./ui/context";
import { installKeys } from "./ui/keys";
import { areApart } from "./ui/apart";
import { Ui } from "./ui/Ui";

const address = parseAddress(location.hash);
const ui = new Ui(address);
const recorded = document.getElementById("run");
const run = recorded && new RecordedTime(JSON.parse(recorded.textContent ?? "") as RecordedRun);
const dial = run
  ? () => new RecordedBoard(run) as Line
  : () => new WebSocket(boardAddress(location), ["ortung.board.1"]);
const session = new Session(dial, recorded ? "-" : address.token);
if (address.robot) session.board.selected = address.robot;
const insight = new Insight(session, () => {
  ui.heat = insight.map?.heat ?? null;
  ui.expected = insight.expected;
  ui.redraw();
  session.board.touch();
});
const opening = new FileOpening({
  board: session.board,
  url: recorded || !location.protocol.startsWith("http") ? null : fileAddress(location),
  token: () => ui.address.token,
});
const context: Context = { session, ui, insight, opening };

const demo = address.demo ? new Demo(session, insight) : null;

let shown = -1;
let world: World | null = null;
const settle = () => {
  const { board } = session;
  insight.wantsExpected = ui.layers.expected;
  insight.wantsLocalize = board.robot !== null;
  const isApart = areApart(board, ui);
  if (session.wishes.samples !== ui.layers.samples || session.wishes.all !== isApart) {
    session.wishes.samples = ui.layers.samples;
    session.wishes.all = isApart;
    session.wish();
  }
  if (board.world !== world) {
    const isAnother = world !== null;
    world = board.world;
    if (isAnother) insight.clear();
    // Where no walls are known, the scans of a record show what there is.
    const isUnknown = board.kind === "record" && !board.drawing.walls.length;
    if (isUnknown !== ui.layers.along) ui.change({ layers: { ...ui.layers, along: isUnknown } });
  }
  if (board.selected !== shown) {
    shown = board.selected;
    insight.clear();
  }
  demo?.look();
  ui.showSelection(board.robots.size ? board.selected : (address.robot ?? 0));
};
ui.onChange(settle);
session.board.onTouch(settle);

const frame = () => {
  session.drawn();
  requestAnimationFrame(frame);
};
requestAnimationFrame(frame);

installKeys(context);
session.start();
insight.start();
render(
  <PageContext.Provider value={context}>
    <App />
  </PageContext.Provider>,
  document.getElementById("page")!,
);
