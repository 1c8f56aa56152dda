// What orders the textures of a library: the attributes, each as a number that grows with its name.

import { texts } from "../texts.js";

/** `column` of the server's table; `log`: a frequency is heard in ratios; `sign`: what slips has less friction. */
export const ATTRIBUTES = [
  { name: "rough", column: "rough_db", sign: 1, log: false },
  { name: "sharp", column: "sharp_hz", sign: 1, log: true },
  { name: "hard", column: "hard_hz", sign: 1, log: true },
  { name: "slippery", column: "mu", sign: -1, log: false },
];

/** A value of an attribute with its unit. */
export const valueText = ({ name }, value) =>
  Number.isFinite(value) ? texts.gallery.value[name](value) : texts.gallery.undefined;

/** The values of a column; NaN where a texture defines none. */
export const valuesOf = ({ column, sign }, columns) =>
  Float64Array.from(columns[column], (value) => (value === null ? NaN : sign * value));

/** The least and the greatest value, or `null` where there is none. */
export function endsOf(values) {
  const known = values.filter(Number.isFinite);
  return known.length === 0 ? null
    : known.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
}
