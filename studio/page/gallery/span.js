// A range with two ends: two sliders on one rail.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { valueText } from "./attributes.js";

const STEPS = 100;

export class Span {
  #ends = null;

  constructor(attribute, changed) {
    this.attribute = attribute;
    this.title = texts.gallery.attributes[attribute.name];
    this.sliders = ["least", "most"].map((end) => element("input", { type: "range", min: 0, max: STEPS, step: 1, class: end,
      "aria-label": texts.gallery[end](this.title), oninput: () => this.#moved(end, changed) }));
    this.output = element("output", { class: "physical" });
    this.rail = element("div", { class: "rail" }, element("span", { class: `part ${attribute.name}` }), ...this.sliders);
    this.element = element("div", { class: "span", role: "group", "aria-label": this.title },
      element("span", {}, this.title), this.rail, this.output);
  }

  /** Takes the ends of a library, and every texture of it. */
  begin(ends) {
    this.#ends = ends;
    for (const slider of this.sliders) slider.disabled = ends === null || ends[0] === ends[1];
    this.reset();
  }

  reset() {
    this.sliders[0].value = 0;
    this.sliders[1].value = STEPS;
    this.#show();
  }

  /** [low, high]; `null` where it holds everything. */
  get range() {
    const [from, to] = this.sliders.map(({ value }) => Number(value));
    if (this.#ends === null || (from === 0 && to === STEPS)) return null;
    return [from === 0 ? -Infinity : this.#value(from), to === STEPS ? Infinity : this.#value(to)];
  }

  #value(step) {
    const [low, high] = this.#ends;
    const share = step / STEPS;
    return this.attribute.log ? low * (high / low) ** share : low + (high - low) * share;
  }

  // An end pushes the other one no further than to itself.
  #moved(end, changed) {
    const [least, most] = this.sliders;
    if (Number(least.value) > Number(most.value)) {
      if (end === "least") least.value = most.value;
      else most.value = least.value;
    }
    this.#show();
    changed();
  }

  #show() {
    const shares = this.sliders.map(({ value }) => Number(value) / STEPS);
    this.rail.style.setProperty("--from", shares[0]);
    this.rail.style.setProperty("--to", shares[1]);
    // Both at one end: the one that can still move lies on top.
    this.rail.classList.toggle("turned", shares[0] > 0.5);
    if (this.#ends === null) return (this.output.textContent = texts.gallery.undefined);
    const said = this.sliders.map(({ value }) => valueText(this.attribute, this.#value(Number(value))));
    this.sliders.forEach((slider, n) => slider.setAttribute("aria-valuetext", said[n]));
    this.output.textContent = texts.gallery.span(this.attribute.name, ...this.sliders.map(({ value }) => this.#value(Number(value))));
  }
}
