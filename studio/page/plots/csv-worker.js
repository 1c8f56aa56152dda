// Writes a table of `csv.js` apart from the page. Messages: { ticks }, how many it keeps; { part }, some of them; then
// { table, tick_hz }, which is answered with a Blob.

import { renderedCsv, trajectoryCsv } from "./csv.js";
import { Ring } from "./ring.js";

const TABLES = { rendered: renderedCsv, trajectory: trajectoryCsv };
let ring;

onmessage = ({ data: { ticks, part, table, tick_hz } }) => {
  if (ticks) ring = new Ring(ticks);
  else if (part) ring.add(part);
  else postMessage(new Blob([TABLES[table](ring, tick_hz)], { type: "text/csv" }));
};
