// Writes a table of `csv.js` apart from the page, and answers with a Blob.

import { renderedCsv, trajectoryCsv } from "./csv.js";
import { Ring } from "./ring.js";

const TABLES = { rendered: renderedCsv, trajectory: trajectoryCsv };

onmessage = ({ data: { table, ring, tick_hz } }) =>
  postMessage(new Blob([TABLES[table](Ring.of(ring), tick_hz)], { type: "text/csv" }));
