// Friction over normal force, with the coefficient of the texture as a line.

import { axes, clipped } from "./axes.js";
import { Figure } from "./figure.js";
import { COLUMN, FLAG } from "./ring.js";
import { Span } from "./scale.js";

const WINDOW_S = 2;
/** Distance of two dots, s. */
const STEP_S = 0.005;
const FADES = 4;
const LEAST_N = 1;

/** The least and the greatest coefficient, over all speeds that a law has. */
export function coefficients({ mu, law }) {
  const factors = law ? law.points.map(({ factor }) => factor) : [1];
  return [mu * Math.min(...factors), mu * Math.max(...factors)];
}

export class Friction extends Figure {
  least_s = 1 / 30;
  normal = new Span(LEAST_N);
  tangential = new Span(LEAST_N / 2);

  draw(ctx, now_s) {
    const { ring, now, inspect } = this.scope;
    const step = Math.max(1, this.scope.ticks(STEP_S));
    const [from, to] = ring.kept(now - this.scope.ticks(WINDOW_S), now);
    const dots = [];
    for (let tick = step * Math.ceil(from / step); tick < to; tick += step) {
      if (ring.flagsAt(tick) & FLAG.contact)
        dots.push([ring.at(tick, COLUMN.normal_force_n), ring.at(tick, COLUMN.friction_n), tick]);
    }
    const most = (k) => dots.reduce((most, dot) => Math.max(most, dot[k]), 0);
    const normal_n = this.normal.follow(most(0), now_s);
    const [least_mu, most_mu] = inspect ? coefficients(inspect.friction) : [0, 0];
    const tangential_n = this.tangential.follow(Math.max(most(1), 0.9 * most_mu * normal_n), now_s);
    const key = [normal_n, tangential_n, least_mu, most_mu].join("|");
    const placed = this.layer(ctx, "axes", key, (on) => this.#axes(on, normal_n, tangential_n, [least_mu, most_mu]));
    this.#dots(ctx, placed, dots, from, to);
    const hand = this.scope.hand;
    this.shown = null;
    if (hand?.touches) {
      const friction_n = ring.at(now - 1, COLUMN.friction_n);
      this.shown = { friction_n, normal_n: hand.force_n, ratio: hand.force_n > 0 ? friction_n / hand.force_n : 0 };
    }
    this.read(() => (this.shown ? this.texts.ratio(this.shown) : ""), now_s);
  }

  #axes(ctx, normal_n, tangential_n, [least_mu, most_mu]) {
    const placed = axes(ctx, this, { low: 0, high: normal_n, title: this.texts.normal_axis },
      { low: 0, high: tangential_n, title: this.texts.friction_axis });
    const { box, x, y } = placed;
    const { palette } = this.stage;
    if (!(most_mu > 0)) return placed;
    clipped(ctx, box, () => {
      ctx.fillStyle = ctx.strokeStyle = palette.accent_2;
      ctx.lineWidth = 2;
      for (const mu of new Set([least_mu, most_mu])) {
        ctx.beginPath();
        ctx.moveTo(x(0), y(0));
        ctx.lineTo(x(normal_n), y(mu * normal_n));
        ctx.stroke();
      }
      ctx.globalAlpha = 0.2;
      ctx.beginPath();
      ctx.moveTo(x(0), y(0));
      ctx.lineTo(x(normal_n), y(least_mu * normal_n));
      ctx.lineTo(x(normal_n), y(most_mu * normal_n));
      ctx.fill();
      ctx.globalAlpha = 1;
    });
    ctx.fillStyle = palette.ink;
    ctx.textAlign = "left";
    ctx.fillText(this.texts.coefficient(least_mu, most_mu), box.left + 8, box.top + 12);
    return placed;
  }

  #dots(ctx, { box, x, y }, dots, from, to) {
    const { palette } = this.stage;
    clipped(ctx, box, () => {
      ctx.fillStyle = palette.accent;
      for (const [normal_n, friction_n, tick] of dots) {
        const age = Math.floor((FADES * (tick - from)) / (to - from));
        ctx.globalAlpha = (0.6 * (age + 1)) / FADES;
        ctx.fillRect(x(normal_n) - 1.5, y(friction_n) - 1.5, 3, 3);
      }
      ctx.globalAlpha = 1;
      const last = dots.at(-1);
      if (!last || !this.scope.hand?.touches) return;
      ctx.beginPath();
      ctx.arc(x(last[0]), y(last[1]), 5, 0, 2 * Math.PI);
      ctx.fill();
      ctx.strokeStyle = palette.paper;
      ctx.lineWidth = 2;
      ctx.stroke();
      ctx.lineWidth = 1;
    });
  }

  summary() {
    const { inspect } = this.scope;
    const parts = [this.title, this.shown ? this.texts.ratio(this.shown) : this.texts.silent];
    if (inspect) parts.push(this.texts.coefficient(...coefficients(inspect.friction)));
    return parts.join(". ");
  }
}
