// How hard the hand presses: by the pressure of a device that has one, else by the slider.

/** What devices without pressure report all the time: 0.5 by the specification, 0 or 1 by others. */
const CONSTANTS = [0, 0.5, 1];
/** Samples of a pen after which an unchanging pressure is said. */
const ENOUGH = 40;

export class Force {
  /** Set by the slider, and the force of full pressure, N. */
  slider_n = 1;
  full_n = 3;
  /** A key that presses harder is held. */
  doubled = false;
  #proved = new Set();
  #constant = new Map();

  /** `onconstant` hears true once for a pen whose pressure does not change, and false when it does after all. */
  constructor(onconstant = (/** @type {boolean} */ _isConstant) => {}) {
    this.onconstant = onconstant;
  }

  /** Whether the force of this kind of pointer comes from its pressure. */
  proved(pointerType) {
    return this.#proved.has(pointerType);
  }

  /** Force of an event while it touches, N. Firefox on Linux calls a pen a mouse, so any kind may prove itself. */
  of({ pointerType, pressure }) {
    if (!CONSTANTS.includes(pressure) && !this.proved(pointerType)) {
      this.#proved.add(pointerType);
      if (pointerType === "pen") this.onconstant(false);
    }
    if (this.proved(pointerType)) return this.#limited(pressure * this.full_n);
    if (pointerType === "pen") {
      const count = (this.#constant.get(pointerType) ?? 0) + 1;
      this.#constant.set(pointerType, count);
      if (count === ENOUGH) this.onconstant(true);
    }
    return this.set_n();
  }

  /** Force without any pressure, N. */
  set_n() {
    return this.#limited(this.slider_n);
  }

  #limited(force_n) {
    return Math.min(force_n * (this.doubled ? 2 : 1), this.full_n);
  }
}
