// The controls of the strip: freeze, scroll, save.

import { busily, element, save } from "../dom.js";

/** Ticks copied at once, a megabyte. */
const PART_TICKS = 20_000;

export class Controls {
  /** `freeze(on)` and `scrolled()` tell the other parts. */
  constructor(scope, texts, { freeze, scrolled }) {
    this.scope = scope;
    this.texts = texts;
    this.button = element("button", { type: "button", class: "plot-button", onclick: () => freeze(!scope.frozen) });
    this.slider = element("input", { type: "range", class: "plot-slider", step: "any", "aria-label": texts.scroll, oninput: () => {
      scope.scroll(Number(this.slider.value) * scope.tick_hz);
      scrolled();
    } });
    const saving = (label, name, table) => element("button", { type: "button", class: "plot-button",
      onclick: ({ currentTarget }) => busily(currentTarget, async () => save(name, await written(table, scope))) }, label);
    this.saves = [
      saving(texts.save, texts.file, "rendered"),
      saving(texts.save_trajectory, texts.trajectory_file, "trajectory"),
    ];
    this.element = element("div", { class: "plot-controls" }, this.button, this.slider, ...this.saves);
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

/** A table as a Blob, written by a worker: half a million rows would hold the page up for seconds. */
function written(table, { ring, tick_hz }) {
  const worker = new Worker(new URL("plots/csv.js", document.baseURI), { type: "module" });
  return new Promise((done, failed) => {
    worker.onmessage = ({ data }) => done(data);
    worker.onerror = ({ message }) => failed(new Error(message));
    worker.postMessage({ ticks: ring.capacity });
    copyInto(worker, ring).then(() => worker.postMessage({ table, tick_hz }), failed);
  }).finally(() => worker.terminate());
}

/** Sends the ticks kept now, in parts. A page that stands still meanwhile may lose the oldest; the table then begins later. */
async function copyInto(worker, ring) {
  const { session, end } = ring;
  for (let tick = ring.first; tick < end && ring.session === session;) {
    const part = ring.part(tick, Math.min(PART_TICKS, end - tick));
    tick += part.flags.length;
    worker.postMessage({ part }, [part.positions_mm, part.columns, part.flags].map(({ buffer }) => buffer));
    await new Promise((done) => setTimeout(done));
    tick = Math.max(tick, ring.first);
  }
}
