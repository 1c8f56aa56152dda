// The slider of one axis: where the texture lies between 0 and 100 and beyond, and the attribute that this stands for.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { Held } from "./live.js";

/** What the slider shows beyond 0 and 100. */
const [LEAST, MOST] = [-25, 125];
/** The most that one edit moves, steps. */
const FARTHEST = 100;

const { axes } = texts.steer;

export class Axis {
  #input;
  #place = element("output", { class: "place" });
  #physical = element("span", { class: "physical" });
  #base = null;

  /** `about` is the axis as the server describes it; `moved` and `released` hear of a person's hand. */
  constructor(about, { moved, released }) {
    this.name = about.axis;
    this.up = about.up;
    this.attribute = about.attribute;
    const id = `slider-${about.axis}`;
    const title = axes[about.axis] ?? about.axis;
    this.#input = element("input", { type: "range", id, step: 1, min: LEAST, max: MOST, title: about.up && `${about.down} – ${about.up}` });
    this.#place.htmlFor = id;
    this.element = element("div", { class: `axis ${about.axis}` },
      element("label", { for: id }, title), this.#physical, this.#place, this.#input);

    this.held = new Held(this.#input, { released, moved: () => {
      this.#limit();
      this.#say();
      moved(this, Number(this.#input.value));
    } });
  }

  /** Steps from the base to a position of the slider. */
  steps(position) {
    return position - this.#base;
  }

  /** Shows a texture whose sliders started at `base`; while it is held, the thumb stays where it is. */
  show(texture, base, enabled) {
    const place = texture?.places?.[this.name] ?? null;
    const from = base?.places?.[this.name] ?? null;
    const value = texture?.inspect.attributes[this.attribute];
    this.#base = from === null ? null : Math.round(from);
    this.#physical.textContent = !texture ? "" : Number.isFinite(value) ? texts.steer.physical[this.name](value) : texts.steer.undefined;
    this.element.dataset.place = place === null ? "none" : "known";
    this.#input.disabled = !enabled || place === null || from === null;
    if (!this.held.on) {
      const shown = Math.round(place ?? 50);
      this.#input.min = Math.min(LEAST, shown);
      this.#input.max = Math.max(MOST, shown);
      this.#input.value = shown;
    }
    this.#say(place === null);
  }

  #limit() {
    const position = Number(this.#input.value);
    const within = Math.min(Math.max(position, this.#base - FARTHEST), this.#base + FARTHEST);
    if (within !== position) this.#input.value = within;
  }

  #say(unknown = false) {
    const { min, max, value } = this.#input;
    this.element.style.setProperty("--share", (value - min) / (max - min));
    this.element.style.setProperty("--zero", -min / (max - min));
    this.element.style.setProperty("--hundred", (100 - min) / (max - min));
    this.#place.textContent = unknown ? texts.readout.none : texts.steer.place(Number(value));
    const physical = this.#physical.textContent;
    this.#input.setAttribute("aria-valuetext", unknown ? physical : texts.steer.position(Number(value), physical));
  }
}
