// When figures draw: at most once an animation frame, only what changed, only what is seen.

import { element } from "../dom.js";

/** Which property of the probe (`plots.css`) holds which colour. */
const HOLDERS = {
  ink: "color",
  paper: "backgroundColor",
  grid: "borderTopColor",
  accent: "borderRightColor",
  accent_2: "borderBottomColor",
  muted: "borderLeftColor",
};

/** The page's colours and font as canvases need them: resolved, whatever notation the page uses. */
class Palette {
  version = "";

  constructor(container, changed) {
    this.probe = element("span", { class: "unseen plot-probe" });
    container.append(this.probe);
    this.read();
    const again = () => this.read() && changed();
    // A theme is an attribute of the document or the system's wish.
    new MutationObserver(again).observe(document.documentElement, { attributes: true });
    for (const query of ["(prefers-color-scheme: dark)", "(forced-colors: active)", "(prefers-contrast: more)"]) {
      matchMedia(query).addEventListener("change", again);
    }
  }

  /** Returns whether something changed. */
  read() {
    const style = getComputedStyle(this.probe);
    const found = Object.entries(HOLDERS).map(([name, property]) => [name, style[property]]);
    const version = JSON.stringify([...found, style.fontFamily]);
    if (version === this.version) return false;
    Object.assign(this, Object.fromEntries(found), { version, font: style.fontFamily });
    return true;
  }
}

/** Least time between two drawings for those who want little motion, s. */
const CALM_S = 0.25;
/** Least time between two descriptions of a figure, s. */
const DESCRIBE_S = 1;

export class Stage {
  /** `scope` is what all figures look at; `advance(now_s)` runs before every frame and says whether another one is due. */
  constructor(container, scope, advance) {
    this.scope = scope;
    this.advance = advance;
    this.figures = new Set();
    this.frame = 0;
    this.palette = new Palette(container, () => this.redrawAll());
    this.motion = matchMedia("(prefers-reduced-motion: reduce)");
    this.seen = new IntersectionObserver((entries) => {
      for (const entry of entries) this.#of(entry.target)?.see(entry.isIntersecting);
    });
    this.sizes = new ResizeObserver((entries) => {
      for (const entry of entries) this.#of(entry.target)?.resize(entry.contentRect);
    });
    this.announcer = element("p", { class: "unseen", "aria-live": "polite" });
    container.append(this.announcer);
  }

  #of(canvas) {
    return [...this.figures].find((figure) => figure.canvas === canvas);
  }

  add(figure) {
    this.figures.add(figure);
    this.seen.observe(figure.canvas);
    this.sizes.observe(figure.canvas);
  }

  redrawAll() {
    for (const figure of this.figures) figure.dirty = true;
    this.request();
  }

  request() {
    this.frame ||= requestAnimationFrame((now_ms) => {
      this.frame = 0;
      this.#draw(now_ms / 1000);
    });
  }

  #draw(now_s) {
    let goes_on = this.advance(now_s);
    for (const figure of this.figures) {
      if (!figure.isDrawable) continue;
      const least_s = Math.max(figure.least_s, this.motion.matches ? CALM_S : 0);
      // Half a frame early is on time.
      if (figure.dirty && now_s - figure.drawn_s >= least_s - 0.008) {
        figure.drawn_s = now_s;
        figure.dirty = false;
        figure.render(now_s);
      }
      if (figure.dirty) goes_on = true;
      if (figure.described || !figure.isFocused) continue;
      if (now_s - figure.described_s >= DESCRIBE_S) {
        figure.described_s = now_s;
        figure.describe();
      } else goes_on = true;
    }
    if (goes_on) this.request();
  }

  /** Has a screen reader say a text. */
  announce(text) {
    // The same text twice would not be said again.
    this.announcer.textContent = this.announcer.textContent === text ? `${text}\u00a0` : text;
  }
}
