import type { Address } from "../link/address";
import { toFragment } from "../link/address";
import type { Point } from "../model/geometry";
import type { Expected, Heat } from "../model/maps";
import type { PanelId } from "../layout/curves";
import { kPanels, kSizes, placeOf, shownOf, usualLayout, type Layout, type Panel } from "../layout/Layout";
import { resized, revealed } from "../layout/moves";
import { LayoutError, readArrangement, writeArrangement, type Arrangement } from "../layout/text";
import { DrivingKeys } from "./DrivingKeys";
import { kLayers, kLayerNames, sharedLayers, withShared, type Layers } from "./layers";
import { PanelDrag } from "./PanelDrag";
import { kept as sizeOf, kFieldHeight } from "./sizes";

export type Theme = "auto" | "light" | "dark";
export type Tool = "look" | "measure";

const kPrefersDark = matchMedia("(prefers-color-scheme: dark)");
const kStore = "ortung.view";

const kNothing = { layers: null, views: [] };
const isOwn = (panel: PanelId): panel is Panel => (kPanels as readonly string[]).includes(panel);

interface Kept {
  theme: Theme;
  panel: Panel;
  layers: Layers;
  isLogOpen: boolean;
  isOneField: boolean;
  fieldHeight: number;
  layout: string;
  /** Of the panels beside the field, as pages kept it that had no layout yet. */
  sideWidth?: number;
}

/** How the user wants to see things. Kept in the browser; the address has what others can be sent. */
export class Ui {
  theme: Theme = "auto";
  /** What `theme` comes to, with the system's colours. */
  isDark = true;
  /** The panel that was chosen last. */
  panel: PanelId = "robots";
  /** The same, of those that every page has. */
  private ownPanel: Panel = "robots";
  layout: Layout = usualLayout();
  /** What is to be said of the layout, and a link that the user may copy. */
  note: { text: string; link?: string } | null = null;
  layers = Object.fromEntries(kLayerNames.map((name) => [name, kLayers[name].on])) as unknown as Layers;
  isLogOpen = false;
  /** Of the field above the panels on narrow screens [percent]. */
  fieldHeight = kFieldHeight.usual;
  isHelpOpen = false;
  is3d = false;
  /** Whether runs lie upon each other, instead of side by side. */
  isOneField = false;
  follow = false;
  tool: Tool = "look";
  drivesByKeys = false;
  readonly drag = new PanelDrag(this);
  readonly drivingKeys = new DrivingKeys(window, () => this.drivesByKeys);
  heat: Heat | null = null;
  expected: Expected | null = null;
  /** Where the user asked why, on the field. */
  asked: Point | null = null;
  frame = 0;
  private readonly listeners = new Set<() => void>();

  constructor(readonly address: Address) {
    this.load();
    if (address.layout !== null) this.arrange(address.layout);
    if (address.panel !== null && isOwn(address.panel)) {
      this.panel = this.ownPanel = address.panel;
      this.layout = revealed(this.layout, this.panel);
    }
    this.follow = address.follow;
    this.showTheme();
    // The system's colours may change while the page is open, at dusk for example.
    kPrefersDark.addEventListener("change", () => this.change({}));
  }

  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  change(what: Partial<Ui>): void {
    Object.assign(this, what);
    if (what.panel !== undefined) {
      this.layout = revealed(this.layout, what.panel);
      if (isOwn(what.panel)) this.ownPanel = what.panel;
    }
    this.frame++;
    if (!this.drivesByKeys) this.drivingKeys.clear();
    this.showTheme();
    this.keep();
    for (const listener of this.listeners) listener();
  }

  /** Draws the field again without a change of what panels show. */
  redraw(): void {
    this.frame++;
  }

  showSelection(robot: number): void {
    this.address.robot = robot || null;
    this.showAddress();
  }

  /** The address says what the page shows, so that it is the same when it is opened again. */
  private showAddress(): void {
    const text = this.arrangement();
    const isUsual = text === writeArrangement({ ...kNothing, layout: { ...usualLayout(), groups: this.usualGroups() } });
    const next = toFragment({ ...this.address, ...this.chosen(), layout: isUsual ? null : text });
    if (next !== location.hash) history.replaceState(null, "", next || location.pathname + location.search);
  }

  /** Which tab of the usual group is seen is no layout of one's own: the address names that panel anyway. */
  private usualGroups(): Layout["groups"] {
    const groups = usualLayout().groups;
    return { ...groups, right: groups.right.map((group) => ({ ...group, shown: Math.max(0, group.panels.indexOf(this.ownPanel)) })) };
  }

  private chosen() {
    const place = placeOf(this.layout, this.ownPanel);
    const isSeen = place !== null && shownOf(this.layout.groups[place.area][place.group]!) === this.ownPanel;
    return { follow: this.follow, panel: isSeen ? this.ownPanel : null };
  }

  /** A link to what the page shows. It has no token: whoever follows it looks. */
  link(): string {
    const { origin, pathname, search, protocol } = location;
    const page = (protocol === "file:" ? "file://" : origin) + pathname + search;
    return page + toFragment({ ...this.address, ...this.chosen(), token: "", layout: this.arrangement() });
  }

  /** All as it is without anything that was kept. */
  resetLayout(): void {
    this.change({ layout: usualLayout(), panel: "robots", layers: withShared(this.layers, null), is3d: false, isOneField: false, note: null });
  }

  private arrangement(): string {
    const views = [...(this.is3d ? ["3d"] : []), ...(this.isOneField ? ["one"] : [])];
    return writeArrangement({ layout: this.layout, layers: sharedLayers(this.layers), views });
  }

  /** Shows what an address says; says so if that can't be read. */
  private arrange(text: string): void {
    let read: Arrangement;
    try {
      read = readArrangement(text);
    } catch (error) {
      if (!(error instanceof LayoutError)) throw error;
      this.layout = usualLayout();
      this.note = { text: `The layout in this address can't be shown, here is the usual one: ${error.message}.` };
      return;
    }
    this.layout = read.layout;
    this.layers = withShared(this.layers, read.layers);
    this.is3d = read.views.includes("3d");
    this.isOneField = read.views.includes("one");
  }

  useToken(token: string): void {
    this.address.token = token;
  }

  /**
   * The only place that asks which colours the system has: a browser that was asked between a change and its event
   * thinks that the change is known, and does not tell it.
   */
  private showTheme(): void {
    this.isDark = this.theme === "auto" ? kPrefersDark.matches : this.theme === "dark";
    document.documentElement.dataset.theme = this.isDark ? "dark" : "light";
  }

  private load(): void {
    try {
      const kept = JSON.parse(localStorage.getItem(kStore) ?? "{}") as Partial<Kept>;
      if (kept.theme === "light" || kept.theme === "dark") this.theme = kept.theme;
      if (kept.panel && isOwn(kept.panel)) this.panel = this.ownPanel = kept.panel;
      this.isLogOpen = kept.isLogOpen === true;
      this.isOneField = kept.isOneField === true;
      this.fieldHeight = sizeOf(kept.fieldHeight, kFieldHeight);
      for (const name of kLayerNames) {
        const on: unknown = kept.layers?.[name];
        if (typeof on === "boolean") this.layers[name] = on;
      }
      if (typeof kept.layout === "string") this.layout = readArrangement(kept.layout).layout;
      else this.layout = revealed(resized(this.layout, "right", sizeOf(kept.sideWidth, kSizes.right)), this.panel);
    } catch {
      // nothing is kept where the browser forbids it, or something else wrote there
    }
  }

  private keep(): void {
    const { theme, layers, isLogOpen, isOneField, fieldHeight } = this;
    const panel = this.ownPanel;
    const layout = writeArrangement({ ...kNothing, layout: this.layout });
    try {
      localStorage.setItem(kStore, JSON.stringify({ theme, panel, layers, isLogOpen, isOneField, fieldHeight, layout } satisfies Kept));
    } catch {
      // as above
    }
  }
}
