// The controls of the strip: freeze, scroll, save.

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
    const save = (label, name, text) => {
      const button = element("button", "plot-button", label);
      button.type = "button";
      button.addEventListener("click", () => download(name, text(scope.ring, scope.tick_hz)));
      return button;
    };
    this.saves = [
      save(texts.save, texts.file, renderedCsv),
      save(texts.save_trajectory, texts.trajectory_file, trajectoryCsv),
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
    for (const save of this.saves) save.disabled = ring.end === ring.first;
  }
}

function download(name, text) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  link.download = name;
  link.click();
  // Some browsers read it later than the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
