// The force on the hand as a vector, from above and from the side.

import { axes, clipped } from "./axes.js";
import { Figure } from "./figure.js";
import { COLUMN } from "./ring.js";
import { Span } from "./scale.js";

/** The arrow is a mean over this, so that the vibration does not shake it; the dots show that, s. */
const MEAN_S = 0.02;
const CLOUD_S = 0.1;
const DOTS = 100;
/** Half an axis, N, at least. */
const LEAST_N = 0.5;
const BETWEEN_PX = 14;

export class Force extends Figure {
  least_s = 1 / 30;
  span = new Span(LEAST_N);

  draw(ctx, now_s) {
    const { ring, now, inspect } = this.scope;
    const columns = [COLUMN.fx_n, COLUMN.fy_n, COLUMN.fz_n];
    const mean = columns.map((column) => ring.moments(column, now - this.scope.ticks(MEAN_S), now).mean);
    const [from, to] = ring.kept(now - this.scope.ticks(CLOUD_S), now);
    const step = Math.max(1, Math.round(this.scope.ticks(CLOUD_S) / DOTS));
    const dots = [];
    for (let tick = step * Math.ceil(from / step); tick < to; tick += step)
      dots.push(columns.map((column) => ring.at(tick, column)));
    const reach = (/** @type {number[]} */ [x, y, z]) => Math.max(Math.abs(x), Math.abs(y), z / 1.5, -2 * z);
    const end = this.span.follow(dots.reduce((most, dot) => Math.max(most, reach(dot)), reach(mean)), now_s);
    const limit_n = inspect?.gains.f_max_n;
    const [top, side] = this.layer(ctx, "axes", `${end}|${limit_n}`, (on) => this.#axes(on, end, limit_n));
    this.#arrow(ctx, top, dots, mean, 1);
    this.#arrow(ctx, side, dots, mean, 2);
    this.shown = to > from ? { fx_n: mean[0], fy_n: mean[1], fz_n: mean[2] } : null;
    this.read(() => (this.shown ? this.texts.force(this.shown) : ""), now_s);
  }

  #axes(ctx, end, limit_n) {
    const half = (this.width - BETWEEN_PX) / 2;
    const area = (left) => ({ left, top: 0, right: left + half, bottom: this.height });
    const across = { low: -end, high: end, title: this.texts.x_axis };
    const top = axes(ctx, this, across, { low: -end, high: end, title: this.texts.y_axis }, { area: area(0), equal: true });
    // As long as the other one, from half below the surface on: the wall pushes upwards.
    const side = axes(ctx, this, across, { low: -0.5 * end, high: 1.5 * end, title: this.texts.z_axis },
      { area: area(half + BETWEEN_PX), equal: true });
    const { palette } = this.stage;
    ctx.strokeStyle = palette.muted;
    for (const { box, x, y } of [top, side]) {
      clipped(ctx, box, () => {
        ctx.beginPath();
        ctx.moveTo(box.left, y(0));
        ctx.lineTo(box.right, y(0));
        ctx.moveTo(x(0), box.top);
        ctx.lineTo(x(0), box.bottom);
        ctx.stroke();
        if (!(limit_n > 0)) return;
        ctx.setLineDash([4, 4]);
        ctx.beginPath();
        ctx.ellipse(x(0), y(0), x(limit_n) - x(0), y(0) - y(limit_n), 0, 0, 2 * Math.PI);
        ctx.stroke();
        ctx.setLineDash([]);
      });
    }
    return [top, side];
  }

  /** Dots of single ticks and the arrow of their mean; `up` is the component upwards. */
  #arrow(ctx, { box, x, y }, dots, mean, up) {
    const { palette } = this.stage;
    clipped(ctx, box, () => {
      ctx.fillStyle = palette.accent;
      ctx.globalAlpha = 0.3;
      for (const dot of dots) ctx.fillRect(x(dot[0]) - 1.5, y(dot[up]) - 1.5, 3, 3);
      ctx.globalAlpha = 1;
      const [fx, fy, tx, ty] = [x(0), y(0), x(mean[0]), y(mean[up])];
      const length = Math.hypot(tx - fx, ty - fy);
      if (length < 2) return;
      const [dx, dy] = [(tx - fx) / length, (ty - fy) / length];
      const head = Math.min(10, length);
      ctx.strokeStyle = ctx.fillStyle = palette.ink;
      ctx.lineWidth = 2.5;
      ctx.beginPath();
      ctx.moveTo(fx, fy);
      ctx.lineTo(tx - 0.8 * head * dx, ty - 0.8 * head * dy);
      ctx.stroke();
      ctx.beginPath();
      ctx.moveTo(tx, ty);
      ctx.lineTo(tx - head * dx + 0.45 * head * dy, ty - head * dy - 0.45 * head * dx);
      ctx.lineTo(tx - head * dx - 0.45 * head * dy, ty - head * dy + 0.45 * head * dx);
      ctx.fill();
      ctx.lineWidth = 1;
    });
  }

  summary() {
    return [this.title, this.shown ? this.texts.force(this.shown) : this.texts.silent].join(". ");
  }
}
