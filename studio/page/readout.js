// Numbers of the moving hand, and the level meter.

import { element, find } from "./dom.js";
import { COLUMN, WIDTH } from "./plots/ring.js";
import { texts } from "./texts.js";

const SHOWN = ["speed", "force", "depth", "friction", "vibration"];
const FLOOR_DB = -60;
/** The peak that is shown falls by so much a second, dB. */
const FALL_DB_S = 24;
const LAMP_MS = 400;

/** Means over the ticks of a message while the hand touches; RMS of the vibration. */
export function meansOf({ columns }) {
  const ticks = columns.length / WIDTH;
  const column = (name, n) => columns[n * WIDTH + COLUMN[name]];
  const sums = { speed: 0, force: 0, depth: 0, friction: 0, vibration: 0 };
  let touching = 0;
  for (let n = 0; n < ticks; n++) {
    if (column("depth_mm", n) <= 0) continue;
    touching++;
    sums.speed += column("speed_mm_s", n);
    sums.force += column("normal_force_n", n);
    sums.depth += column("depth_mm", n);
    sums.friction += Math.abs(column("friction_n", n));
    sums.vibration += column("vib_m_s2", n) ** 2;
  }
  if (touching === 0) return null;
  return { speed: sums.speed / touching, force: sums.force / touching, depth: sums.depth / touching,
    friction: sums.friction / touching, vibration: Math.sqrt(sums.vibration / touching) };
}

export class Readout {
  #values = {};

  constructor() {
    find("readout").replaceChildren(...SHOWN.map((name) => {
      this.#values[name] = element("span", { class: "value" }, texts.readout.none);
      return element("div", { "data-name": name }, element("dt", {}, texts.readout[name]),
        element("dd", {}, this.#values[name], " ", element("span", { class: "unit" }, texts.readout[`${name}_unit`])));
    }));
  }

  /** Shows numbers by their names; what is missing or not known shows as a dash. */
  show(numbers) {
    for (const name of SHOWN) {
      const value = numbers?.[name];
      const text = Number.isFinite(value) ? texts.readout[`${name === "friction" ? "force" : name}_text`](value) : texts.readout.none;
      if (this.#values[name].textContent !== text) this.#values[name].textContent = text;
    }
  }
}

const toDb = (x) => Math.max(20 * Math.log10(Math.max(x, 1e-9)), FLOOR_DB);

export class Meter {
  #peak_db = FLOOR_DB;
  #at_ms = 0;
  #said_ms = 0;
  #lamp = null;

  /** `measure` gives peak and RMS in full scales. */
  constructor(measure) {
    this.measure = measure;
    this.running = false;
  }

  set on(on) {
    if (on === this.running) return;
    this.running = on;
    if (on) requestAnimationFrame((now_ms) => this.#frame(now_ms));
    else this.#show(FLOOR_DB, FLOOR_DB);
  }

  /** The limiter holds peaks back. */
  limits() {
    const lamp = find("limiting");
    lamp.textContent = texts.sound.limiting;
    clearTimeout(this.#lamp);
    this.#lamp = setTimeout(() => (lamp.textContent = ""), LAMP_MS);
  }

  #frame(now_ms) {
    if (!this.running) return;
    const { peak, rms } = this.measure();
    const fallen_db = this.#peak_db - (FALL_DB_S * Math.max(now_ms - this.#at_ms, 0)) / 1000;
    this.#at_ms = now_ms;
    this.#peak_db = Math.max(toDb(peak), fallen_db, FLOOR_DB);
    this.#show(this.#peak_db, toDb(rms));
    requestAnimationFrame((next_ms) => this.#frame(next_ms));
  }

  #show(peak_db, rms_db) {
    const meter = find("meter");
    const share = (db) => (db - FLOOR_DB) / -FLOOR_DB;
    meter.querySelector(".rms").style.transform = `scaleX(${share(rms_db)})`;
    meter.querySelector(".peak").style.left = `${100 * share(peak_db)}%`;
    // Text that changes by every frame cannot be read.
    const now_ms = performance.now();
    if (this.running && now_ms - this.#said_ms < 250) return;
    this.#said_ms = now_ms;
    const text = this.running ? texts.sound.meter_text(peak_db) : "";
    meter.setAttribute("aria-valuenow", peak_db.toFixed(0));
    meter.setAttribute("aria-valuetext", texts.sound.meter_text(peak_db));
    find("meter-text").textContent = text;
  }
}
