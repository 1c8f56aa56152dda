// The button of the test tones. Any key stops them at once, but those by which a person sets a band meanwhile.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { playSteps } from "./tones.js";

const own = texts.output;
const SHOWN_MS = 100;
/** Keys that set a band, and those that lead to one. */
const SETS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "PageUp", "PageDown", "Home", "End"];
const LEADS = ["Tab", "Shift"];

/** `bands` are their sliders; `mark` shows the frequency that plays, or none by null. */
export function tonesButton(sound, { bands, mark }) {
  let playing = null;
  let timer = null;
  const button = element("button", { type: "button", id: "tones", "aria-pressed": "false",
    onclick: () => (playing ? stop() : start()) }, own.tones);
  const shown = element("output", { class: "hz", for: "tones" });

  const show = () => {
    const hz = playing && playing.hz;
    button.setAttribute("aria-pressed", String(playing !== null));
    button.textContent = playing ? own.tones_stop : own.tones;
    shown.textContent = playing ? own.tone(hz) : "";
    mark(hz);
  };
  const start = async () => {
    await sound.start();
    if (sound.state !== "on" || playing) return;
    playing = playSteps(sound.chain);
    timer = setInterval(show, SHOWN_MS);
    show();
  };
  const stop = () => {
    if (!playing) return;
    playing.stop();
    playing = null;
    clearInterval(timer);
    show();
  };
  const swallow = (event) => event.preventDefault();
  addEventListener("keydown", (event) => {
    const { key, target } = event;
    if (!playing || LEADS.includes(key) || (SETS.includes(key) && bands.includes(target))) return;
    stop();
    // The key does nothing else, also when it is released.
    event.preventDefault();
    event.stopPropagation();
    addEventListener("keyup", swallow, { capture: true, once: true });
  }, true);
  sound.onstate.push((state) => state !== "on" && stop());
  return { elements: [element("div", { class: "row" }, button, shown), element("p", { class: "small" }, own.tones_about)], stop };
}
