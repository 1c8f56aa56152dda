// Test signals: tones by which a person sets an equaliser, and a burst on each channel of a device. They enter before the
// limiter, so that no tone exceeds the level.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { CHANNELS, MODES } from "./modes.js";

/** Steps of two thirds of an octave over what fingers feel, Hz. */
export const STEPS_HZ = [25, 40, 63, 100, 160, 250, 400];
export const STEP_S = 1.5;
/** Below full scale, so that a band may add as much without the limiter. */
const TONE = 10 ** (-12 / 20);
/** Time constant of beginnings and ends, s. */
const EDGE_S = 0.01;

const BURST_HZ = 100;
const BURST_S = 0.4;
/** From one burst to the next, s. */
export const CHANNEL_S = 1;

/** A silent oscillator into the equaliser. */
function toneInto(chain, frequency) {
  const { context } = chain;
  const oscillator = new OscillatorNode(context, { frequency });
  const gain = new GainNode(context, { gain: 0 });
  oscillator.connect(gain).connect(chain.equaliser.input);
  return { oscillator, gain: gain.gain };
}

/** Starts the steps, each of which fades in and out; returns what stops them at once. */
export function playSteps(chain) {
  const { context } = chain;
  const { oscillator, gain } = toneInto(chain, STEPS_HZ[0]);
  chain.renders = false;
  const began_s = context.currentTime;
  let step = 0;
  // Ahead of the clock, since timers of a busy page are late.
  const plan = () => {
    for (; began_s + step * STEP_S < context.currentTime + 2 * STEP_S; step++) {
      const at_s = began_s + step * STEP_S;
      oscillator.frequency.setValueAtTime(STEPS_HZ[step % STEPS_HZ.length], at_s);
      gain.setTargetAtTime(TONE, at_s, EDGE_S);
      gain.setTargetAtTime(0, at_s + STEP_S - 10 * EDGE_S, EDGE_S);
    }
  };
  plan();
  const timer = setInterval(plan, 500);
  oscillator.start();
  return {
    /** The tone that plays, Hz. */
    get hz() {
      const at = Math.floor((context.currentTime - began_s) / STEP_S);
      return STEPS_HZ[at % STEPS_HZ.length];
    },
    stop() {
      clearInterval(timer);
      const now_s = context.currentTime;
      gain.cancelScheduledValues(now_s);
      gain.setTargetAtTime(0, now_s, EDGE_S);
      oscillator.stop(now_s + 20 * EDGE_S);
      chain.renders = true;
    },
  };
}

/** Plays a burst on each channel from `at_s` on, one after another. Resolves when what is rendered plays again. */
export function testChannels(chain, at_s = chain.context.currentTime) {
  const { oscillator, gain } = toneInto(chain, BURST_HZ);
  chain.renders = false;
  for (let n = 0; n < CHANNELS; n++) {
    const begins_s = at_s + n * CHANNEL_S;
    chain.open([n], begins_s);
    gain.setTargetAtTime(TONE, begins_s + 5 * EDGE_S, EDGE_S);
    gain.setTargetAtTime(0, begins_s + 5 * EDGE_S + BURST_S, EDGE_S);
  }
  const ends_s = at_s + CHANNELS * CHANNEL_S;
  chain.open(MODES[chain.mode].channels, ends_s);
  oscillator.start(at_s);
  oscillator.stop(ends_s);
  return new Promise((done) => {
    oscillator.onended = () => done((chain.renders = true));
  });
}

// The button of the tones. Any key stops them at once, but those by which a person sets a band meanwhile.
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
  sound.on("state", (state) => state !== "on" && stop());
  return { elements: [element("div", { class: "row" }, button, shown), element("p", { class: "small" }, own.tones_about)], stop };
}
