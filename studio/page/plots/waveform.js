// The last tenth of a second of vibration and tap.

import { axes, clipped } from "./axes.js";
import { Figure } from "./figure.js";
import { COLUMN } from "./ring.js";
import { Span } from "./scale.js";

const WINDOW_S = 0.1;
/** Half the axis, m/s², at least: less is silence. */
const LEAST_M_S2 = 0.1;

export class Waveform extends Figure {
  least_s = 1 / 30;
  span = new Span(LEAST_M_S2);

  draw(ctx, now_s) {
    const { ring, now, inspect } = this.scope;
    const ticks = this.scope.ticks(WINDOW_S);
    const [from, to] = ring.kept(now - ticks, now);
    const per_n = inspect?.gains.effective_mass_kg > 0 ? 1 / inspect.gains.effective_mass_kg : 0;
    let [peak, squares] = [0, 0];
    for (let tick = from; tick < to; tick++) {
      const [vib, tap] = [ring.at(tick, COLUMN.vib_m_s2), ring.at(tick, COLUMN.tap_n) * per_n];
      peak = Math.max(peak, Math.abs(vib), Math.abs(tap));
      squares += vib * vib;
    }
    const end = this.span.follow(peak, now_s);
    const placed = this.layer(ctx, "axes", `${end}`, (on) =>
      axes(on, this, { low: -1000 * WINDOW_S, high: 0, title: this.texts.time_axis },
        { low: -end, high: end, title: this.texts.acceleration_axis }));
    const { accent, accent_2 } = this.stage.palette;
    clipped(ctx, placed.box, () => {
      this.#line(ctx, placed, from, to, COLUMN.vib_m_s2, 1, accent);
      this.#line(ctx, placed, from, to, COLUMN.tap_n, per_n, accent_2);
    });
    this.shown = to > from ? { peak_m_s2: peak, rms_m_s2: Math.sqrt(squares / (to - from)) } : null;
    this.read(() => (this.shown ? this.texts.loudness(this.shown) : ""), now_s);
  }

  #line(ctx, { x, y }, from, to, column, factor, colour) {
    const { ring, now, tick_hz } = this.scope;
    ctx.beginPath();
    // A tap that is not there is not drawn over the vibration.
    let sounds = false;
    for (let tick = from; tick < to; tick++) {
      const value = factor * ring.at(tick, column);
      sounds ||= value !== 0;
      ctx.lineTo(x((1000 * (tick - now)) / tick_hz), y(value));
    }
    if (!sounds) return;
    ctx.strokeStyle = colour;
    ctx.lineWidth = 1.25;
    ctx.stroke();
    ctx.lineWidth = 1;
  }

  summary() {
    return [this.title, this.shown ? this.texts.loudness(this.shown) : this.texts.silent].join(". ");
  }
}
