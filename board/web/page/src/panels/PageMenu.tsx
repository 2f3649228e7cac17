import { curvesOf } from "../layout/curves";
import { kPanels, panelsOf, placeOf } from "../layout/Layout";
import { closed } from "../layout/moves";
import { usePage } from "../ui/context";
import { titleOf } from "../ui/titles";
import { Icon } from "./Icon";
import { Menu, type MenuItem } from "./Menu";

/** What there is to see: brings back panels that were closed, and opens files. */
export function PageMenu() {
  const { session, ui, opening } = usePage();
  const { layout } = ui;
  const curves = panelsOf(layout).filter((panel) => curvesOf(panel));
  const panels: MenuItem[] = [...kPanels, ...curves].map((panel, i) => {
    const isOpen = placeOf(layout, panel) !== null;
    return {
      text: titleOf(panel, session.board),
      isChecked: isOpen,
      beginsPart: i === kPanels.length,
      do: () => ui.change(isOpen ? { layout: closed(layout, panel) } : { panel }),
    };
  });
  const copy = async () => {
    const link = ui.link();
    const who = ui.address.token ? " It has no token: who opens it looks, and can't steer." : "";
    try {
      await navigator.clipboard.writeText(link);
      ui.change({ note: { text: `The link to this layout was copied.${who}`, link } });
    } catch {
      // Browsers give no clipboard to pages that are not of this computer, or not encrypted.
      ui.change({ note: { text: `The link to this layout, to be copied from here.${who}`, link } });
    }
  };
  const choose = (isBeside: boolean) => () => {
    const input = document.createElement("input");
    input.type = "file";
    input.onchange = () => void opening.open([...(input.files ?? [])], isBeside);
    input.click();
  };
  const files: MenuItem[] = opening.isPossible && session.board.isOperator
    ? [
        { text: "Open a file …", beginsPart: true, do: choose(false) },
        { text: "Open a file beside this …", do: choose(true) },
      ]
    : [];
  const items: MenuItem[] = [
    ...panels,
    ...files,
    { text: "Copy a link to this layout", beginsPart: true, do: () => void copy() },
    { text: "Reset layout", do: () => ui.resetLayout() },
  ];
  return <Menu label="Panels, layout, files" items={items}><Icon name="panels" /></Menu>;
}

/** What is to be said of the layout, until the user has read it. */
export function LayoutNote() {
  const { ui } = usePage();
  const { note } = ui;
  return (
    <div role="status" class={note ? "layout-note" : "layout-note none"}>
      {note && (
        <>
          <span>{note.text}</span>
          {note.link !== undefined && (
            <input readOnly aria-label="Link to this layout" value={note.link} onFocus={(event) => event.currentTarget.select()} />
          )}
          <button aria-label="Close this note" onClick={() => ui.change({ note: null })}>×</button>
        </>
      )}
    </div>
  );
}
