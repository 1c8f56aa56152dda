// One surface that is explored: what is counted of it, what is still to be done, and its log.

import { Exploration } from "./exploration.js";
import { Log } from "./log.js";
import { texts } from "./texts.js";

export class Trial {
  /** Hears of every change of what is still to be done. */
  changed = () => {};
  #touch;
  #step;
  #counted;
  #log;
  #said = "";

  constructor({ touch, server }, step) {
    this.#touch = touch;
    this.#step = step;
    this.#counted = new Exploration(touch.rate_hz);
    // The server has the ticks of a device itself.
    this.#log = step.device ? null : new Log((first, blob) => server.log(step.index, first, blob));
  }

  /** Begins with a texture, or with the next one. */
  play(texture) {
    return this.#touch.play({ ...this.#step, ...texture }, {
      begun: () => {
        this.#counted = new Exploration(this.#touch.rate_hz);
        this.#log?.begin();
        this.#look();
      },
      ticks: (ticks) => {
        this.#counted.add(ticks);
        this.#log?.add(ticks);
        this.#look();
      },
    });
  }

  /** What is still to be done, in words. */
  missing() {
    const { strokes, taps, seconds } = this.#step.explore;
    const { strokes: stroked, taps: tapped, contact_s } = this.#counted;
    return [
      ...(stroked < strokes ? [texts.missing.strokes(strokes - stroked, stroked > 0)] : []),
      ...(tapped < taps ? [texts.missing.taps(taps - tapped, tapped > 0)] : []),
      // Without a number, which a screen reader would count down.
      ...(stroked >= strokes && tapped >= taps && contact_s < seconds ? [texts.missing.seconds] : []),
    ];
  }

  /** As the server takes it. */
  counts() {
    return this.#counted.counts();
  }

  /** Rests, and resolves when the server has the log. */
  async save() {
    await this.#touch.rest();
    await this.#log?.finish();
  }

  #look() {
    const said = this.missing().join();
    if (said === this.#said) return;
    this.#said = said;
    this.changed();
  }
}
