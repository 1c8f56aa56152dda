// The hand, whoever moves it. Samples of pointer and keys become the events of the worklet: time, position, depth by force
// and stiffness, and the number of the stroke. The hand that moves by itself is shown only: the worklet moves it.

import { Events } from "./events.js";

/** How high the hand is lifted, mm. A tap falls from there within 25 ms, at 0.1 m/s and up. */
export const LIFT_MM = 3;
/** Stiffness until the renderer says that of its texture, N/m. */
const USUAL_N_M = 500;
/** Window of the speed, s. */
const SPEED_S = 0.08;

/** Emits "move" after every change. */
export class Hand extends Events {
  #stiffness_n_m = USUAL_N_M;
  #stroke = 0;
  #owner = null;
  /** False for an owner that the renderer moves. */
  #moves = false;
  #recent = [];
  #post;

  /** `post` takes a Float64Array of five numbers an event. */
  constructor(post) {
    super();
    this.#post = post;
  }

  /** What the hand did last while it touches: { t_s, x_mm, y_mm, force_n }; `null` while lifted. */
  get last() {
    return this.#recent.at(-1) ?? null;
  }

  get owner() {
    return this.#owner;
  }

  /** Stiffness of the texture, N/m. A hand that is pressing goes on with its force. */
  set stiffness_n_m(stiffness_n_m) {
    const pressing = this.#owner !== null && this.#moves && stiffness_n_m !== this.#stiffness_n_m;
    this.#stiffness_n_m = stiffness_n_m;
    if (pressing) this.move(this.#owner, [{ ...this.last, t_s: now_s() }]);
  }

  /** Puts the hand down at a sample; another owner loses it. */
  press(owner, sample) {
    if (this.#owner !== null && this.#owner !== owner) this.lift(this.#owner, sample.t_s);
    this.#owner = owner;
    this.#moves = true;
    this.#stroke++;
    this.#recent = [];
    this.move(owner, [sample]);
  }

  /** Moves it over samples. Those of anybody but its owner are dropped. */
  move(owner, samples) {
    if (owner !== this.#owner || samples.length === 0) return;
    const events = new Float64Array(5 * samples.length);
    samples.forEach(({ t_s, x_mm, y_mm, force_n }, n) => {
      events.set([t_s, x_mm, y_mm, (-1000 * force_n) / this.#stiffness_n_m, this.#stroke], 5 * n);
    });
    this.#post(events);
    this.#keep(samples);
  }

  #keep(samples) {
    this.#recent.push(...samples);
    const from_s = this.last.t_s - SPEED_S;
    this.#recent = this.#recent.filter(({ t_s }, n) => t_s >= from_s || n === this.#recent.length - 1);
    this.emit("move");
  }

  /** Shows where a hand is that the renderer itself moves: takes it where nobody has it; `null` lifts it. */
  show(owner, sample) {
    if (this.#owner !== null && this.#owner !== owner) return;
    const touched = this.#owner !== null;
    this.#owner = sample && owner;
    this.#moves = false;
    if (!sample || !touched) this.#recent = [];
    if (sample) this.#keep([sample]);
    else if (touched) this.emit("move");
  }

  lift(owner, t_s) {
    if (owner !== this.#owner) return;
    const { x_mm, y_mm } = this.last;
    this.#owner = null;
    this.#recent = [];
    this.#post(Float64Array.of(t_s, x_mm, y_mm, LIFT_MM, this.#stroke));
    this.emit("move");
  }

  /** Speed over the last samples at a time, mm/s. */
  speed_mm_s(now_s) {
    const [first, last] = [this.#recent[0], this.last];
    if (!last || now_s - last.t_s > SPEED_S || last.t_s <= first.t_s) return 0;
    const way_mm = this.#recent.slice(1).reduce((sum, { x_mm, y_mm }, n) =>
      sum + Math.hypot(x_mm - this.#recent[n].x_mm, y_mm - this.#recent[n].y_mm), 0);
    return way_mm / (last.t_s - first.t_s);
  }
}

/** Time of the page's clock, s; that of events. */
export const now_s = () => performance.now() / 1000;
