// How a hand explores a surface, counted from the ticks of the renderer or of a device.

import { COLUMN, FLAG, WIDTH } from "../page/plots/ring.js";

/** Edges of the bins of time in contact; the last ones have no end. */
const SPEEDS_MM_S = [40, 80, 120, 160, 200];
const FORCES_N = [0.5, 1, 1.5, 2, 3];
const COLUMNS = FORCES_N.length + 1;
/** A stroke goes so far, mm; where the hand has turned back by some millimetres, the next one begins. */
const STROKE_MM = 10;
const TURN_MM = 3;
/** A tap stays where it is and is short. */
const TAP_MM = 3;
const TAP_S = 1;
/** A hand that is lifted for less has bounced, s. */
const BOUNCE_S = 0.02;

const apart = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);
const bin = (edges, value) => edges.findLastIndex((edge) => value >= edge) + 1;

export class Exploration {
  strokes = 0;
  taps = 0;
  #rate_hz;
  /** Ticks in contact, row by row of speed. */
  #bins = new Uint32Array((SPEEDS_MM_S.length + 1) * COLUMNS);
  /** Of the contact that lasts: its ticks, how far a stroke of it went, and ticks since it was lifted. */
  #ticks = 0;
  #farthest_mm = 0;
  #lifted = 0;
  /** Where its last stroke began, and the place that is farthest from there. */
  #start_mm = [0, 0];
  #far_mm = [0, 0];

  constructor(rate_hz) {
    this.#rate_hz = rate_hz;
  }

  get contact_s() {
    return this.#bins.reduce((sum, ticks) => sum + ticks, 0) / this.#rate_hz;
  }

  /** Takes a message of ticks. */
  add({ positions_mm, columns, flags }) {
    for (let n = 0; n < flags.length; n++) {
      if (flags[n] & FLAG.contact) {
        const [speed_mm_s, force_n] = ["speed_mm_s", "normal_force_n"].map((name) => columns[n * WIDTH + COLUMN[name]]);
        this.#bins[bin(SPEEDS_MM_S, speed_mm_s) * COLUMNS + bin(FORCES_N, force_n)]++;
        this.#touch([positions_mm[3 * n], positions_mm[3 * n + 1]]);
      } else if (this.#ticks > 0 && ++this.#lifted > BOUNCE_S * this.#rate_hz) this.#lift();
    }
  }

  /** As the server takes it. */
  counts() {
    const seconds = (ticks) => Math.round((1e4 * ticks) / this.#rate_hz) / 1e4;
    const { strokes, taps, contact_s } = this;
    return { strokes, taps, contact_s: Math.round(1e4 * contact_s) / 1e4, exploration: Array.from(this.#bins, seconds) };
  }

  #touch(at_mm) {
    if (this.#ticks === 0) this.#start_mm = this.#far_mm = at_mm;
    this.#ticks++;
    this.#lifted = 0;
    const [far, now] = [apart(this.#start_mm, this.#far_mm), apart(this.#start_mm, at_mm)];
    if (now > far) {
      this.#far_mm = at_mm;
      this.#farthest_mm = Math.max(this.#farthest_mm, now);
      if (far < STROKE_MM && now >= STROKE_MM) this.strokes++;
    } else if (now < far - TURN_MM) {
      this.#start_mm = this.#far_mm;
      this.#far_mm = at_mm;
    }
  }

  #lift() {
    if (this.#farthest_mm < TAP_MM && this.#ticks < TAP_S * this.#rate_hz) this.taps++;
    this.#ticks = this.#lifted = this.#farthest_mm = 0;
  }
}
