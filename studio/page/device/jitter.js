// How late the servo loop woke in the last ten seconds: a histogram over decades of microseconds.

import { element } from "../dom.js";
import { texts } from "../texts.js";

const KEPT_S = 10;
/** Bins from 0.1 µs to 100 ms, 8 a decade. */
const [LOW, HIGH, BINS] = [-1, 5, 48];
const HEIGHT_PX = 72;
const FOOT_PX = 16;
/** @type {[number, string][]} */
const LABELS = [[0, "1 µs"], [1, "10"], [2, "100"], [3, "1 ms"], [4, "10"]];

export const binOf = (us) => {
  const at = ((Math.log10(Math.max(us, 1e-9)) - LOW) / (HIGH - LOW)) * BINS;
  return Math.min(Math.max(Math.floor(at), 0), BINS - 1);
};

export class Jitter {
  element = element("canvas", { class: "jitter", role: "img", "aria-label": texts.device.jitter });
  #counts = new Float64Array(BINS);
  /** Bins of the ticks that are kept, a ring. */
  #bins;
  #at = 0;
  #kept = 0;

  constructor(rate_hz) {
    this.#bins = new Uint8Array(KEPT_S * rate_hz);
    new ResizeObserver(() => this.draw()).observe(this.element);
  }

  add(wakeup_us) {
    for (const us of wakeup_us) {
      if (this.#kept === this.#bins.length) this.#counts[this.#bins[this.#at]]--;
      else this.#kept++;
      const bin = binOf(us);
      this.#bins[this.#at] = bin;
      this.#counts[bin]++;
      this.#at = (this.#at + 1) % this.#bins.length;
    }
  }

  draw() {
    const { element: canvas } = this;
    const pixels = devicePixelRatio;
    const width = canvas.clientWidth;
    if (width === 0) return;
    [canvas.width, canvas.height] = [Math.round(width * pixels), Math.round(HEIGHT_PX * pixels)];
    const style = getComputedStyle(canvas);
    const ctx = canvas.getContext("2d");
    ctx.scale(pixels, pixels);
    const floor = HEIGHT_PX - FOOT_PX;
    // One tick among thousands is what one looks for, so counts are logarithmic.
    const most = Math.log1p(Math.max(1, ...this.#counts));
    const step = width / BINS;
    ctx.fillStyle = style.color;
    this.#counts.forEach((count, bin) => {
      const height = count > 0 ? Math.max((Math.log1p(count) / most) * (floor - 2), 2) : 0;
      ctx.fillRect(bin * step + 0.5, floor - height, Math.max(step - 1, 1), height);
    });
    // Variables of two themes are resolved in properties alone.
    ctx.fillStyle = style.borderTopColor;
    ctx.fillRect(0, floor, width, 1);
    ctx.font = style.font;
    ctx.textAlign = "center";
    for (const [decade, label] of LABELS) ctx.fillText(label, ((decade - LOW) / (HIGH - LOW)) * width, HEIGHT_PX - 3);
  }
}
