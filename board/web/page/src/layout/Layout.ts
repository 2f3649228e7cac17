import { curvesOf, type PanelId } from "./curves";

/** The panels that every page has. */
export const kPanels = ["robots", "sensors", "localization", "game"] as const;
export type Panel = (typeof kPanels)[number];

/** Where panels are: beside the field, and below it. */
export const kAreas = ["left", "right", "bottom"] as const;
export type Area = (typeof kAreas)[number];

/** Panels at one place, of which one is seen: the others are its tabs. */
export interface Group {
  panels: PanelId[];
  /** Which of them is seen. */
  shown: number;
  /** Whether there is only its head. */
  isCollapsed: boolean;
  /** Its share of its area, in parts of what all groups of the area have together. */
  share: number;
}

/** Where all panels are. Values of this type are never changed: moves make new ones. */
export interface Layout {
  groups: Record<Area, Group[]>;
  /** Widths of the sides, height of what is below the field [pixels]. */
  sizes: Record<Area, number>;
  /** The panel that lies over the field. */
  large: PanelId | null;
}

export const kShare = { least: 10, most: 1000, usual: 100 };
export const kMostPanels = 24;

/** How far an edge can be moved, and how far one press of a key moves it. */
export interface Range {
  least: number;
  most: number;
  usual: number;
  step: number;
}

export const kSizes: Record<Area, Range> = {
  left: { least: 200, most: 900, usual: 372, step: 20 },
  right: { least: 260, most: 900, usual: 372, step: 20 },
  bottom: { least: 120, most: 900, usual: 230, step: 20 },
};

export function within(value: number, { least, most }: { least: number; most: number }): number {
  return Math.round(Math.min(most, Math.max(least, value)));
}

export const groupOf = (...panels: PanelId[]): Group => ({ panels, shown: 0, isCollapsed: false, share: kShare.usual });

/** All panels of a page on the right, one of them seen. */
export function usualLayout(): Layout {
  return {
    groups: { left: [], right: [groupOf(...kPanels)], bottom: [] },
    sizes: { left: kSizes.left.usual, right: kSizes.right.usual, bottom: kSizes.bottom.usual },
    large: null,
  };
}

export const isPanel = (name: PanelId): boolean => (kPanels as readonly string[]).includes(name) || curvesOf(name) !== null;

/** All panels that are open, from the left to the right and downwards. */
export function panelsOf({ groups }: Layout): PanelId[] {
  return [...groups.left, ...groups.right, ...groups.bottom].flatMap(({ panels }) => panels);
}

export interface Place {
  area: Area;
  /** Which group of the area. */
  group: number;
  /** Which panel of the group. */
  at: number;
}

/** Where a panel is; null if it is closed. */
export function placeOf({ groups }: Layout, panel: PanelId): Place | null {
  for (const area of kAreas) {
    for (const [group, { panels }] of groups[area].entries()) {
      const at = panels.indexOf(panel);
      if (at >= 0) return { area, group, at };
    }
  }
  return null;
}

export const shownOf = ({ panels, shown }: Group): PanelId => panels[shown] ?? panels[0]!;

/**
 * All panels as the tabs of one group, where there is no room for more.
 * @param wanted the one that is seen, if it is open
 */
export function oneGroup(layout: Layout, wanted: PanelId): Group {
  const panels = panelsOf(layout);
  return { ...groupOf(...panels), shown: Math.max(0, panels.indexOf(wanted)) };
}
