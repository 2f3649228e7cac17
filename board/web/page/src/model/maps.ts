/** A map of values over the field: one byte a cell, rows from the lowest y on; 0: not open. */
export interface Heat {
  columns: number;
  rows: number;
  x: number;
  y: number;
  step: number;
  cells: Uint8Array;
}

/** What features should read: values by their number, in metres or radians. */
export type Expected = Map<string, Map<number, number>>;
