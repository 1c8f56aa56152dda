// The kept ticks as the tables that `asperity render` writes and reads.

import { COLUMNS, WIDTH } from "./ring.js";
import { shortest } from "./shortest.js";

export const RENDERED = ["tick", "t_s", ...COLUMNS, "flags"].join(",");
export const TRAJECTORY = ["t_s", "x_mm", "y_mm", "z_mm"].join(",");

/** Rows joined at once: one string of half a million rows would be copied over and over. */
const ROWS = 4096;

function table(header, ring, row) {
  const parts = [header];
  for (let from = ring.first; from < ring.end; from += ROWS) {
    const rows = [];
    for (let tick = from; tick < Math.min(from + ROWS, ring.end); tick++) rows.push(row(tick));
    parts.push(rows.join("\n"));
  }
  return parts.join("\n") + "\n";
}

/** What was rendered: the table of `asperity render`, to the byte where the run began at tick 0. */
export function renderedCsv(ring, tick_hz) {
  return table(RENDERED, ring, (tick) => {
    const slot = tick % ring.capacity;
    let text = `${tick},${tick / tick_hz}`;
    for (let k = 0; k < WIDTH; k++) text += `,${shortest(ring.columns[WIDTH * slot + k])}`;
    return `${text},${ring.flags[slot]}`;
  });
}

/** Where the hand was. Positions have all digits of the float, because the runtime divides them
 * before it rounds: the shortest ones would not always give its bits. */
export function trajectoryCsv(ring, tick_hz) {
  return table(TRAJECTORY, ring, (tick) => {
    const [x, y, z] = [0, 1, 2].map((axis) => ring.position(tick, axis));
    return `${tick / tick_hz},${x},${y},${z}`;
  });
}
