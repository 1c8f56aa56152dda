// A strip of the last ten seconds, a lane for each of five numbers, as least and greatest values.

import { axes, clipped } from "./axes.js";
import { Figure } from "./figure.js";
import { BLOCK, COLUMN } from "./ring.js";
import { Span } from "./scale.js";

const WINDOW_S = 10;
/** A column of the picture, CSS pixels, as near as whole blocks of ticks come to it. */
const COLUMN_PX = 2;
const AXIS_PX = 32;
/** Keys scroll by so much, s. */
const KEYS_S = { ArrowLeft: -0.1, ArrowRight: 0.1, PageUp: -2, PageDown: 2, Home: -Infinity, End: Infinity };

/** The lanes: what they show, and half or the whole of an axis at least. */
const LANES = [
  { name: "speed", column: COLUMN.speed_mm_s, least: 50 },
  { name: "force", column: COLUMN.normal_force_n, least: 0.5 },
  { name: "vibration", column: COLUMN.vib_m_s2, least: 0.5, signed: true },
  { name: "tap", column: COLUMN.tap_n, least: 0.2, signed: true },
  { name: "friction", column: COLUMN.friction_n, least: 0.5 },
];

export class Strip extends Figure {
  least_s = 1 / 60;
  lanes = LANES.map((lane) => ({ signed: false, ...lane, span: new Span(lane.least), range: null, end: lane.least }));

  /** `scrolled` is called when keys or a pointer showed another moment. */
  constructor(stage, name, texts, scrolled) {
    super(stage, name, texts);
    this.scrolled = scrolled;
    this.#listen();
  }

  draw(ctx, now_s) {
    const { ring, now } = this.scope;
    const ticks = this.scope.ticks(WINDOW_S);
    const [from, to] = ring.kept(now - ticks, now);
    for (const lane of this.lanes) {
      lane.range = ring.extremes(lane.column, from, to);
      const [low, high] = lane.range ?? [0, 0];
      lane.end = lane.span.follow(Math.max(high, lane.signed ? -low : 0), now_s);
    }
    const placed = this.layer(ctx, "axes", this.lanes.map(({ end }) => end).join("|"), (on) => this.#axes(on));
    const { left, right } = placed[0].box;
    // Columns begin at multiples of their width: what is drawn of a tick does not change as it moves.
    const width = BLOCK * Math.max(1, Math.round((ticks * COLUMN_PX) / (right - left) / BLOCK));
    this.lanes.forEach((lane, n) => {
      clipped(ctx, placed[n].box, () => this.#envelope(ctx, placed[n], lane, width, [from, to], now));
    });
    if (this.cursor !== undefined) this.#cursor(ctx, placed);
    this.placed = placed;
    this.read(() => this.#text(), now_s);
  }

  #axes(ctx) {
    const lane_px = (this.height - AXIS_PX) / this.lanes.length;
    // Numbers of all lanes stand in the room of the widest one.
    const widest = ({ end, signed }) => ctx.measureText(`${signed ? "−" : ""}${end}`).width;
    const left = Math.max(...this.lanes.map(widest));
    return this.lanes.map(({ name, end, signed }, n) => {
      const last = n === this.lanes.length - 1;
      const area = { left: 0, top: n * lane_px, right: this.width, bottom: (n + 1) * lane_px + (last ? AXIS_PX : 0) };
      return axes(ctx, this, { low: -WINDOW_S, high: 0, every: 1, title: last ? this.texts.time_axis : "", bare: !last },
        { low: signed ? -end : 0, high: end, title: this.texts.lanes[name], ends: true }, { area, left, frame: false });
    });
  }

  /** The area between the least and the greatest values of columns, a pixel high at least. */
  #envelope(ctx, { x, y }, { column, range }, width, [from, to], now) {
    if (!range) return;
    const { ring, tick_hz } = this.scope;
    const lower = [];
    ctx.beginPath();
    for (let tick = width * Math.floor(from / width); tick < to; tick += width) {
      const found = ring.extremes(column, tick, tick + width);
      if (found === null) continue;
      const at = x((tick + width / 2 - now) / tick_hz);
      ctx.lineTo(at, y(found[1]) - 0.75);
      lower.push(at, y(found[0]) + 0.75);
    }
    for (let n = lower.length - 2; n >= 0; n -= 2) ctx.lineTo(lower[n], lower[n + 1]);
    ctx.fillStyle = this.stage.palette.accent;
    ctx.fill();
  }

  #cursor(ctx, placed) {
    ctx.strokeStyle = this.stage.palette.ink;
    ctx.beginPath();
    ctx.moveTo(this.cursor + 0.5, placed[0].box.top);
    ctx.lineTo(this.cursor + 0.5, placed.at(-1).box.bottom);
    ctx.stroke();
  }

  #text() {
    const { frozen, now, tick_hz } = this.scope;
    const at = this.#pointed();
    if (at) return this.texts.at(at);
    return frozen ? this.texts.frozen(now / tick_hz) : this.texts.running(now / tick_hz);
  }

  /** What the lanes have under the pointer. */
  #pointed() {
    if (this.cursor === undefined || !this.placed) return null;
    const { ring, now, tick_hz } = this.scope;
    const { left, right } = this.placed[0].box;
    const tick = Math.round(now - 1 + ((this.cursor - right) / (right - left)) * this.scope.ticks(WINDOW_S));
    if (!ring.has(tick)) return null;
    return {
      t_s: tick / tick_hz,
      ...Object.fromEntries(LANES.map(({ name, column }) => [name, ring.at(tick, column)])),
    };
  }

  #listen() {
    const { canvas } = this;
    let dragged = null;
    const point = (offset) => {
      const box = this.placed?.[0].box;
      this.cursor = box && offset >= box.left && offset <= box.right ? Math.round(offset) : undefined;
      this.read_s = -Infinity;
      this.invalidate();
    };
    canvas.addEventListener("pointerdown", (event) => {
      if (!this.scope.frozen) return;
      dragged = event.offsetX;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (dragged !== null && this.placed) {
        const { left, right } = this.placed[0].box;
        this.#scroll(((dragged - event.offsetX) / (right - left)) * WINDOW_S);
        dragged = event.offsetX;
      }
      point(event.offsetX);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => (dragged = null));
    canvas.addEventListener("pointerleave", () => point(-1));
    canvas.addEventListener("keydown", (event) => {
      const by_s = KEYS_S[event.key];
      if (by_s === undefined || !this.scope.frozen) return;
      event.preventDefault();
      this.#scroll(by_s);
    });
  }

  #scroll(by_s) {
    this.scope.scroll(this.scope.now + by_s * this.scope.tick_hz);
    this.scrolled();
  }

  summary() {
    const found = Object.fromEntries(this.lanes.map(({ name, range }) => [name, range ?? null]));
    return [this.title, this.texts.ranges(found)].join(". ");
  }
}
