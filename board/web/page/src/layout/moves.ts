import { canJoin, curvesOf, panelOf, type CurveRef, type PanelId } from "./curves";
import { groupOf, kAreas, kMostPanels, kShare, kSizes, panelsOf, placeOf, within, type Area, type Group, type Layout } from "./Layout";

/** Where a panel can be put: among the tabs of a group, or as a group of its own before that one. */
export type Target = { area: Area; group: number; at: number } | { area: Area; before: number };

/** What the menu of a panel can do with it. */
export type Way = "up" | "down" | Area | "earlier" | "later";

const kGone = "";

/** Without what is gone, and without groups that nothing is left of. */
function tidy(groups: Group[]): Group[] {
  return groups.flatMap((group) => {
    const seen = group.panels[group.shown];
    const panels = group.panels.filter((panel) => panel !== kGone);
    if (!panels.length) return [];
    const at = seen === undefined || seen === kGone ? Math.min(group.shown, panels.length - 1) : panels.indexOf(seen);
    return [{ ...group, panels, shown: at }];
  });
}

/** The groups of all areas, each changed. */
function each(layout: Layout, change: (group: Group, area: Area, at: number) => Group): Layout["groups"] {
  const of = (area: Area) => layout.groups[area].map((group, at) => change(group, area, at));
  return { left: of("left"), right: of("right"), bottom: of("bottom") };
}

const allTidy = (groups: Layout["groups"]) => ({ left: tidy(groups.left), right: tidy(groups.right), bottom: tidy(groups.bottom) });

/** Panels taken from where they are; their places stay until all is tidied. */
function emptied(layout: Layout, panel: PanelId): Layout["groups"] {
  return each(layout, (group) => ({ ...group, panels: group.panels.map((one) => (one === panel ? kGone : one)) }));
}

/** A group for one panel: as it was, if it was alone in that area before. */
function aloneAgain(layout: Layout, panel: PanelId, area: Area): Group {
  const place = placeOf(layout, panel);
  const old = place && place.area === area ? layout.groups[area][place.group] : undefined;
  return old?.panels.length === 1 ? { ...old } : groupOf(panel);
}

/** The layout with a panel elsewhere, where it is seen; it may have been closed before. */
export function moved(layout: Layout, panel: PanelId, target: Target): Layout {
  if (!placeOf(layout, panel) && panelsOf(layout).length >= kMostPanels) return layout;
  const groups = emptied(layout, panel);
  const there = groups[target.area];
  if ("before" in target) {
    const at = within(target.before, { least: 0, most: there.length });
    there.splice(at, 0, aloneAgain(layout, panel, target.area));
  } else {
    const group = there[target.group];
    if (!group) return layout;
    const at = within(target.at, { least: 0, most: group.panels.length });
    there[target.group] = { ...group, panels: [...group.panels.slice(0, at), panel, ...group.panels.slice(at)], shown: at, isCollapsed: false };
  }
  return { ...layout, groups: allTidy(groups) };
}

/** The layout in which a panel is seen: opened, if it was closed, where most are. */
export function revealed(layout: Layout, panel: PanelId): Layout {
  const place = placeOf(layout, panel);
  if (!place) {
    const area = kAreas.find((one) => one !== "bottom" && layout.groups[one].length) ?? "right";
    const home: Area = layout.groups.right.length ? "right" : area;
    const first = layout.groups[home][0];
    return moved(layout, panel, first ? { area: home, group: 0, at: first.panels.length } : { area: "right", before: 0 });
  }
  return {
    ...layout,
    groups: each(layout, (group, area, at) =>
      area === place.area && at === place.group ? { ...group, shown: place.at, isCollapsed: false } : group),
  };
}

export function closed(layout: Layout, panel: PanelId): Layout {
  return { ...layout, groups: allTidy(emptied(layout, panel)), large: layout.large === panel ? null : layout.large };
}

export function collapsed(layout: Layout, area: Area, group: number, isCollapsed: boolean): Layout {
  return { ...layout, groups: each(layout, (one, its, at) => (its === area && at === group ? { ...one, isCollapsed } : one)) };
}

/** A panel over the field, or none. */
export function enlarged(layout: Layout, panel: PanelId | null): Layout {
  if (panel === null) return { ...layout, large: null };
  const open = placeOf(layout, panel) ? layout : revealed(layout, panel);
  return placeOf(open, panel) ? { ...open, large: panel } : layout;
}

export function resized(layout: Layout, area: Area, size: number): Layout {
  return { ...layout, sizes: { ...layout.sizes, [area]: within(size, kSizes[area]) } };
}

/** The edge behind group @p first of an area moved: it gets a part of what it and the next one have together. */
export function shared(layout: Layout, area: Area, first: number, part: number): Layout {
  const [one, next] = layout.groups[area].slice(first, first + 2);
  if (!one || !next) return layout;
  const both = one.share + next.share;
  const most = Math.min(kShare.most, both - kShare.least);
  const share = within(both * part, { least: Math.max(kShare.least, both - kShare.most), most });
  const groups = layout.groups[area].map((group, at) =>
    at === first ? { ...group, share } : at === first + 1 ? { ...group, share: both - share } : group);
  return { ...layout, groups: { ...layout.groups, [area]: groups } };
}

/** Where a move of the menu leads to; null where it leads nowhere. */
export function targetOf(layout: Layout, panel: PanelId, way: Way): Target | null {
  const place = placeOf(layout, panel);
  if (!place) return null;
  const { area, group, at } = place;
  const there = layout.groups[area];
  const isAlone = there[group]!.panels.length === 1;
  switch (way) {
    case "up":
      if (!isAlone) return { area, before: group };
      return group > 0 ? { area, before: group - 1 } : null;
    case "down":
      if (!isAlone) return { area, before: group + 1 };
      return group + 1 < there.length ? { area, before: group + 2 } : null;
    case "earlier":
      return at > 0 ? { area, group, at: at - 1 } : null;
    case "later":
      return at + 1 < there[group]!.panels.length ? { area, group, at: at + 2 } : null;
    default:
      return way === area && isAlone ? null : { area: way, before: layout.groups[way].length };
  }
}

export function shifted(layout: Layout, panel: PanelId, way: Way): Layout {
  const target = targetOf(layout, panel, way);
  return target ? moved(layout, panel, target) : layout;
}

/** Another panel at the place of one. */
function replaced(layout: Layout, old: PanelId, panel: PanelId): Layout {
  const groups = each(layout, (group) => ({ ...group, panels: group.panels.map((one) => (one === old ? panel : one)) }));
  return { ...layout, groups, large: layout.large === old ? panel : layout.large };
}

/** Curves that a panel of its own has now; those that had them before lose them. */
export function takenOut(layout: Layout, curves: CurveRef[], target: Target): Layout {
  const panel = panelOf(curves);
  if (!curvesOf(panel)) return layout;
  if (placeOf(layout, panel)) return moved(layout, panel, target);
  const placed = moved(layout, panel, target);
  return placed === layout ? layout : without(placed, curves, panel);
}

/** The curves of one panel in another one, which is closed if nothing is left of it. */
export function joined(layout: Layout, curves: CurveRef[], panel: PanelId): Layout {
  if (!canJoin(panel, curves) || !placeOf(layout, panel)) return layout;
  const all = panelOf([...curvesOf(panel)!, ...curves]);
  return revealed(without(replaced(layout, panel, all), curves, all), all);
}

/** Panels other than @p keeper do not have these curves. */
function without(layout: Layout, curves: CurveRef[], keeper: PanelId): Layout {
  let next = layout;
  for (const panel of panelsOf(layout)) {
    const its = panel === keeper ? null : curvesOf(panel);
    const left = its?.filter(({ key }) => curves.every((curve) => curve.key !== key));
    if (!its || !left || left.length === its.length) continue;
    next = left.length ? replaced(next, panel, panelOf(left)) : closed(next, panel);
  }
  return next;
}

/** The layout in which no panel has this curve. */
export const putBack = (layout: Layout, key: string): Layout => without(layout, [{ key, unit: "" }], "");

/** The keys of all curves that have panels of their own. */
export function keysOut(layout: Layout): Set<string> {
  return new Set(panelsOf(layout).flatMap((panel) => curvesOf(panel)?.map(({ key }) => key) ?? []));
}
