/** A curve that a panel of its own shows: which series of the history, and in what unit. */
export interface CurveRef {
  /** As in the history: a feature and the name of its value, or what the page computes itself. */
  key: string;
  unit: string;
}

/** A panel's name: one of the page's own, or that of curves that were taken out. */
export type PanelId = string;

export const kMostCurves = 8;
const kBegin = "curves:";
const kLongestKey = 200;
const kLongestUnit = 12;

const isText = (text: string, most: number) => text.length <= most && !/[\x00-\x1f\x7f]/.test(text) && text.trim() === text;
const isCurve = ({ key, unit }: CurveRef) => key !== "" && isText(key, kLongestKey) && isText(unit, kLongestUnit);

/** The panel of some curves. */
export function panelOf(curves: CurveRef[]): PanelId {
  return kBegin + curves.map(({ key, unit }) => `${key}\t${unit}`).join("\n");
}

/** The curves of a panel; null if it is none of curves, or not as `panelOf` names it. */
export function curvesOf(panel: PanelId): CurveRef[] | null {
  if (!panel.startsWith(kBegin)) return null;
  const curves = panel
    .slice(kBegin.length)
    .split("\n")
    .map((line) => {
      const [key = "", unit, ...more] = line.split("\t");
      return unit === undefined || more.length ? null : { key, unit };
    });
  if (curves.length > kMostCurves || !curves.every((curve) => curve !== null && isCurve(curve))) return null;
  const found = curves as CurveRef[];
  const keys = new Set(found.map(({ key }) => key));
  return keys.size === found.length ? found : null;
}

/** Whether a curve can join those of a panel: they have its unit, it is not there yet, and there is room. */
export function canJoin(panel: PanelId, curves: CurveRef[]): boolean {
  const there = curvesOf(panel);
  return (
    there !== null &&
    there.length + curves.length <= kMostCurves &&
    curves.every((curve) => there.every(({ key, unit }) => key !== curve.key && unit === curve.unit))
  );
}

/** What a curve is called where nothing else is known of it. */
export function nameOfKey(key: string): string {
  const at = key.indexOf(" ");
  if (!key.includes("/") || at < 0) return key.replace(/^error distance$/, "error").replace(/^error heading$/, "heading error").replace(/^apart /, "from ");
  return `${key.slice(0, at).split("/").at(-1)} ${key.slice(at + 1)}`;
}
