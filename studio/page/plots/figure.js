// A figure: a caption with a readout, a canvas that is sharp on every display, and a legend in HTML.

import { element } from "../dom.js";

/** Least time between two texts of a readout, s: faster, nobody can read them. */
const READOUT_S = 0.2;

export class Figure {
  layers = new Map();
  width = 0;
  height = 0;
  visible = false;
  dirty = true;
  described = false;
  drawn_s = -Infinity;
  described_s = 0;
  read_s = -Infinity;
  least_s = 0;

  /** `texts` has `title`, `hint` and `legend`, which maps classes of swatches to texts. */
  constructor(stage, name, texts) {
    this.stage = stage;
    this.scope = stage.scope;
    this.texts = texts;
    this.title = texts.title;
    const hint = texts.hint && `plot-hint-${name}`;
    this.canvas = element("canvas", { class: `plot-canvas plot-canvas-${name}`, role: "img", "aria-label": texts.title, tabindex: 0,
      "aria-describedby": hint, onfocus: () => this.describe(), onkeydown: (event) => {
        if (event.key !== "Enter") return;
        event.preventDefault();
        stage.announce(this.summary());
      } });
    this.readout = element("span", { class: "plot-readout" });
    const items = Object.entries(texts.legend ?? {}).map(([swatch, text]) =>
      element("li", {}, element("span", { class: `plot-swatch plot-swatch-${swatch}`, "aria-hidden": "true" }), text));
    this.element = element("figure", { class: `plot plot-${name}` },
      element("figcaption", { class: "plot-caption" }, element("span", { class: "plot-title" }, texts.title), this.readout), this.canvas,
      ...(items.length > 0 ? [element("ul", { class: "plot-legend" }, ...items)] : []),
      ...(hint ? [element("p", { class: "unseen", id: hint }, texts.hint)] : []));
    this.ctx = this.canvas.getContext("2d");
    stage.add(this);
  }

  /** Overridden: draws everything, in CSS pixels. */
  draw(_ctx, _now_s) {}

  /** Overridden: what the figure shows, in words. */
  summary() {
    return this.title;
  }

  get isDrawable() {
    return this.visible && this.width > 0 && this.height > 0;
  }

  get isFocused() {
    return document.activeElement === this.canvas;
  }

  see(visible) {
    this.visible = visible;
    if (visible) this.invalidate();
  }

  resize({ width, height }) {
    [this.width, this.height] = [width, height];
    this.invalidate();
  }

  invalidate() {
    this.dirty = true;
    if (this.isDrawable) this.stage.request();
  }

  describe() {
    this.described = true;
    this.canvas.setAttribute("aria-label", this.summary());
  }

  /** Writes what `text()` gives beside the title, now or as soon as it is time. */
  read(text, now_s) {
    if (now_s - this.read_s < READOUT_S) {
      this.dirty = true;
      return;
    }
    this.read_s = now_s;
    const now = text();
    if (this.readout.textContent !== now) this.readout.textContent = now;
  }

  render(now_s) {
    const { canvas, ctx } = this;
    const ratio = devicePixelRatio;
    const [width, height] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    // Setting a size, even the same one, empties a canvas and costs a frame.
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, this.width, this.height);
    this.#style(ctx);
    this.described = false;
    this.draw(ctx, now_s);
  }

  #style(ctx) {
    ctx.font = `12px ${this.stage.palette.font}`;
    ctx.lineJoin = "round";
    ctx.lineWidth = 1;
    ctx.textBaseline = "middle";
  }

  /** Draws what seldom changes from a picture that is kept while `key`, size and colours stay. */
  layer(ctx, name, key, draw) {
    const ratio = devicePixelRatio;
    const whole = [key, this.width, this.height, ratio, this.stage.palette.version].join("|");
    let layer = this.layers.get(name);
    if (layer?.whole !== whole) {
      layer ??= { canvas: document.createElement("canvas") };
      layer.whole = whole;
      [layer.canvas.width, layer.canvas.height] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
      const on = layer.canvas.getContext("2d");
      on.setTransform(ratio, 0, 0, ratio, 0, 0);
      this.#style(on);
      layer.result = draw(on);
      this.layers.set(name, layer);
    }
    ctx.drawImage(layer.canvas, 0, 0, this.width, this.height);
    return layer.result;
  }
}
