// The level of the vibration over the whole plane, sampled on a lattice, a few points at a time.

import { Band, decibels } from "./level.js";
import { Grid } from "./grid.js";

const COLUMNS = 65;
const ROWS = 49;
/** Colours begin at the level that this share of the plane stays below, within limits, dB. */
const QUIET_SHARE = 0.04;
const WIDEST_DB = 40;
const ROUND_DB = 5;

export class Levels {
  constructor(ar) {
    this.grid = new Grid(ar);
    this.columns = COLUMNS;
    this.rows = ROWS;
    /** Root mean squares, m/s², in rows of ascending force: they vary more evenly than levels. */
    this.rms_m_s2 = new Float64Array(COLUMNS * ROWS);
    this.done = 0;
    this.fine = new Band(this.grid, true);
    this.coarse = new Band(this.grid, false);
  }

  get isComplete() {
    return this.done === this.rms_m_s2.length;
  }

  /** Goes on until `until_ms` on the clock `clock_ms`. Returns whether the lattice is complete. */
  advance(until_ms, clock_ms) {
    const { grid, coarse } = this;
    while (!this.isComplete && clock_ms() < until_ms) {
      const [column, row] = [this.done % COLUMNS, Math.floor(this.done / COLUMNS)];
      const speed = (column / (COLUMNS - 1)) * grid.max_speed_mm_s;
      const force = (row / (ROWS - 1)) * grid.max_force_n;
      this.rms_m_s2[this.done++] = 10 ** (coarse.level_db(grid.modelAt(speed, force)) / 20);
      if (this.isComplete) this.#range();
    }
    return this.isComplete;
  }

  /** The levels that colours stand for, round numbers. */
  #range() {
    const sorted = Float64Array.from(this.rms_m_s2).sort();
    const level = (share) => decibels(sorted[Math.round(share * (sorted.length - 1))] ** 2);
    const loudest_db = level(1);
    this.high_db = Number.isFinite(loudest_db) ? ROUND_DB * Math.ceil(loudest_db / ROUND_DB) : 0;
    const quiet_db = ROUND_DB * Math.floor(level(QUIET_SHARE) / ROUND_DB);
    this.low_db = Math.min(Math.max(quiet_db, this.high_db - WIDEST_DB), this.high_db - 2 * ROUND_DB);
  }

  /** The level at a point, with the compiler's precision, dB re 1 (m/s²)². */
  level_db(speed_mm_s, force_n) {
    return this.fine.level_db(this.grid.modelAt(speed_mm_s, force_n));
  }

  /** The root mean square between the points of the lattice, for shares 0..=1 of both axes. */
  between(speed_share, force_share) {
    const [x, y] = [speed_share * (COLUMNS - 1), force_share * (ROWS - 1)];
    const [column, row] = [Math.min(Math.floor(x), COLUMNS - 2), Math.min(Math.floor(y), ROWS - 2)];
    const [tx, ty] = [x - column, y - row];
    const at = (c, r) => this.rms_m_s2[(row + r) * COLUMNS + column + c];
    return (1 - ty) * ((1 - tx) * at(0, 0) + tx * at(1, 0)) + ty * ((1 - tx) * at(0, 1) + tx * at(1, 1));
  }
}

const known = new WeakMap();

/** The levels of a texture, kept as long as its description is. */
export function levelsOf(inspect) {
  if (!known.has(inspect.ar)) known.set(inspect.ar, new Levels(inspect.ar));
  return known.get(inspect.ar);
}
