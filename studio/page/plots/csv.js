// The kept ticks as the tables that `asperity render` writes and reads. A worker of this file writes them apart from the page;
// it takes { ticks }, how many it keeps; { part }, some of them; then { table, tick_hz }, which it answers with a Blob.

import { COLUMNS, Ring, WIDTH } from "./ring.js";

export const RENDERED = ["tick", "t_s", ...COLUMNS, "flags"].join(",");

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

/**
 * The table of `asperity render`, to the byte where the run began at tick 0. `runtime` has the exports of `asperity.wasm`, which
 * prints floats as the command does.
 */
export function renderedCsv(ring, tick_hz, runtime) {
  const { buffer } = runtime.memory;
  const numbers = new Float32Array(buffer, runtime.buffer_columns(), WIDTH);
  const decoder = new TextDecoder();
  return table(RENDERED, ring, (tick) => {
    const slot = tick % ring.capacity;
    numbers.set(ring.columns.subarray(WIDTH * slot, WIDTH * (slot + 1)));
    const text = new Uint8Array(buffer, runtime.buffer_row(), runtime.print_row());
    return `${tick},${tick / tick_hz},${decoder.decode(text)},${ring.flags[slot]}`;
  });
}

/** Where the hand was. Positions have all digits of the float, because the runtime divides them
 * before it rounds: the shortest ones would not always give its bits. */
export function trajectoryCsv(ring, tick_hz) {
  return table("t_s,x_mm,y_mm,z_mm", ring, (tick) =>
    [tick / tick_hz, ...[0, 1, 2].map((axis) => ring.position(tick, axis))].join(","));
}

let kept;

async function written(name, tick_hz) {
  if (name === "trajectory") return trajectoryCsv(kept, tick_hz);
  const module = await fetch(new URL("../asperity.wasm", location.href));
  const { instance } = await WebAssembly.instantiate(await module.arrayBuffer());
  return renderedCsv(kept, tick_hz, instance.exports);
}

globalThis.onmessage = ({ data: { ticks, part, table, tick_hz } }) => {
  if (ticks) kept = new Ring(ticks);
  else if (part) kept.add(part);
  else written(table, tick_hz).then((text) => postMessage(new Blob([text], { type: "text/csv" })), reportError);
};
