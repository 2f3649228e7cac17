import { within, type Range } from "../layout/Layout";

/** Of the field above the panels where the page is narrow [percent]. */
export const kFieldHeight: Range = { least: 20, most: 80, usual: 46, step: 3 };

/** A size that was kept, or the usual one instead of anything else. */
export function kept(value: unknown, range: Range): number {
  return typeof value === "number" && Number.isFinite(value) ? within(value, range) : range.usual;
}
