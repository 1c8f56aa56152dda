// The power of a model: (gain·σ)²·|B|²/|A|², whose mean over all frequencies is the variance of the
// vibration, and the level of it that a hand feels.

import { squaredMagnitudes } from "./lsf.js";

/** What lies below is motion of the hand: where `rough_db` of an asset begins, Hz. */
export const FLOOR_HZ = 40;
/** Spacing of frequencies with which the compiler sums a level, Hz. */
const FINE_HZ = 0.25;
/** Frequencies that are enough for a picture of many levels. */
const COARSE_POINTS = 128;

export const decibels = (power) => 10 * Math.log10(power);

/** (gain·σ)²·|B|²/|A|² of a model of `grid` at angles whose cosines are `cs`, (m/s²)². */
function powers(grid, model, cs) {
  const below = squaredMagnitudes(model.ar, cs);
  const above =
    grid.numerator === "lsf"
      ? squaredMagnitudes(model.ma, cs)
      : grid.numerator === "nyquist"
        ? cs.map((c) => 2 * (1 + c))
        : cs.map(() => 1);
  const variance = model.level_m_s2 * model.level_m_s2;
  return above.map((x, n) => (variance * x) / below[n]);
}

/** Density of a model on one side of the spectrum at frequencies up to half the rate, (m/s²)²/Hz. */
export function densities(grid, model, freqs_hz) {
  const per_hz = 2 / grid.rate_hz;
  const cs = Float64Array.from(freqs_hz, (freq_hz) => Math.cos((2 * Math.PI * freq_hz) / grid.rate_hz));
  return powers(grid, model, cs).map((power) => per_hz * power);
}

/** The band above [`FLOOR_HZ`] of the models of a grid. */
export class Band {
  /** `fine` sums with the steps of the compiler; else few are taken, for a picture. */
  constructor(grid, fine) {
    this.grid = grid;
    const width_hz = Math.max(0.5 * grid.rate_hz - FLOOR_HZ, 0);
    const points = fine ? Math.ceil(width_hz / FINE_HZ) : Math.min(COARSE_POINTS, Math.ceil(width_hz));
    const step_hz = width_hz / points;
    this.share = (2 * step_hz) / grid.rate_hz;
    this.cosines = Float64Array.from({ length: points }, (_, n) =>
      Math.cos((2 * Math.PI * (FLOOR_HZ + (n + 0.5) * step_hz)) / grid.rate_hz),
    );
  }

  /** The level of a model, dB re 1 (m/s²)²; −∞ where it is silent. */
  level_db(model) {
    if (!(model.level_m_s2 > 0)) return -Infinity;
    const sum = powers(this.grid, model, this.cosines).reduce((sum, power) => sum + power, 0);
    return decibels(sum * this.share);
  }
}
