// The controls of the strip: freeze, scroll, save.

import { save } from "../save.js";
import { renderedCsv, trajectoryCsv } from "./csv.js";
import { element } from "./figure.js";

export class Controls {
  /** `freeze(on)` and `scrolled()` tell the other parts. */
  constructor(scope, texts, { freeze, scrolled }) {
    this.scope = scope;
    this.texts = texts;
    this.button = element("button", "plot-button");
    this.button.type = "button";
    this.button.addEventListener("click", () => freeze(!scope.frozen));
    this.slider = element("input", "plot-slider");
    this.slider.type = "range";
    this.slider.step = "any";
    this.slider.setAttribute("aria-label", texts.scroll);
    this.slider.addEventListener("input", () => {
      scope.scroll(Number(this.slider.value) * scope.tick_hz);
      scrolled();
    });
    const saving = (label, name, text) => {
      const button = element("button", "plot-button", label);
      button.type = "button";
      button.addEventListener("click", () => save(name, new Blob([text(scope.ring, scope.tick_hz)], { type: "text/csv" })));
      return button;
    };
    this.saves = [
      saving(texts.save, texts.file, renderedCsv),
      saving(texts.save_trajectory, texts.trajectory_file, trajectoryCsv),
    ];
    this.element = element("div", "plot-controls", this.button, this.slider, ...this.saves);
    this.update();
  }

  /** Shows whether and where the plots are frozen. */
  update() {
    const { frozen, ring, now, tick_hz } = this.scope;
    this.button.textContent = frozen ? this.texts.run : this.texts.freeze;
    this.slider.disabled = !frozen;
    [this.slider.min, this.slider.max] = [ring.first / tick_hz, ring.end / tick_hz];
    this.slider.value = (frozen ? now : ring.end) / tick_hz;
    this.slider.setAttribute("aria-valuetext", this.texts.moment(now / tick_hz));
    for (const button of this.saves) button.disabled = ring.end === ring.first;
  }
}
