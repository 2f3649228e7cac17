const kRaised = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** So many times: 30, 10000, 10¹⁹. */
function times(ratio: number): string {
  if (ratio < 1000) return String(Number(ratio.toPrecision(2)));
  const power = Math.round(Math.log10(ratio));
  return power < 6 ? String(10 ** power) : `10${[...String(power)].map((digit) => kRaised[Number(digit)]).join("")}`;
}

/**
 * What a probability of readings comes to, which by itself says little: products of many are small even at the right place.
 * @param p of the readings at a place; negative: nothing is known of it
 * @param best the greatest p of the field; null: it is not known
 */
export function inWords(p: number, best: number | null): string {
  if (p < 0) return "No feature has a reading that says anything here.";
  if (best === null || !(best > 0)) {
    return p > 0 ? "Show a map of p to compare it with the best place of the field." : "Impossible: too small for a number.";
  }
  if (p <= 0) return "Impossible beside the best place of the field.";
  const ratio = best / p;
  if (ratio < 0.5) return "More probable than the middle of any cell of the map at its best heading.";
  if (ratio < 2) return "About as probable as the best place of the field.";
  if (ratio < 100) return `Possible: ${times(ratio)} times less probable than the best place of the field.`;
  if (ratio < 1e6) return `Improbable: ${times(ratio)} times less probable than the best place of the field.`;
  return `Practically ruled out: ${times(ratio)} times less probable than the best place of the field.`;
}
