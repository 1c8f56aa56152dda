// A hand that moves by itself, for those who only listen: circles, to and fro, or taps.

import { now_s } from "./hand.js";

const OWNER = "auto";
const STEP_S = 0.008;
const TAPS_HZ = 2;
/** Share of a tap's period in which it touches. */
const TAP_SHARE = 0.4;
/** Radius of the path as a share of the stage, and its limits, mm. */
const REACH = 0.3;
const REACH_MM = [4, 60];

export const PATHS = ["circle", "line", "tap"];

/** Where a path is at a phase, in radii from its centre; a full turn has the phase 2π. */
const PLACES = {
  circle: (phase) => [Math.cos(phase), Math.sin(phase)],
  line: (phase) => [Math.sin(phase), 0],
  tap: () => [0, 0],
};

export class Auto {
  path = PATHS[0];
  speed_mm_s = 100;
  /** Called when it stops, also because somebody else took the hand. */
  onend = () => {};
  #hand;
  #force;
  #surface;
  #timer = null;
  #centre_mm;
  #radius_mm;
  #phase = 0;
  /** Time up to which the hand has moved, s. */
  #t_s;

  constructor({ surface, hand, force }) {
    this.#surface = surface;
    this.#hand = hand;
    this.#force = force;
  }

  get on() {
    return this.#timer !== null;
  }

  start() {
    const { view } = this.#surface;
    this.#centre_mm = view.centre_mm;
    const wanted_mm = (REACH * Math.min(view.width_px, view.height_px)) / view.px_mm;
    this.#radius_mm = Math.min(Math.max(wanted_mm, REACH_MM[0]), REACH_MM[1]);
    this.#phase = 0;
    this.#t_s = now_s();
    this.#press();
    clearInterval(this.#timer);
    this.#timer = setInterval(() => this.#step(), 1000 * STEP_S);
    this.outline();
  }

  stop() {
    if (!this.on) return;
    clearInterval(this.#timer);
    this.#timer = null;
    this.#hand.lift(OWNER, now_s());
    this.outline();
    this.onend();
  }

  /** Shows the path, or that there is none. */
  outline() {
    if (!this.on) return this.#surface.outline(null);
    const r = this.#radius_mm;
    const half_mm = { circle: [r, r], line: [r, 0], tap: [0, 0] }[this.path];
    this.#surface.outline({ centre_mm: this.#centre_mm, half_mm });
  }

  #step() {
    const to_s = now_s();
    // Somebody else took the hand.
    if (this.#hand.owner !== null && this.#hand.owner !== OWNER) return this.stop();
    if (this.path === "tap") this.#tap(to_s);
    else this.#stroke(to_s);
  }

  #tap(to_s) {
    this.#phase += (to_s - this.#t_s) * TAPS_HZ;
    this.#t_s = to_s;
    const touches = this.#phase % 1 < TAP_SHARE;
    if (touches && this.#hand.owner === null) this.#press();
    else if (!touches && this.#hand.owner === OWNER) this.#hand.lift(OWNER, to_s);
  }

  // A page that was busy catches up in even steps, so that the motion stays even.
  #stroke(to_s) {
    if (this.#hand.owner === null) this.#press();
    const samples = [];
    const count = Math.min(Math.ceil((to_s - this.#t_s) / STEP_S), 25);
    const step_s = (to_s - this.#t_s) / Math.max(count, 1);
    for (let n = 0; n < count; n++) {
      this.#t_s += step_s;
      this.#phase += (this.speed_mm_s * step_s) / this.#radius_mm;
      samples.push(this.#sample());
    }
    this.#hand.move(OWNER, samples);
    this.#surface.light(this.#surface.view.toPx([this.#hand.last.x_mm, this.#hand.last.y_mm]));
  }

  #press() {
    this.#hand.press(OWNER, this.#sample());
  }

  #sample() {
    const [x, y] = PLACES[this.path](this.#phase).map((place, axis) => this.#centre_mm[axis] + this.#radius_mm * place);
    return { t_s: this.#t_s, x_mm: x, y_mm: y, force_n: this.#force.set_n() };
  }
}
