// The stage: the surface under a lamp that follows the hand, its scale, and where the hand touches.

import { element, find } from "./dom.js";
import { Events } from "./events.js";
import { Lit, Plain } from "./lit.js";
import { texts } from "./texts.js";
import { View } from "./view.js";

const ZOOM_STEP = 1.25;
/** Pixels of the picture a pixel of the page: more nobody sees, fewer would blur. */
const [FEWEST, MOST] = [0.5, 2];
/** A frame that takes longer than this, ms, is slow; after so many in a row the picture gets coarser. */
const SLOW_MS = 30;
const SLOW_FRAMES = 6;
const COARSER = 0.7;
/** After such a rest the picture is drawn with all its pixels again, ms. */
const REST_MS = 200;
/** Where the lamp hangs when nobody moves it. */
const REST = [0.32, 0.28];

const reduced = matchMedia("(prefers-reduced-motion: reduce)");

/** Emits "zoom" after every change of what the stage shows. */
export class Surface extends Events {
  view = new View();
  stage = find("stage");
  #contact = find("contact");
  #canvas;
  #layer;
  /** Picture, normals and width of the texture; `null` before the first. */
  #shown = null;
  #lamp_px = null;
  /** Where the surface gives way, and how deep, mm. */
  #dent_mm = [0, 0, 0];
  #scheduled = false;
  #drawn_ms = 0;
  #slow = 0;
  /** Share of the screen's pixels that the machine draws in time, while something moves. */
  #share = 1;
  #rest = null;

  constructor() {
    super();
    this.#begin(true);
    new ResizeObserver(() => this.#resize()).observe(this.stage);
    matchMedia("(resolution: 1dppx)").addEventListener("change", () => this.#resize());
    find("zoom-in").addEventListener("click", () => this.zoom(ZOOM_STEP));
    find("zoom-out").addEventListener("click", () => this.zoom(1 / ZOOM_STEP));
    find("zoom-reset").addEventListener("click", () => this.reset());
    this.#resize();
  }

  /** Shows a texture by the Blobs of its picture and its normal map. */
  async show(picture, normals, width_mm) {
    /** @type {ImageBitmapOptions} */
    const options = { premultiplyAlpha: "none", colorSpaceConversion: "none" };
    const images = await Promise.all([picture, normals].map((blob) => createImageBitmap(blob, options)));
    this.#shown = [...images, width_mm];
    this.#layer.setPicture(...this.#shown);
    this.stage.parentElement.classList.add("loaded");
    this.#draw();
  }

  zoom(factor, at_px) {
    this.view.zoom(factor, at_px);
    this.#zoomed();
  }

  reset() {
    this.view.reset();
    this.#zoomed();
  }

  /** Moves what the stage shows by pixels. */
  shift(by_px) {
    this.view.centre_mm = this.view.toMm([this.view.width_px / 2 + by_px[0], this.view.height_px / 2 + by_px[1]]);
    this.#zoomed();
  }

  /** Whether there is something to stroke. */
  get loaded() {
    return this.#shown !== null;
  }

  /** Where the pointer is over the stage, px. */
  at(event) {
    const { left, top } = this.stage.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  /** Hangs the lamp over a place; without one, where it rests. */
  light(at_px = null) {
    this.#lamp_px = reduced.matches ? null : at_px;
    this.#draw();
  }

  /** Shows where the hand touches and how hard; `null` while it is lifted. */
  touch(sample) {
    this.#contact.hidden = sample === null;
    if (sample === null) return;
    const [x, y] = this.view.toPx([sample.x_mm, sample.y_mm]);
    this.#contact.style.transform = `translate(${x}px, ${y}px) scale(${0.6 + 0.4 * sample.force_n})`;
  }

  /** Shows how deep the surface gives way under the hand, mm. */
  dent(sample, depth_mm) {
    const [x_mm, y_mm] = sample ? [sample.x_mm, sample.y_mm] : this.#dent_mm;
    if (depth_mm === 0 && this.#dent_mm[2] === 0) return;
    this.#dent_mm = [x_mm, y_mm, depth_mm];
    this.#draw();
  }

  /** Outlines the path of the hand that moves by itself, in mm, or takes it away. */
  outline(box) {
    const path = find("path");
    path.hidden = !box;
    if (!box) return;
    const [left, top] = this.view.toPx([box.centre_mm[0] - box.half_mm[0], box.centre_mm[1] + box.half_mm[1]]);
    Object.assign(path.style, { left: `${left}px`, top: `${top}px`,
      width: `${2 * box.half_mm[0] * this.view.px_mm}px`, height: `${2 * box.half_mm[1] * this.view.px_mm}px` });
  }

  #begin(lit) {
    const canvas = element("canvas", { "aria-hidden": "true" });
    this.#layer = (lit && Lit.on(canvas)) || new Plain(canvas);
    if (this.#layer instanceof Lit) {
      // A driver that fails once may fail again; the plain picture always works.
      canvas.addEventListener("webglcontextlost", () => this.#begin(false));
    } else find("stage-hint").append(" ", texts.surface.plain);
    this.#canvas?.remove();
    this.#canvas = canvas;
    this.stage.prepend(canvas);
    if (this.#shown) this.#layer.setPicture(...this.#shown);
    this.#resize();
  }

  #resize() {
    this.view.resize(this.stage.clientWidth, this.stage.clientHeight);
    this.#zoomed();
  }

  #zoomed() {
    const bar_mm = this.view.bar_mm();
    const scale = find("scale");
    scale.firstElementChild.style.width = `${bar_mm * this.view.px_mm}px`;
    scale.dataset.text = texts.surface.scale(bar_mm);
    this.emit("zoom");
    this.#draw();
  }

  /** Machines without a graphics processor draw fewer pixels, so that the hand is not held up. */
  #judge(now_ms) {
    const took_ms = now_ms - this.#drawn_ms;
    this.#drawn_ms = now_ms;
    // After a rest nothing is known.
    if (took_ms > 10 * SLOW_MS) return;
    this.#slow = took_ms > SLOW_MS ? this.#slow + 1 : 0;
    if (this.#slow < SLOW_FRAMES || this.#share < FEWEST) return;
    this.#slow = 0;
    this.#share *= COARSER;
  }

  #draw() {
    if (this.#scheduled || !this.#shown) return;
    this.#scheduled = true;
    requestAnimationFrame((now_ms) => {
      this.#scheduled = false;
      this.#judge(now_ms);
      this.#paint(this.#share);
      clearTimeout(this.#rest);
      if (this.#share < 1) this.#rest = setTimeout(() => this.#paint(1), REST_MS);
    });
  }

  #paint(share) {
    const { width_px, height_px } = this.view;
    const pixels = Math.max(Math.min(devicePixelRatio, MOST) * share, FEWEST);
    const sizes = { width: Math.max(Math.round(width_px * pixels), 1), height: Math.max(Math.round(height_px * pixels), 1) };
    // Setting a size clears the canvas, the same one too.
    for (const [name, size] of Object.entries(sizes)) if (this.#canvas[name] !== size) this.#canvas[name] = size;
    this.#layer.draw(this.view, this.#lamp_px ?? [REST[0] * width_px, REST[1] * height_px], this.#dent_mm);
  }
}
