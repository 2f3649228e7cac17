import { Fragment } from "preact";
import type { PanelId } from "../layout/curves";
import { kShare, kSizes, shownOf, type Area, type Group } from "../layout/Layout";
import { collapsed, enlarged, resized, shared } from "../layout/moves";
import { CurvesPanel } from "../panels/Curves";
import { Divider } from "../panels/Divider";
import { GamePanel } from "../panels/Game";
import { Icon } from "../panels/Icon";
import { LocalizationPanel } from "../panels/Localization";
import { RobotsPanel } from "../panels/Robots";
import { SensorsPanel } from "../panels/Sensors";
import { usePage } from "../ui/context";
import { titleOf } from "../ui/titles";
import { PanelMenu } from "./PanelMenu";

const kNames: Record<Area, string> = { left: "Panels on the left", right: "Panels", bottom: "Panels below" };
const kEdges: Record<Area, string> = { left: "Width of the panels on the left", right: "Width of the panels", bottom: "Height of the panels below" };

/** What a panel shows, wherever it is. */
export function Content({ panel }: { panel: PanelId }) {
  switch (panel) {
    case "robots":
      return <RobotsPanel />;
    case "sensors":
      return <SensorsPanel />;
    case "localization":
      return <LocalizationPanel />;
    case "game":
      return <GamePanel />;
    default:
      return <CurvesPanel key={panel} panel={panel} />;
  }
}

/** The panels of one side of the field, or below it, with the edges between them. */
export function AreaView({ area }: { area: Area }) {
  const { ui } = usePage();
  const groups = ui.layout.groups[area];
  if (!groups.length) return null;
  const isRow = area === "bottom";
  const isLow = isRow && groups.every(({ isCollapsed }) => isCollapsed);
  const size = isLow ? "auto" : `${ui.layout.sizes[area]}px`;
  return (
    <aside class={`side ${area}`} id={`side-${area}`} aria-label={kNames[area]} style={isRow ? { height: size } : { width: size }}>
      {groups.map((group, at) => (
        <Fragment key={at}>
          {at > 0 && <EdgeBetween area={area} first={at - 1} />}
          <GroupView group={group} id={`${area}-${at}`} area={area} at={at} />
        </Fragment>
      ))}
    </aside>
  );
}

/** The edge between the field and an area. */
export function EdgeOf({ area }: { area: Area }) {
  const { ui } = usePage();
  if (!ui.layout.groups[area].length) return null;
  const ofSide = (handle: HTMLElement) => handle.parentElement!.querySelector(`#side-${area}`)!.getBoundingClientRect();
  return (
    <Divider
      label={kEdges[area]}
      axis={area === "bottom" ? "y" : "x"}
      grows={area === "left" ? 1 : -1}
      range={kSizes[area]}
      value={ui.layout.sizes[area]}
      controls={`side-${area}`}
      valueAt={(x, y, handle) => {
        const { left, right, bottom } = ofSide(handle);
        return area === "left" ? x - left : area === "right" ? right - x : bottom - y;
      }}
      onSet={(size) => ui.change({ layout: resized(ui.layout, area, size) })}
    />
  );
}

/** The edge between two groups of an area, in percent of both. */
function EdgeBetween({ area, first }: { area: Area; first: number }) {
  const { ui } = usePage();
  const [one, next] = ui.layout.groups[area].slice(first, first + 2);
  if (!one || !next || one.isCollapsed || next.isCollapsed) return <div class="seam" />;
  const percent = (100 * one.share) / (one.share + next.share);
  const isRow = area === "bottom";
  return (
    <Divider
      label={`Edge behind panel group ${first + 1}`}
      axis={isRow ? "x" : "y"}
      grows={1}
      range={{ least: 5, most: 95, usual: 50, step: 5 }}
      value={Math.round(percent)}
      controls={`group-${area}-${first}`}
      valueAt={(x, y, handle) => {
        const a = handle.previousElementSibling!.getBoundingClientRect();
        const b = handle.nextElementSibling!.getBoundingClientRect();
        return 100 * (isRow ? (x - a.left) / (b.right - a.left) : (y - a.top) / (b.bottom - a.top));
      }}
      onSet={(value) => ui.change({ layout: shared(ui.layout, area, first, value / 100) })}
    />
  );
}

/**
 * Panels as tabs, one of them seen.
 * @param area where it is; without one it is all that there is room for
 */
export function GroupView({ group, id, area, at = 0 }: { group: Group; id: string; area?: Area; at?: number }) {
  const { ui, session } = usePage();
  const shown = shownOf(group);
  const isCollapsed = group.isCollapsed;
  const toggle = (panel: PanelId) => ui.change({ layout: enlarged(ui.layout, ui.layout.large === panel ? null : panel) });
  return (
    <section
      class={isCollapsed ? "group collapsed" : "group"}
      id={`group-${id}`}
      data-area={area}
      data-group={area && at}
      style={{ "--share": String(group.share / kShare.usual) }}
    >
      <div class="head">
        <div class="tabs" role="tablist" aria-label={`Panels ${id}`} onKeyDown={turn}>
          {group.panels.map((panel, i) => (
            <button
              key={panel}
              role="tab"
              id={`tab-${id}-${i}`}
              aria-controls={isCollapsed ? undefined : `panel-${id}`}
              aria-selected={panel === shown}
              tabIndex={panel === shown ? 0 : -1}
              title="drag: elsewhere; double click: large"
              onClick={() => ui.change({ panel })}
              onDblClick={() => toggle(panel)}
              onPointerDown={(event) => ui.drag.begin(event, { panel }, titleOf(panel, session.board))}
            >
              {titleOf(panel, session.board)}
            </button>
          ))}
        </div>
        {area && (
          <button
            class="quiet"
            aria-expanded={!isCollapsed}
            aria-label={isCollapsed ? "Open the panel" : "Collapse the panel"}
            title={isCollapsed ? "Open" : "Collapse"}
            onClick={() => ui.change({ layout: collapsed(ui.layout, area, at, !isCollapsed) })}
          >
            <Icon name={isCollapsed ? "open" : "collapse"} />
          </button>
        )}
        <PanelMenu panel={shown} />
      </div>
      {!isCollapsed && (
        <div class="panel" role="tabpanel" id={`panel-${id}`} aria-labelledby={`tab-${id}-${group.panels.indexOf(shown)}`} tabIndex={0}>
          {ui.layout.large === shown ? (
            <p class="row wrap hint">
              It lies over the field. <button onClick={() => toggle(shown)}>Put it back</button>
            </p>
          ) : (
            <Content panel={shown} />
          )}
        </div>
      )}
    </section>
  );

  /** Arrow keys go from tab to tab. */
  function turn(event: KeyboardEvent) {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    const count = group.panels.length;
    const next = (group.panels.indexOf(shown) + by + count) % count;
    ui.change({ panel: group.panels[next]! });
    document.getElementById(`tab-${id}-${next}`)?.focus();
  }
}
