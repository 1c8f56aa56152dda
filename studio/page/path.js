// The path of a hand that moves by itself: circles, to and fro, or taps. The renderer moves it at the clock of the sound,
// so that it goes on evenly whatever the page does; the page draws it, and moves it itself while there is no sound.
//
// A path is { name, speed_mm_s, force_n, centre_mm, radius_mm, phase }; a whole turn, or a tap and its pause, has 2π.

import { LIFT_MM } from "./hand.js";

export const PATHS = ["circle", "line", "tap"];

const TURN = 2 * Math.PI;
const TAPS_HZ = 2;
/** Share of a tap's period in which it touches. */
const TAP_SHARE = 0.4;

/** Where a path is at a phase, in radii from its centre. */
const PLACES = {
  circle: (phase) => [Math.cos(phase), Math.sin(phase)],
  line: (phase) => [Math.sin(phase), 0],
  tap: () => [0, 0],
};

export const phaseAfter = ({ name, phase, speed_mm_s, radius_mm }, s) =>
  (phase + s * (name === "tap" ? TURN * TAPS_HZ : speed_mm_s / radius_mm)) % TURN;

export const touches = ({ name, phase }) => name !== "tap" || phase < TAP_SHARE * TURN;

/** Where it is, mm. */
export const placeOf = ({ name, phase, centre_mm, radius_mm }) =>
  PLACES[name](phase).map((place, axis) => centre_mm[axis] + radius_mm * place);

/** The hand on its path, as events for the renderer. */
export class Walk {
  #path = null;
  #stroke = 0;
  #down = false;
  /** The page's clock less that of the sound, s. */
  #ahead_s = 0;

  get phase() {
    return this.#path.phase;
  }

  get on() {
    return this.#path !== null;
  }

  /** Takes a path at the page's time `t_s`, when the sound has `now_s`. On one of this name the hand goes on from where it is. */
  follow(path, t_s, now_s) {
    if (!this.on) this.#ahead_s = t_s - now_s;
    if (this.#path?.name === path.name) path.phase = this.phase;
    else this.#down = false;
    this.#path = path;
  }

  /** Somebody else has the hand. */
  leave() {
    this.#path = null;
    this.#down = false;
  }

  /** The event at which the hand is lifted for good, or none. */
  lift(now_s) {
    const events = this.#down ? this.#event(now_s, LIFT_MM) : [];
    this.leave();
    return events;
  }

  /** Moves on by `s` from `now_s`; the event, or none: a hand that rests over the surface or on it has none. */
  advance(now_s, s, stiffness_n_m) {
    const path = this.#path;
    path.phase = phaseAfter(path, s);
    const [was, down] = [this.#down, touches(path)];
    this.#down = down;
    if (was === down && (path.name === "tap" || !down)) return [];
    // Another number for each contact; the page's own are positive.
    if (!was) this.#stroke--;
    return this.#event(now_s + s, down ? (-1000 * path.force_n) / stiffness_n_m : LIFT_MM);
  }

  #event(now_s, z_mm) {
    return [now_s + this.#ahead_s, ...placeOf(this.#path), z_mm, this.#stroke];
  }
}
