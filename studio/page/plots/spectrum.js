// The spectrum of what the hand feels now, before the one that the model promises there.

import { axes, clipped } from "./axes.js";
import { Fft } from "./fft.js";
import { Figure } from "./figure.js";
import { decibels } from "./models.js";
import { FLAG } from "./ring.js";
import { Span } from "./scale.js";

const WINDOW_S = 0.5;
/** Powers follow with this time constant, s. */
const SMOOTH_S = 0.3;
const LOW_HZ = 10;
const HIGH_HZ = 1000;
/** A point of the curve is a mean over this many octaves, or a bin. */
const OCTAVES = 1 / 24;
const POINT_PX = 2;
/** Moments of the window at which the model is asked. */
const MOMENTS = 8;
const DEPTH_DB = 70;
const ROUND_DB = 10;
const upTo10 = (db) => ROUND_DB * Math.ceil((db + 3) / ROUND_DB);

export class Spectrum extends Figure {
  /** Spectra a second, at most. */
  least_s = 1 / 20;
  last_s = -Infinity;

  /** A new texture or another rate: the transform, the loudest model, and how far the frequencies go. */
  renew() {
    const { models, tick_hz } = this.scope;
    if (!models) return;
    const size = 2 ** Math.round(Math.log2(WINDOW_S * tick_hz));
    if (this.fft?.size !== size) {
      this.fft = new Fft(size);
      this.signal = new Float64Array(size);
      this.powers = new Float64Array(size / 2 + 1);
      this.smooth = new Float64Array(size / 2 + 1);
    }
    const nyquist_hz = 0.5 * models.rate_hz;
    this.high_hz = Math.max(HIGH_HZ, nyquist_hz);
    const some_hz = Array.from({ length: 64 }, (_, n) => LOW_HZ * (nyquist_hz / LOW_HZ) ** (n / 63));
    const loudest = Math.max(...models.vertices.map((vertex) => Math.max(...models.densities(vertex, some_hz))));
    this.top = new Span(loudest > 0 ? upTo10(decibels(loudest)) - ROUND_DB : 0, upTo10);
    this.promise = null;
    this.version = (this.version ?? 0) + 1;
    this.invalidate();
  }

  draw(ctx, now_s) {
    const { models, chosen } = this.scope;
    if (!models) return this.read(() => "", now_s);
    this.#measure(now_s);
    const [first, last] = [Math.ceil(LOW_HZ / this.#bin_hz), Math.floor(this.high_hz / this.#bin_hz)];
    let strongest = first;
    for (let k = first; k <= last; k++) if (this.smooth[k] > this.smooth[strongest]) strongest = k;
    const power = this.smooth[strongest];
    const top_db = this.top.follow(power > 0 ? decibels(power) : -Infinity, now_s);
    const placed = this.layer(ctx, "axes", `${this.version}|${top_db}`, (on) => this.#axes(on, top_db));
    const points = this.#points(placed);
    const half_hz = 0.5 * models.rate_hz;
    const of_model = points.filter(({ freq_hz }) => freq_hz <= half_hz);
    const freqs_hz = of_model.map(({ freq_hz }) => freq_hz);
    const expected = this.#expected(models, freqs_hz);
    clipped(ctx, placed.box, () => {
      if (expected) this.#area(ctx, placed, of_model, expected);
      const { accent, accent_2 } = this.stage.palette;
      this.#line(ctx, placed, points, points.map((point) => this.#mean(point)), accent, 1.5);
      if (chosen) this.#line(ctx, placed, of_model, models.densities(chosen, freqs_hz), accent_2, 2);
    });
    this.shown = power > 0 ? { freq_hz: strongest * this.#bin_hz, density_db: decibels(power) } : null;
    if (expected) {
      const most = expected.reduce((best, x, n) => (x > expected[best] ? n : best), 0);
      this.promised = { freq_hz: freqs_hz[most], density_db: decibels(expected[most]) };
    } else this.promised = null;
    this.read(() => (this.shown ? this.texts.strongest(this.shown) : this.texts.silent), now_s);
  }

  get #bin_hz() {
    return this.scope.tick_hz / this.fft.size;
  }

  /** The spectrum of the last half second, zeros before the first tick. */
  #measure(now_s) {
    const { scope, fft, signal } = this;
    const begin = scope.now - fft.size;
    for (let n = 0; n < fft.size; n++) signal[n] = scope.ring.has(begin + n) ? scope.acceleration(begin + n) : 0;
    fft.density(signal, scope.tick_hz, this.powers);
    this.share = scope.frozen ? 1 : 1 - Math.exp(-(now_s - this.last_s) / SMOOTH_S);
    for (let k = 0; k < this.smooth.length; k++) this.smooth[k] += this.share * (this.powers[k] - this.smooth[k]);
    this.last_s = now_s;
  }

  #axes(ctx, top_db) {
    const low_db = top_db - DEPTH_DB;
    const placed = axes(ctx, this, { low: LOW_HZ, high: this.high_hz, log: true, title: this.texts.frequency_axis },
      { low: low_db, high: top_db, title: this.texts.density_axis, every: ROUND_DB });
    const nyquist_hz = 0.5 * this.scope.models.rate_hz;
    const { box, x } = placed;
    ctx.strokeStyle = ctx.fillStyle = this.stage.palette.muted;
    ctx.setLineDash([2, 3]);
    ctx.beginPath();
    ctx.moveTo(x(nyquist_hz), box.top);
    ctx.lineTo(x(nyquist_hz), box.bottom);
    ctx.stroke();
    ctx.setLineDash([]);
    ctx.textAlign = "right";
    ctx.fillText(this.texts.model_ends, Math.min(x(nyquist_hz), box.right) - 4, box.top + 10);
    return { ...placed, low_db };
  }

  /** The points of a curve, with the bins that each is a mean of. */
  #points({ box }) {
    const count = Math.max(2, Math.round((box.right - box.left) / POINT_PX));
    const key = `${count}|${this.high_hz}|${this.#bin_hz}`;
    if (this.points_key === key) return this.points;
    this.points_key = key;
    const ratio = this.high_hz / LOW_HZ;
    const width = Math.max(ratio ** (0.5 / count), 2 ** (OCTAVES / 2));
    this.points = Array.from({ length: count + 1 }, (_, n) => {
      const freq_hz = LOW_HZ * ratio ** (n / count);
      const place = freq_hz / this.#bin_hz;
      return { freq_hz, place, from: Math.ceil(place / width), to: Math.floor(place * width) };
    });
    return this.points;
  }

  #mean({ place, from, to }) {
    if (to - from < 1) {
      const k = Math.floor(place);
      return this.smooth[k] + (place - k) * (this.smooth[k + 1] - this.smooth[k]);
    }
    let sum = 0;
    for (let k = from; k <= to; k++) sum += this.smooth[k];
    return sum / (to - from + 1);
  }

  /** What the models promise over the window, weighted and smoothed as the measured powers are; null where nothing
   * was touched. */
  #expected(models, freqs_hz) {
    const { ring, now } = this.scope;
    if (this.promise?.length !== freqs_hz.length) this.promise = new Float64Array(freqs_hz.length);
    const sum = new Float64Array(freqs_hz.length);
    let [touched, whole] = [0, 0];
    for (let n = 0; n < MOMENTS; n++) {
      const share = (n + 0.5) / MOMENTS;
      const weight = Math.sin(Math.PI * share) ** 4;
      whole += weight;
      const tick = now - 1 - Math.round(share * this.fft.size);
      if (!ring.has(tick) || !(ring.flagsAt(tick) & FLAG.contact)) continue;
      touched++;
      models.densities(ring.query(tick), freqs_hz).forEach((density, k) => (sum[k] += weight * density));
    }
    this.promise.forEach((before, k) => (this.promise[k] += this.share * (sum[k] / whole - before)));
    return touched > 0 ? this.promise : null;
  }

  #path(ctx, { x, y, low_db }, points, powers) {
    powers.forEach((power, n) => {
      const at = [x(points[n].freq_hz), y(Math.max(decibels(power), low_db - ROUND_DB))];
      if (n === 0) ctx.moveTo(...at);
      else ctx.lineTo(...at);
    });
  }

  #line(ctx, placed, points, powers, colour, width) {
    ctx.beginPath();
    this.#path(ctx, placed, points, powers);
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.stroke();
    ctx.lineWidth = 1;
  }

  #area(ctx, placed, points, powers) {
    const { x, box } = placed;
    ctx.fillStyle = ctx.strokeStyle = this.stage.palette.muted;
    ctx.beginPath();
    this.#path(ctx, placed, points, powers);
    ctx.stroke();
    ctx.lineTo(x(points.at(-1).freq_hz), box.bottom);
    ctx.lineTo(x(points[0].freq_hz), box.bottom);
    ctx.globalAlpha = 0.22;
    ctx.fill();
    ctx.globalAlpha = 1;
  }

  summary() {
    const parts = [this.title, this.shown ? this.texts.strongest(this.shown) : this.texts.silent];
    if (this.promised) parts.push(this.texts.expected(this.promised));
    return parts.join(". ");
  }
}
