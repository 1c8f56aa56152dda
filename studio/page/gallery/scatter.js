// Every texture of a library as a point between two attributes.

import { announce, element } from "../dom.js";
import { axes } from "../plots/axes.js";
import { Figure } from "../plots/figure.js";
import { Stage } from "../plots/stage.js";
import { texts } from "../texts.js";
import { ATTRIBUTES, valueText } from "./attributes.js";

/** How near the pointer must be, px. */
const NEAR_PX = 14;
const POINT_PX = 3;
/** Few points show their pictures, of this size. */
const MOST_PICTURES = 60;
const PICTURE_PX = 28;
const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** An axis with room around its values. */
function axisOf(attribute, ends) {
  let [low, high] = ends ?? [1, 2];
  if (low === high) [low, high] = attribute.log ? [low / 1.2, high * 1.2] : [low - 1, high + 1];
  const room = (high - low) * 0.05;
  const wide = (high / low) ** 0.05;
  const title = texts.gallery.axes[attribute.name];
  return attribute.log ? { low: low / wide, high: high * wide, log: true, title } : { low: low - room, high: high + room, title };
}

class Points extends Figure {
  #library = null;
  #places = [];
  #version = 0;
  #placed = null;
  #chosen = null;
  #at = null;
  /** By place, as they arrive. */
  #pictures = new Map();

  constructor(stage, pick, address) {
    super(stage, "scatter", texts.gallery.scatter);
    this.pick = pick;
    this.address = address;
    this.attributes = [ATTRIBUTES[0], ATTRIBUTES[2]];
    this.canvas.setAttribute("role", "application");
    this.canvas.addEventListener("pointermove", (event) => this.#point(event));
    this.canvas.addEventListener("pointerleave", () => this.#reach(null));
    this.canvas.addEventListener("blur", () => this.#reach(null));
    this.canvas.addEventListener("click", (event) => {
      this.#point(event);
      if (this.#at !== null) this.pick(this.#at);
    });
    // Before the figure's own keys: Enter picks here.
    this.canvas.addEventListener("keydown", (event) => this.#key(event), { capture: true });
  }

  show(library, places) {
    if (library !== this.#library) this.#pictures.clear();
    this.#library = library;
    this.#places = places;
    this.#at = null;
    this.renew();
  }

  renew() {
    this.#version++;
    this.invalidate();
  }

  choose(place) {
    this.#chosen = place;
    this.invalidate();
  }

  summary() {
    return texts.gallery.scatter.about(this.#places.length, ...this.attributes.map(({ name }) => texts.gallery.attributes[name]));
  }

  draw(ctx) {
    if (!this.#library) return;
    this.#placed = this.layer(ctx, "points", this.#version, (on) => this.#points(on));
    const { palette } = this.stage;
    const ring = (place, radius, color) => {
      const [x, y] = this.#placed.of(place);
      if (Number.isNaN(x + y)) return;
      ctx.beginPath();
      ctx.arc(x, y, radius, 0, 2 * Math.PI);
      ctx.fillStyle = palette.paper;
      ctx.fill();
      ctx.lineWidth = 2.5;
      ctx.strokeStyle = color;
      ctx.stroke();
    };
    if (this.#chosen !== null) ring(this.#chosen, 6, palette.accent_2);
    if (this.#at === null) return;
    ring(this.#at, 4.5, palette.ink);
    this.#label(ctx, this.#at);
  }

  #points(on) {
    const [across, up] = this.attributes;
    const [xs, ys] = this.attributes.map(({ name }) => this.#library.values[name]);
    const { box, x, y } = axes(on, this, ...[across, up].map((attribute) => axisOf(attribute, this.#library.ends[attribute.name])));
    const of = (place) => [x(xs[place]), y(ys[place])];
    const dots = (places, color, alpha) => {
      on.globalAlpha = alpha;
      on.fillStyle = color;
      for (const place of places) {
        const [left, top] = of(place);
        if (!Number.isNaN(left + top)) on.fillRect(left - POINT_PX / 2, top - POINT_PX / 2, POINT_PX, POINT_PX);
      }
      on.globalAlpha = 1;
    };
    const shown = new Set(this.#places);
    if (shown.size < this.#library.count) {
      dots(Array.from({ length: this.#library.count }, (_, place) => place).filter((place) => !shown.has(place)),
        this.stage.palette.grid, 1);
    }
    if (this.#places.length <= MOST_PICTURES) {
      for (const place of this.#places) this.#picture(on, place, of(place));
      return { box, of };
    }
    // Many points show where they are dense.
    dots(this.#places, this.stage.palette.accent, this.#places.length > 2000 ? 0.5 : 0.85);
    return { box, of };
  }

  /** A texture's picture at its point, as soon as it is there. */
  #picture(on, place, /** @type {number[]} */ [left, top]) {
    if (Number.isNaN(left + top)) return;
    if (!this.#pictures.has(place)) {
      const image = new Image();
      this.#pictures.set(place, image);
      image.addEventListener("load", () => {
        if (image.src.startsWith("blob:")) URL.revokeObjectURL(image.src);
        this.renew();
      });
      this.address(this.#library, place).then((found) => (image.src = found), () => {});
    }
    const image = this.#pictures.get(place);
    const half = PICTURE_PX / 2;
    on.fillStyle = this.stage.palette.accent;
    if (image.complete && image.naturalWidth > 0) on.drawImage(image, left - half, top - half, PICTURE_PX, PICTURE_PX);
    else on.fillRect(left - POINT_PX / 2, top - POINT_PX / 2, POINT_PX, POINT_PX);
  }

  #label(ctx, place) {
    const [x, y] = this.#placed.of(place);
    const name = this.#library.names[place];
    const most = this.width - 16;
    let text = name;
    while (ctx.measureText(text).width > most && text.length > 8) text = `${text.slice(0, -2).trimEnd()}…`;
    const width = ctx.measureText(text).width + 12;
    const left = Math.min(Math.max(x - width / 2, 2), this.width - width - 2);
    const top = y > 40 ? y - 32 : y + 12;
    const { palette } = this.stage;
    ctx.fillStyle = palette.ink;
    ctx.beginPath();
    ctx.roundRect(left, top, width, 20, 4);
    ctx.fill();
    ctx.fillStyle = palette.paper;
    ctx.textAlign = "left";
    ctx.fillText(text, left + 6, top + 10.5);
  }

  /** Moves to a texture, or to none. */
  #reach(place, say = false) {
    if (place === this.#at) return;
    this.#at = place;
    this.canvas.classList.toggle("hits", place !== null);
    const values = place === null ? [] : this.attributes.map((attribute) => valueText(attribute, this.#library.values[attribute.name][place]));
    this.readout.textContent = values.join(" · ");
    if (say) announce([this.#library.names[place], ...values].join(", "));
    this.invalidate();
  }

  #point({ offsetX, offsetY }) {
    if (!this.#placed) return;
    let [nearest, away_px] = [null, NEAR_PX];
    for (const place of this.#places) {
      const [x, y] = this.#placed.of(place);
      const away = Math.hypot(x - offsetX, y - offsetY);
      if (away < away_px) [nearest, away_px] = [place, away];
    }
    this.#reach(nearest);
  }

  #key(event) {
    const direction = KEYS[event.key];
    if (!this.#placed || this.#places.length === 0 || !(direction || ["Enter", " ", "Escape"].includes(event.key))) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.key === "Escape") this.#reach(null);
    else if (direction) this.#step(direction);
    else if (this.#at !== null) this.pick(this.#at);
  }

  /** To the nearest point within 45° of a direction. */
  #step([right, down]) {
    const { of, box } = this.#placed;
    const from = this.#at ?? this.#chosen;
    const [x0, y0] = from === null ? [(box.left + box.right) / 2, (box.top + box.bottom) / 2] : of(from);
    let [best, cost] = [null, Infinity];
    for (const place of this.#places) {
      const [x, y] = of(place);
      const [dx, dy] = [x - x0, y - y0];
      const along = dx * right + dy * down;
      const beside = Math.abs(dx * down) + Math.abs(dy * right);
      if (place === from || !(along > 0.5) || beside > along) continue;
      if (along + 2 * beside < cost) [best, cost] = [place, along + 2 * beside];
    }
    if (best !== null) this.#reach(best, true);
  }
}

/** The figure with the choice of its axes, in an element of the document, whose colours it takes: { show, choose }. */
export function mountScatter(root, pick, address) {
  const stage = new Stage(root, null, () => false);
  const points = new Points(stage, pick, address);
  const choice = (which, label) => element("label", {}, label, " ", element("select", {
    onchange: ({ target }) => {
      points.attributes[which] = ATTRIBUTES.find(({ name }) => name === target.value);
      points.renew();
    },
  }, ...ATTRIBUTES.map((attribute) => element("option",
    { value: attribute.name, selected: attribute === points.attributes[which] }, texts.gallery.attributes[attribute.name]))));
  root.append(element("div", { class: "axes" }, choice(0, texts.gallery.across), choice(1, texts.gallery.up)), points.element);
  return { show: (...what) => points.show(...what), choose: (place) => points.choose(place) };
}
