// The models of a texture over speed and force: where they lie, and what the runtime mixes between them.

/** Motion of the hand lies below, Hz (`worklet/src/spectrum.rs`). */
export const FLOOR_HZ = 40;
/** The lattice of levels. */
const [COLUMNS, ROWS] = [65, 49];
/** Frequencies of a level: in the picture, and where it is read. */
const [COARSE, FINE] = [128, 2048];
/** Colours begin at the level that this share of the plane stays below, within limits, dB. */
const QUIET_SHARE = 0.04;
const WIDEST_DB = 40;
const ROUND_DB = 5;

export const decibels = (power) => 10 * Math.log10(power);

export class Models {
  vertices; triangles; max_speed_mm_s; max_force_n; rate_hz;
  #runtime;

  /** `runtime` has the exports of `asperity.wasm`, which loads `asset`; `ar` is of `asperity inspect --json`. */
  constructor(runtime, asset, { vertices, triangles, max_speed_mm_s, max_force_n }) {
    const bytes = new Uint8Array(asset).subarray(0, runtime.asset_capacity());
    new Uint8Array(runtime.memory.buffer, runtime.buffer_asset(), bytes.length).set(bytes);
    const status = runtime.load(bytes.length, 0, 0);
    if (status !== 0) throw new Error(`the runtime refuses the texture with status ${status}; compile it again`);
    this.#runtime = runtime;
    Object.assign(this, { vertices, triangles, max_speed_mm_s, max_force_n, rate_hz: runtime.model_rate_hz() });
    this.#sample();
  }

  /** Root mean squares on the lattice, m/s², in rows of ascending force: they vary more evenly than levels. */
  #sample() {
    this.columns = COLUMNS;
    this.rows = ROWS;
    this.rms_m_s2 = Float64Array.from({ length: COLUMNS * ROWS }, (_, n) => Math.sqrt(this.#power({
      speed_mm_s: ((n % COLUMNS) / (COLUMNS - 1)) * this.max_speed_mm_s,
      force_n: (Math.floor(n / COLUMNS) / (ROWS - 1)) * this.max_force_n,
    }, COARSE)));
    // The levels that colours stand for, round numbers.
    const sorted = this.rms_m_s2.toSorted();
    const level = (share) => decibels(sorted[Math.round(share * (sorted.length - 1))] ** 2);
    const loudest_db = level(1);
    this.high_db = Number.isFinite(loudest_db) ? ROUND_DB * Math.ceil(loudest_db / ROUND_DB) : 0;
    const quiet_db = ROUND_DB * Math.floor(level(QUIET_SHARE) / ROUND_DB);
    this.low_db = Math.min(Math.max(quiet_db, this.high_db - WIDEST_DB), this.high_db - 2 * ROUND_DB);
  }

  #power({ speed_mm_s, force_n }, points) {
    this.#runtime.mix(speed_mm_s, force_n);
    return this.#runtime.power(points);
  }

  /** The level of the vibration above [`FLOOR_HZ`], dB re 1 (m/s²)²; −∞ where it is silent. */
  level_db(at) {
    return decibels(this.#power(at, FINE));
  }

  /** Power density on one side at frequencies up to half the rate, (m/s²)²/Hz. */
  densities({ speed_mm_s, force_n }, freqs_hz) {
    this.#runtime.mix(speed_mm_s, force_n);
    return freqs_hz.map((freq_hz) => this.#runtime.density(freq_hz));
  }

  /** The root mean square between the points of the lattice, for shares 0..=1 of both axes. */
  between(speed_share, force_share) {
    const [x, y] = [speed_share * (COLUMNS - 1), force_share * (ROWS - 1)];
    const [column, row] = [Math.min(Math.floor(x), COLUMNS - 2), Math.min(Math.floor(y), ROWS - 2)];
    const [tx, ty] = [x - column, y - row];
    const at = (c, r) => this.rms_m_s2[(row + r) * COLUMNS + column + c];
    return (1 - ty) * ((1 - tx) * at(0, 0) + tx * at(1, 0)) + ty * ((1 - tx) * at(0, 1) + tx * at(1, 1));
  }

  /** Whether an edge model answers a query because it lies beyond the measured range. */
  isOutside({ speed_mm_s, force_n }) {
    return !(speed_mm_s <= this.max_speed_mm_s && force_n <= this.max_force_n);
  }

  /** The nearest point of the measured range; NaN counts as rest. */
  nearest({ speed_mm_s, force_n }) {
    const within = (x, most) => (x > 0 ? Math.min(x, most) : 0);
    return { speed_mm_s: within(speed_mm_s, this.max_speed_mm_s), force_n: within(force_n, this.max_force_n) };
  }
}
