import { canJoin, curvesOf, nameOfKey, type PanelId } from "../layout/curves";
import { kAreas, panelsOf, placeOf, shownOf, type Layout } from "../layout/Layout";
import { closed, collapsed, enlarged, joined, moved, shifted, takenOut, targetOf, type Way } from "../layout/moves";
import type { Board } from "../model/Board";
import { Icon } from "../panels/Icon";
import { Menu, type MenuItem } from "../panels/Menu";
import { usePage } from "../ui/context";
import { useNarrow } from "../ui/narrow";
import { titleOf } from "../ui/titles";

const kWays: [Way, string][] = [
  ["up", "Move up"], ["down", "Move down"], ["left", "Move left"], ["right", "Move right"], ["bottom", "Move below"],
  ["earlier", "Tab to the left"], ["later", "Tab to the right"],
];
/** What lies below the field lies side by side. */
const kOfBelow: Partial<Record<Way, string>> = { up: "Move before its neighbour", down: "Move behind its neighbour" };

type Set = (layout: Layout) => void;

function movesOf(layout: Layout, panel: PanelId, board: Board, set: Set): MenuItem[] {
  const place = placeOf(layout, panel)!;
  const ways = kWays
    .filter(([way]) => targetOf(layout, panel, way))
    .map(([way, text]) => ({
      text: (place.area === "bottom" && kOfBelow[way]) || text,
      do: () => set(shifted(layout, panel, way)),
    }));
  const others = kAreas.flatMap((area) => layout.groups[area].map((group, at) => ({ area, group, at })));
  const joins = others
    .filter(({ area, at }) => area !== place.area || at !== place.group)
    .map(({ area, group, at }) => ({
      text: `To the tabs of ${titleOf(shownOf(group), board)}`,
      do: () => set(moved(layout, panel, { area, group: at, at: group.panels.length })),
    }));
  return [...ways, ...joins];
}

/** Of a panel of curves: joining others, and taking one out. */
function curveItems(layout: Layout, panel: PanelId, board: Board, set: Set): MenuItem[] {
  const curves = curvesOf(panel);
  if (!curves) return [];
  const { area, group } = placeOf(layout, panel)!;
  const joins = panelsOf(layout)
    .filter((other) => other !== panel && canJoin(other, curves))
    .map((other) => ({ text: `Join ${titleOf(other, board)}`, do: () => set(joined(layout, curves, other)) }));
  const outs = curves.length < 2 ? [] : curves.map((curve) => ({
    text: `Take out ${nameOfKey(curve.key)}`,
    do: () => set(takenOut(layout, [curve], { area, before: group + 1 })),
  }));
  return [...joins, ...outs];
}

/** What can be done with a panel, on its head. */
export function PanelMenu({ panel }: { panel: PanelId }) {
  const { ui, session } = usePage();
  const isNarrow = useNarrow();
  const { layout } = ui;
  const place = placeOf(layout, panel);
  if (!place) return null;
  const set = (next: Layout) => ui.change({ layout: next });
  const isCollapsed = layout.groups[place.area][place.group]!.isCollapsed;
  const isLarge = layout.large === panel;
  const parts = [
    [{ text: isLarge ? "Put it back" : "Make large", do: () => set(enlarged(layout, isLarge ? null : panel)) }],
    isNarrow ? [] : [{ text: isCollapsed ? "Open" : "Collapse", do: () => set(collapsed(layout, place.area, place.group, !isCollapsed)) }],
    curveItems(layout, panel, session.board, set),
    isNarrow ? [] : movesOf(layout, panel, session.board, set),
    [{ text: "Close", do: () => set(closed(layout, panel)) }],
  ];
  const items = parts.flatMap((part, i) => part.map((item, k) => ({ ...item, beginsPart: i > 0 && k === 0 && parts[i]!.length > 0 && i !== 1 })));
  return <Menu label={`Panel ${titleOf(panel, session.board)}`} class="quiet" items={items}><Icon name="more" /></Menu>;
}
