import { enlarged } from "../layout/moves";
import { Icon } from "../panels/Icon";
import { useBoard, usePage } from "../ui/context";
import { titleOf } from "../ui/titles";
import { Content } from "./Groups";
import { PanelMenu } from "./PanelMenu";

/** The panel that lies over the field, if there is one. */
export function Large() {
  const board = useBoard(500);
  const { ui } = usePage();
  const panel = ui.layout.large;
  if (panel === null) return null;
  const back = () => ui.change({ layout: enlarged(ui.layout, null) });
  return (
    <section class="large" aria-label={`${titleOf(panel, board)}, large`}>
      <div class="head">
        <h2 onDblClick={back} title="double click: back">{titleOf(panel, board)}</h2>
        <button class="quiet" aria-label="Put it back" title="Put it back (Esc)" onClick={back}><Icon name="back" /></button>
        <PanelMenu panel={panel} />
      </div>
      <div class="panel" tabIndex={0} role="group" aria-label={titleOf(panel, board)}>
        <Content panel={panel} />
      </div>
    </section>
  );
}
