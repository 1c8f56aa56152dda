// The speed × force plane: the level of the vibration wherever the hand may go, the models that it
// is mixed from, and the hand itself.

import { axes, clipped } from "./axes.js";
import { Figure } from "./figure.js";
import { colourBar, contour, fieldPicture } from "./field.js";
import { FLOOR_HZ } from "./models.js";
import { FLAG } from "./ring.js";
import { PlanePointer } from "./plane-pointer.js";

const TRAIL_S = 1.5;
/** Distance of two points of the trail, s. */
const STEP_S = 0.01;
/** The trail fades in so many steps. */
const FADES = 10;
/** Room right of the plane: a mark of the hand outside, the colour bar, its numbers. */
const RIGHT_PX = 70;
const CONTOUR_DB = 5;
/** What is drawn on the field shows on every colour of it in this pair. */
const [LIGHT, DARK] = ["#fff", "rgb(0 0 0 / 75%)"];

/** Strokes the path in a dark colour and, narrower, in a light one: [colour, width] each. */
function strokeTwice(ctx, ...strokes) {
  for (const [colour, width] of strokes) {
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.stroke();
  }
  ctx.lineWidth = 1;
}

export class Plane extends Figure {
  placed = null;

  constructor(stage, name, texts, chosen) {
    const contour = texts.legend.contour({ every_db: CONTOUR_DB, floor_hz: FLOOR_HZ });
    super(stage, name, { ...texts, legend: { ...texts.legend, contour } });
    this.pointer = new PlanePointer(this, chosen);
  }

  draw(ctx, now_s) {
    const { hand, chosen, models } = this.scope;
    if (!models) return this.read(() => "", now_s);
    this.placed = this.layer(ctx, "field", `${this.version}`, (on) => this.#field(on, models));
    const { box, x, y } = this.placed;
    this.#trail(ctx);
    if (chosen) this.#cross(ctx, box, x(chosen.speed_mm_s), y(chosen.force_n));
    if (hand) this.#hand(ctx, models, hand);
    this.read(() => this.#text(), now_s);
  }

  /** A new texture. */
  renew() {
    this.version = (this.version ?? 0) + 1;
    this.pointer.leave();
    this.invalidate();
  }

  #field(ctx, models) {
    const { palette } = this.stage;
    const placed = axes(ctx, this, { low: 0, high: models.max_speed_mm_s, title: this.texts.speed_axis },
      { low: 0, high: models.max_force_n, title: this.texts.force_axis }, { right: RIGHT_PX, grid: false, frame: false });
    const { box } = placed;
    const [width, height] = [box.right - box.left, box.bottom - box.top];
    const picture = fieldPicture(models, Math.ceil(width / 2), Math.ceil(height / 2));
    ctx.imageSmoothingQuality = "high";
    ctx.drawImage(picture, box.left, box.top, width, height);
    clipped(ctx, box, () => this.#contours(ctx, models, placed));
    colourBar(ctx, palette, models, box, CONTOUR_DB);
    ctx.fillStyle = palette.ink;
    ctx.textAlign = "right";
    ctx.fillText(this.texts.level_axis, this.width, box.top - 10);
    this.#mesh(ctx, models, placed);
    ctx.strokeStyle = palette.ink;
    ctx.lineWidth = 1.5;
    ctx.strokeRect(box.left, box.top, width, height);
    return placed;
  }

  #contours(ctx, models, { box }) {
    const across = (box.right - box.left) / (models.columns - 1);
    const down = (box.bottom - box.top) / (models.rows - 1);
    ctx.beginPath();
    for (let db = models.low_db + CONTOUR_DB; db < models.high_db; db += CONTOUR_DB) {
      for (const [x0, y0, x1, y1] of contour(models.rms_m_s2, models.columns, 10 ** (db / 20))) {
        ctx.moveTo(box.left + across * x0, box.bottom - down * y0);
        ctx.lineTo(box.left + across * x1, box.bottom - down * y1);
      }
    }
    ctx.strokeStyle = "rgb(0 0 0 / 50%)";
    ctx.stroke();
  }

  #mesh(ctx, { vertices, triangles }, { x, y }) {
    const at = (vertex) => [x(vertices[vertex].speed_mm_s), y(vertices[vertex].force_n)];
    ctx.beginPath();
    const drawn = new Set();
    for (const triangle of triangles) {
      triangle.forEach((from, n) => {
        const to = triangle[(n + 1) % 3];
        const key = from < to ? `${from} ${to}` : `${to} ${from}`;
        if (drawn.has(key)) return;
        drawn.add(key);
        ctx.moveTo(...at(from));
        ctx.lineTo(...at(to));
      });
    }
    strokeTwice(ctx, ["rgb(0 0 0 / 30%)", 2.5], ["rgb(255 255 255 / 80%)", 1]);
    for (const [vertex, { kind }] of vertices.entries()) {
      const [px, py] = at(vertex);
      const inner = kind === "interior";
      ctx.beginPath();
      if (inner) ctx.arc(px, py, 4, 0, 2 * Math.PI);
      else ctx.rect(px - 2.5, py - 2.5, 5, 5);
      [ctx.fillStyle, ctx.strokeStyle] = inner ? [LIGHT, DARK] : [DARK, LIGHT];
      ctx.fill();
      ctx.stroke();
    }
  }

  /** Where the hand was, fainter the longer ago. */
  #trail(ctx) {
    const { ring, now } = this.scope;
    const step = Math.max(1, this.scope.ticks(STEP_S));
    const [from, to] = ring.kept(now - this.scope.ticks(TRAIL_S), now);
    const points = [];
    // Points stay where they are while time passes: they lie on multiples of the step.
    for (let tick = step * Math.ceil(from / step); tick < to; tick += step) {
      const touches = (ring.flagsAt(tick) & FLAG.contact) !== 0;
      points.push(touches ? this.#at(ring.query(tick)) : null);
    }
    for (let fade = 0; fade < FADES; fade++) {
      ctx.beginPath();
      const last = Math.floor((points.length * (fade + 1)) / FADES);
      for (let n = Math.floor((points.length * fade) / FADES); n < last && n + 1 < points.length; n++) {
        if (points[n] === null || points[n + 1] === null) continue;
        ctx.moveTo(...points[n]);
        ctx.lineTo(...points[n + 1]);
      }
      const strength = (fade + 1) / FADES;
      strokeTwice(ctx, [`rgb(0 0 0 / ${70 * strength}%)`, 4], [`rgb(255 255 255 / ${100 * strength}%)`, 2]);
    }
  }

  #at(query) {
    const { speed_mm_s, force_n } = this.scope.models.nearest(query);
    return [this.placed.x(speed_mm_s), this.placed.y(force_n)];
  }

  #hand(ctx, models, hand) {
    const { palette } = this.stage;
    const { touches } = hand;
    const [px, py] = this.#at(hand);
    if (touches && hand.speed_mm_s > models.max_speed_mm_s) this.#arrow(ctx, px, py, 1, 0);
    if (touches && hand.force_n > models.max_force_n) this.#arrow(ctx, px, py, 0, -1);
    ctx.beginPath();
    ctx.arc(px, py, 7, 0, 2 * Math.PI);
    ctx.fillStyle = touches ? palette.accent : palette.paper;
    ctx.fill();
    strokeTwice(ctx, ["#000", 4], ["#fff", 2]);
  }

  /** An arrow out of the plane: the hand is beyond, and the edge model at its foot answers. */
  #arrow(ctx, px, py, dx, dy) {
    const [bx, by] = [px + 9 * dx, py + 9 * dy];
    ctx.beginPath();
    ctx.moveTo(bx + 7 * dx, by + 7 * dy);
    ctx.lineTo(bx + 6 * dy, by - 6 * dx);
    ctx.lineTo(bx - 6 * dy, by + 6 * dx);
    ctx.closePath();
    ctx.fillStyle = this.stage.palette.ink;
    ctx.fill();
  }

  #cross(ctx, box, px, py) {
    ctx.beginPath();
    ctx.moveTo(px, box.top);
    ctx.lineTo(px, box.bottom);
    ctx.moveTo(box.left, py);
    ctx.lineTo(box.right, py);
    ctx.moveTo(px + 6, py);
    ctx.arc(px, py, 6, 0, 2 * Math.PI);
    strokeTwice(ctx, ["#000", 3], ["#fff", 1]);
  }

  #text() {
    const { models, hand, chosen } = this.scope;
    if (chosen) return this.texts.chosen(this.#facts(chosen));
    if (!hand) return this.texts.no_hand;
    if (!hand.touches) return this.texts.lifted(hand);
    return this.texts.hand({ ...this.#facts(hand), outside: models.isOutside(hand) });
  }

  #facts({ speed_mm_s, force_n, vertex }) {
    const { models } = this.scope;
    return { speed_mm_s, force_n, level_db: models.level_db({ speed_mm_s, force_n }), kind: models.vertices[vertex]?.kind };
  }

  summary() {
    const { models } = this.scope;
    if (!models) return `${this.title}. ${this.texts.no_texture}`;
    const interior = models.vertices.filter(({ kind }) => kind === "interior").length;
    const about = this.texts.about(models, { interior, edge: models.vertices.length - interior });
    return [this.title, this.#text(), about].join(". ");
  }
}
