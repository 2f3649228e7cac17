/** How far an edge can be moved, and how far one press of a key moves it. */
export interface Range {
  least: number;
  most: number;
  usual: number;
  step: number;
}

/** Of the panels beside the field [pixels]. */
export const kSideWidth: Range = { least: 260, most: 900, usual: 372, step: 20 };
/** Of the field above the panels [percent]. */
export const kFieldHeight: Range = { least: 20, most: 80, usual: 46, step: 3 };

export function within(value: number, { least, most }: Range): number {
  return Math.round(Math.min(most, Math.max(least, value)));
}

/** A size that was kept, or the usual one instead of anything else. */
export function kept(value: unknown, range: Range): number {
  return typeof value === "number" && Number.isFinite(value) ? within(value, range) : range.usual;
}
