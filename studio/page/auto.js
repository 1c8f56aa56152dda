// A hand that moves by itself, for those who only listen. The renderer moves it (`path.js`); this starts, changes and draws it.

import { Events } from "./events.js";
import { now_s } from "./hand.js";
import { PATHS, phaseAfter, placeOf, touches } from "./path.js";

const OWNER = "auto";
/** The page draws it so often, s. */
const FRAME_S = 0.016;
/** Radius of the path as a share of the stage, and its limits, mm. */
const REACH = 0.3;
const REACH_MM = [4, 60];

/** Emits "end" when it stops, also because somebody else took the hand. */
export class Auto extends Events {
  name = PATHS[0];
  speed_mm_s = 100;
  #hand;
  #force;
  #surface;
  #sound;
  #timer = null;
  #path = null;
  /** Time up to which the page moved the hand, s. */
  #t_s;

  constructor({ surface, hand, force, sound }) {
    super();
    this.#surface = surface;
    this.#hand = hand;
    this.#force = force;
    this.#sound = sound;
    sound.on("path", (phase) => {
      if (!this.running) return;
      if (phase === null) return this.stop();
      this.#path.phase = phase;
      this.#t_s = now_s();
    });
  }

  get running() {
    return this.#timer !== null;
  }

  start() {
    const { view } = this.#surface;
    const wanted_mm = (REACH * Math.min(view.width_px, view.height_px)) / view.px_mm;
    this.#path = { name: this.name, speed_mm_s: this.speed_mm_s, force_n: this.#force.set_n(), centre_mm: view.centre_mm,
      radius_mm: Math.min(Math.max(wanted_mm, REACH_MM[0]), REACH_MM[1]), phase: 0 };
    this.#t_s = now_s();
    this.#hand.show(OWNER, this.#sample());
    this.#sound.follow(this.#path);
    clearInterval(this.#timer);
    this.#timer = setInterval(() => this.#step(), 1000 * FRAME_S);
    this.outline();
  }

  stop() {
    if (!this.running) return;
    clearInterval(this.#timer);
    this.#timer = null;
    this.#sound.follow(null);
    this.#hand.show(OWNER, null);
    this.outline();
    this.emit("end");
  }

  /** Shows the path, or that there is none. */
  outline() {
    if (!this.running) return this.#surface.outline(null);
    const { name, radius_mm: r, centre_mm } = this.#path;
    const half_mm = { circle: [r, r], line: [r, 0], tap: [0, 0] }[name];
    this.#surface.outline({ centre_mm, half_mm });
  }

  #step() {
    // Somebody else took the hand.
    if (this.#hand.owner !== null && this.#hand.owner !== OWNER) return this.stop();
    const path = this.#path;
    const [speed_mm_s, force_n] = [this.speed_mm_s, this.#force.set_n()];
    if (path.speed_mm_s !== speed_mm_s || path.force_n !== force_n) {
      Object.assign(path, { speed_mm_s, force_n });
      this.#sound.follow(path);
    }
    const to_s = now_s();
    if (this.#sound.state !== "on") path.phase = phaseAfter(path, to_s - this.#t_s);
    this.#t_s = to_s;
    this.#hand.show(OWNER, touches(path) ? this.#sample() : null);
    if (this.#hand.last) this.#surface.light(this.#surface.view.toPx([this.#hand.last.x_mm, this.#hand.last.y_mm]));
  }

  #sample() {
    const [x_mm, y_mm] = placeOf(this.#path);
    return { t_s: this.#t_s, x_mm, y_mm, force_n: this.#path.force_n };
  }
}
