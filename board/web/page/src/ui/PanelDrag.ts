import { canJoin, curvesOf, type CurveRef, type PanelId } from "../layout/curves";
import { kAreas, shownOf, type Area, type Layout } from "../layout/Layout";
import { joined, moved, takenOut, type Target } from "../layout/moves";
import { isNarrowNow } from "./narrow";

/** What is dragged: a panel, or a curve out of one. */
export type Dragged = { panel: PanelId } | { curve: CurveRef };

interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** Where something would be dropped: what is marked on the screen, and the layout after it. */
interface Drop {
  box: Box;
  layout: Layout;
}

const kBegin = 6; // pixels until a press is a drag
const kOfField = 0.25;
const kOfGroup = 0.3;

const curvesIn = (dragged: Dragged): CurveRef[] => ("curve" in dragged ? [dragged.curve] : (curvesOf(dragged.panel) ?? []));

function put(layout: Layout, dragged: Dragged, target: Target): Layout {
  return "panel" in dragged ? moved(layout, dragged.panel, target) : takenOut(layout, [dragged.curve], target);
}

/** The part of a box along one edge. */
function edgeOf({ left, top, width, height }: Box, edge: Area | "top", part: number): Box {
  switch (edge) {
    case "left":
      return { left, top, width: part * width, height };
    case "right":
      return { left: left + (1 - part) * width, top, width: part * width, height };
    case "top":
      return { left, top, width, height: part * height };
    case "bottom":
      return { left, top: top + (1 - part) * height, width, height: part * height };
  }
}

/** Beside or below the field, where the pointer is near that edge of it. */
function ontoField(stage: Element, x: number, y: number, layout: Layout, dragged: Dragged): Drop | null {
  const box = stage.getBoundingClientRect();
  const across = (x - box.left) / box.width;
  const down = (y - box.top) / box.height;
  const area = down > 1 - kOfField ? "bottom" : across < kOfField ? "left" : across > 1 - kOfField ? "right" : null;
  if (!area) return null;
  return { box: edgeOf(box, area, kOfField), layout: put(layout, dragged, { area, before: layout.groups[area].length }) };
}

/** Among the tabs of a group, before the first one whose middle is not left of the pointer. */
function ontoHead(head: Element, x: number, area: Area, group: number, layout: Layout, dragged: Dragged): Drop {
  const tabs = [...head.querySelectorAll('[role="tab"]')].map((tab) => tab.getBoundingClientRect());
  const found = tabs.findIndex(({ left, width }) => x < left + width / 2);
  const at = found < 0 ? tabs.length : found;
  const { top, height } = head.getBoundingClientRect();
  const edge = tabs[at]?.left ?? tabs.at(-1)!.right;
  return { box: { left: edge - 2, top, width: 4, height }, layout: put(layout, dragged, { area, group, at }) };
}

/** Before or behind a group, among its tabs, or a curve among its curves. */
function ontoBody(body: Element, x: number, y: number, area: Area, group: number, layout: Layout, dragged: Dragged): Drop {
  const box = body.getBoundingClientRect();
  const isRow = area === "bottom";
  const along = isRow ? (x - box.left) / box.width : (y - box.top) / box.height;
  if (along < kOfGroup || along > 1 - kOfGroup) {
    const isBefore = along < 0.5;
    const edge = isRow ? (isBefore ? "left" : "right") : isBefore ? "top" : "bottom";
    return { box: edgeOf(box, edge, kOfGroup), layout: put(layout, dragged, { area, before: group + (isBefore ? 0 : 1) }) };
  }
  const there = layout.groups[area][group]!;
  const curves = curvesIn(dragged);
  const shown = shownOf(there);
  if (curves.length && canJoin(shown, curves)) return { box, layout: joined(layout, curves, shown) };
  return { box, layout: put(layout, dragged, { area, group, at: there.panels.length }) };
}

/** Where a pointer would drop something; null where nothing can be. */
function dropAt(x: number, y: number, layout: Layout, dragged: Dragged): Drop | null {
  const under = document.elementFromPoint(x, y);
  const element = under?.closest<HTMLElement>("[data-group]");
  if (!element) {
    const stage = under?.closest(".stage");
    return stage ? ontoField(stage, x, y, layout, dragged) : null;
  }
  const area = kAreas.find((one) => one === element.dataset.area);
  const group = Number(element.dataset.group);
  if (!area || !layout.groups[area][group]) return null;
  const head = under!.closest(".head");
  return head ? ontoHead(head, x, area, group, layout, dragged) : ontoBody(element, x, y, area, group, layout, dragged);
}

/** Drags panels and curves to other places of the page: by mouse, pen or finger; Escape gives up. */
export class PanelDrag {
  private readonly mark = document.createElement("div");
  private readonly label = document.createElement("div");
  private end: (() => void) | null = null;

  constructor(private readonly ui: { layout: Layout; change(what: { layout: Layout }): void }) {
    this.mark.className = "drop-mark";
    this.label.className = "drag-label";
  }

  /** @param event a press on what is to be dragged, which stays a click until the pointer has moved */
  begin(event: PointerEvent, dragged: Dragged, name: string): void {
    if (event.button !== 0 || !event.isPrimary || isNarrowNow()) return;
    this.end?.();
    const { pointerId, clientX, clientY } = event;
    let drop: Drop | null = null;
    let isDragged = false;
    const move = (next: PointerEvent) => {
      if (next.pointerId !== pointerId) return;
      isDragged ||= Math.hypot(next.clientX - clientX, next.clientY - clientY) > kBegin;
      if (!isDragged) return;
      next.preventDefault();
      drop = dropAt(next.clientX, next.clientY, this.ui.layout, dragged);
      this.show(next, name, drop);
    };
    const release = (next: PointerEvent) => {
      if (next.pointerId !== pointerId) return;
      this.end?.();
      if (isDragged && drop && next.type === "pointerup") this.ui.change({ layout: drop.layout });
    };
    const press = (key: KeyboardEvent) => {
      if (key.key !== "Escape" || !isDragged) return;
      key.stopPropagation();
      this.end?.();
    };
    const on = { pointermove: move, pointerup: release, pointercancel: release } as const;
    for (const [type, listener] of Object.entries(on)) window.addEventListener(type as "pointermove", listener, true);
    window.addEventListener("keydown", press, true);
    this.end = () => {
      for (const [type, listener] of Object.entries(on)) window.removeEventListener(type as "pointermove", listener, true);
      window.removeEventListener("keydown", press, true);
      this.mark.remove();
      this.label.remove();
      document.documentElement.classList.remove("dragging");
      this.end = null;
    };
  }

  private show({ clientX, clientY }: PointerEvent, name: string, drop: Drop | null): void {
    document.documentElement.classList.add("dragging");
    this.label.textContent = name;
    Object.assign(this.label.style, { left: `${clientX + 12}px`, top: `${clientY + 12}px` });
    document.body.append(this.label);
    if (!drop) return this.mark.remove();
    const { left, top, width, height } = drop.box;
    Object.assign(this.mark.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
    document.body.append(this.mark);
  }
}
