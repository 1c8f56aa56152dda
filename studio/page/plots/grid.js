// The speed–force grid of a texture: which triangle a query falls into, and what is mixed there.
//
// As in the runtime, a query outside the measured range is moved to the nearest point of its border,
// where edge models answer; the triangle whose smallest barycentric weight is largest wins, and
// weights below zero are cut. cos ω and gain·σ are mixed linearly.

import { cosines } from "./lsf.js";

/** Numbers of a triangle: its first corner, and the slopes of the weights of the other two. */
const NUMBERS = 6;

export class Grid {
  /** From `ar` of `asperity inspect --json`. */
  constructor(ar) {
    this.order = ar.order;
    this.rate_hz = ar.sample_rate_hz;
    this.numerator = ar.numerator;
    this.max_speed_mm_s = ar.max_speed_mm_s;
    this.max_force_n = ar.max_force_n;
    this.triangles = ar.triangles;
    this.vertices = ar.vertices.map(({ speed_mm_s, force_n, kind, lsf_rad, ma_lsf_rad, gain = 1, sigma_m_s2 }) => ({
      speed_mm_s,
      force_n,
      kind,
      level_m_s2: gain * sigma_m_s2,
      ar: cosines(lsf_rad),
      ma: cosines(ma_lsf_rad ?? []),
    }));
    this.rows = Float64Array.from(
      ar.triangles.flatMap((corners) => this.#row(corners.map((vertex) => this.vertices[vertex]))),
    );
  }

  #row([p, q, r]) {
    const [qs, qf] = [q.speed_mm_s - p.speed_mm_s, q.force_n - p.force_n];
    const [rs, rf] = [r.speed_mm_s - p.speed_mm_s, r.force_n - p.force_n];
    const twice_area = qs * rf - rs * qf;
    const slopes = [rf, -rs, -qf, qs].map((x) => (twice_area === 0 ? NaN : x / twice_area));
    return [p.speed_mm_s, p.force_n, ...slopes];
  }

  /** Whether an edge model answers a query because it lies beyond the measured range. */
  isOutside(speed_mm_s, force_n) {
    return !(speed_mm_s <= this.max_speed_mm_s && force_n <= this.max_force_n);
  }

  /** The nearest point of the measured range; NaN counts as rest. */
  nearest(speed_mm_s, force_n) {
    const within = (x, most) => (x > 0 ? Math.min(x, most) : 0);
    return [within(speed_mm_s, this.max_speed_mm_s), within(force_n, this.max_force_n)];
  }

  /** The three vertices around a query and their weights: not negative, of sum 1. */
  locate(speed_mm_s, force_n) {
    const [speed, force] = this.nearest(speed_mm_s, force_n);
    const { rows } = this;
    let [best, smallest] = [-1, -Infinity];
    for (let at = 0; at < rows.length; at += NUMBERS) {
      const ds = speed - rows[at];
      const df = force - rows[at + 1];
      const wq = rows[at + 2] * ds + rows[at + 3] * df;
      const wr = rows[at + 4] * ds + rows[at + 5] * df;
      const least = Math.min(1 - wq - wr, wq, wr);
      // A triangle without area has NaN, and is never larger.
      if (least > smallest) [best, smallest] = [at, least];
    }
    if (best < 0) throw new RangeError("no triangle of the grid has an area");
    const [ds, df] = [speed - rows[best], force - rows[best + 1]];
    const wq = Math.max(rows[best + 2] * ds + rows[best + 3] * df, 0);
    const wr = Math.max(rows[best + 4] * ds + rows[best + 5] * df, 0);
    const wp = Math.max(1 - (rows[best + 2] + rows[best + 4]) * ds - (rows[best + 3] + rows[best + 5]) * df, 0);
    const sum = wp + wq + wr;
    return { vertices: this.triangles[best / NUMBERS], weights: [wp / sum, wq / sum, wr / sum] };
  }

  /** The model at a speed and a force. */
  modelAt(speed_mm_s, force_n) {
    const { vertices, weights } = this.locate(speed_mm_s, force_n);
    const corners = vertices.map((vertex) => this.vertices[vertex]);
    const mixed = (side) => {
      const sum = new Float64Array(corners[0][side].length);
      corners.forEach((corner, n) => {
        for (let k = 0; k < sum.length; k++) sum[k] += weights[n] * corner[side][k];
      });
      return sum;
    };
    const level_m_s2 = corners.reduce((sum, corner, n) => sum + weights[n] * corner.level_m_s2, 0);
    return { ar: mixed("ar"), ma: mixed("ma"), level_m_s2 };
  }
}
