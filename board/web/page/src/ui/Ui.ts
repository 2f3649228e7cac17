import type { Address } from "../link/address";
import { toFragment } from "../link/address";
import type { Point } from "../model/geometry";
import type { Expected, Heat } from "../model/maps";
import { DrivingKeys } from "./DrivingKeys";
import { kLayers, kLayerNames, type Layers } from "./layers";
import { kept as sizeOf, kFieldHeight, kSideWidth } from "./sizes";

export type Theme = "auto" | "light" | "dark";
export const kPanels = ["robots", "sensors", "localization", "game"] as const;
export type Panel = (typeof kPanels)[number];
export type Tool = "look" | "measure";

const kPrefersDark = matchMedia("(prefers-color-scheme: dark)");
const kStore = "ortung.view";

interface Kept {
  theme: Theme;
  panel: Panel;
  layers: Layers;
  isLogOpen: boolean;
  isOneField: boolean;
  sideWidth: number;
  fieldHeight: number;
}

/** How the user wants to see things. Kept in the browser; the address has what others can be sent. */
export class Ui {
  theme: Theme = "auto";
  /** What `theme` comes to, with the system's colours. */
  isDark = true;
  panel: Panel = "robots";
  layers = Object.fromEntries(kLayerNames.map((name) => [name, kLayers[name].on])) as unknown as Layers;
  isLogOpen = false;
  /** Of the panels beside the field [pixels], of the field above them on narrow screens [percent]. */
  sideWidth = kSideWidth.usual;
  fieldHeight = kFieldHeight.usual;
  isHelpOpen = false;
  is3d = false;
  /** Whether runs lie upon each other, instead of side by side. */
  isOneField = false;
  follow = false;
  tool: Tool = "look";
  drivesByKeys = false;
  readonly drivingKeys = new DrivingKeys(window, () => this.drivesByKeys);
  heat: Heat | null = null;
  expected: Expected | null = null;
  /** Where the user asked why, on the field. */
  asked: Point | null = null;
  frame = 0;
  private readonly listeners = new Set<() => void>();

  constructor(readonly address: Address) {
    this.load();
    if (kPanels.includes(address.panel as Panel)) this.panel = address.panel as Panel;
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
    const next = toFragment({ ...this.address, robot: robot || null, follow: this.follow, panel: this.panel });
    if (next !== location.hash) history.replaceState(null, "", next || location.pathname + location.search);
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
      if (kept.panel && kPanels.includes(kept.panel)) this.panel = kept.panel;
      this.isLogOpen = kept.isLogOpen === true;
      this.isOneField = kept.isOneField === true;
      this.sideWidth = sizeOf(kept.sideWidth, kSideWidth);
      this.fieldHeight = sizeOf(kept.fieldHeight, kFieldHeight);
      for (const name of kLayerNames) {
        const on: unknown = kept.layers?.[name];
        if (typeof on === "boolean") this.layers[name] = on;
      }
    } catch {
      // nothing is kept where the browser forbids it, or something else wrote there
    }
  }

  private keep(): void {
    const { theme, panel, layers, isLogOpen, isOneField, sideWidth, fieldHeight } = this;
    try {
      localStorage.setItem(kStore, JSON.stringify({ theme, panel, layers, isLogOpen, isOneField, sideWidth, fieldHeight } satisfies Kept));
    } catch {
      // as above
    }
  }
}
