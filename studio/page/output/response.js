// The drawn response of the equaliser, with a mark for each band.

import { texts } from "../texts.js";
import { BANDS, MOST_DB, responseOf } from "./equaliser.js";
import { HIGH_HZ, LOW_HZ } from "./modes.js";

const own = texts.output;
const [WIDTH, HEIGHT] = [272, 116];
const BOX = { left: 26, right: 266, top: 6, bottom: 98 };
/** Room above the largest gain of one band. */
const SPAN_DB = MOST_DB + 3;
const POINTS = 97;
const MARKS_HZ = [20, 50, 100, 200, 500];
const MARKS_DB = [-12, 0, 12];

const x = (hz) => BOX.left + ((BOX.right - BOX.left) * Math.log(hz / LOW_HZ)) / Math.log(HIGH_HZ / LOW_HZ);
const y = (db) => (BOX.top + BOX.bottom) / 2 - (db * (BOX.bottom - BOX.top)) / (2 * SPAN_DB);
const FREQUENCIES_HZ = Array.from({ length: POINTS }, (_, n) => LOW_HZ * (HIGH_HZ / LOW_HZ) ** (n / (POINTS - 1)));

function shape(tag, attributes, text = "") {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
}

function frame() {
  const { left, right, top, bottom } = BOX;
  const lines = [...MARKS_HZ.map((hz) => `M${x(hz)} ${top}V${bottom}`), ...MARKS_DB.map((db) => `M${left} ${y(db)}H${right}`)];
  return [shape("path", { class: "grid", d: lines.join("") }),
    ...MARKS_HZ.map((hz) => shape("text", { x: Math.min(x(hz), right - 3), y: HEIGHT - 5, "text-anchor": "middle" }, `${hz}`)),
    ...MARKS_DB.map((db) => shape("text", { x: left - 5, y: y(db) + 3.5, "text-anchor": "end" }, own.gain(db).split(" ")[0]))];
}

export class Response {
  #curve = shape("path", { class: "curve" });
  #bands = BANDS.map(({ frequency }) => shape("circle", { cx: x(frequency), r: 3 }));
  #tone = shape("path", { class: "tone" });
  element = shape("svg", { class: "response", role: "img", viewBox: `0 0 ${WIDTH} ${HEIGHT}` });

  constructor() {
    this.element.append(...frame(), this.#tone, this.#curve, ...this.#bands);
  }

  show(gains_db, on) {
    const points = Array.from(responseOf(gains_db, FREQUENCIES_HZ), (db, n) =>
      `${x(FREQUENCIES_HZ[n]).toFixed(2)} ${y(Math.min(Math.max(db, -SPAN_DB), SPAN_DB)).toFixed(2)}`);
    this.#curve.setAttribute("d", `M${points.join("L")}`);
    this.#bands.forEach((mark, n) => mark.setAttribute("cy", y(gains_db[n])));
    this.element.classList.toggle("off", !on);
    this.element.setAttribute("aria-label",
      own.response(BANDS.map(({ frequency }, n) => `${own.band(frequency)} ${own.gain(gains_db[n])}`).join(", ")));
  }

  /** Marks the tone that plays; null takes the mark away. */
  mark(hz) {
    this.#tone.setAttribute("d", hz === null ? "" : `M${x(hz)} ${BOX.top}V${BOX.bottom}`);
  }
}
