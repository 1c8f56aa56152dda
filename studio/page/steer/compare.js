// Four slots to compare textures by ear, and blind. For comparison only: nothing here proposes
// a texture.

import { Events } from "../events.js";
import { Refusal } from "../server.js";

export const LETTERS = ["A", "B", "C", "D"];

/** Emits "change". */
export class Compare extends Events {
  /** Entries of the session, `null` where a slot is empty. */
  slots = LETTERS.map(() => null);
  /** Number of the slot that is heard, −1 for none. */
  heard = -1;
  /** Order of the slots while they are compared blindly, else `null`. */
  order = null;
  #loader;
  #session;
  #state;

  constructor({ loader, session, state }) {
    super();
    this.#loader = loader;
    this.#session = session;
    this.#state = state;
    session.on("change", () => this.#shown());
  }

  get filled() {
    return this.slots.flatMap((entry, n) => (entry ? [{ n, letter: LETTERS[n], entry }] : []));
  }

  /** Brings back the entries of a project. */
  restore(slots) {
    this.slots = LETTERS.map((_, n) => slots[n] ?? null);
    this.emit("change");
  }

  /** Puts what is shown into a slot. */
  put(n) {
    this.slots[n] = this.#session.current;
    this.heard = n;
    this.emit("change");
  }

  /** Plays a slot: while blind, the one at this place of the order; an empty one takes what is shown. */
  choose(n) {
    if (this.order) return this.#playBlind(this.order[n]);
    if (!this.slots[n]) return this.#session.current && this.put(n);
    this.heard = n;
    return this.#session.show(this.slots[n]);
  }

  /** Shuffles the filled slots and hides which is which. */
  blind() {
    const order = this.filled.map(({ n }) => n);
    const random = crypto.getRandomValues(new Uint32Array(order.length));
    for (let n = order.length - 1; n > 0; n--) {
      const other = random[n] % (n + 1);
      [order[n], order[other]] = [order[other], order[n]];
    }
    this.order = order;
    this.#state.set({ blind: true });
    return this.#playBlind(order[0]);
  }

  /** Shows which was which, and the one that is heard. */
  reveal() {
    const { heard } = this;
    this.#end();
    if (this.slots[heard]) this.#session.show(this.slots[heard]);
  }

  async #playBlind(n) {
    if (n === undefined) return;
    // Played alone: nothing else on the page hears of it.
    try {
      if (!(await this.#loader.draft(() => this.#session.whole(this.slots[n]), this.slots[n]))) return;
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      // The server has it no longer, which cannot be said blindly.
      this.heard = n;
      return this.reveal();
    }
    this.heard = n;
    this.emit("change");
  }

  #end() {
    this.order = null;
    this.#state.set({ blind: false });
    this.emit("change");
  }

  /** Something was shown: a slot, or what is in none. */
  #shown() {
    if (this.order) this.#end();
    const { current } = this.#session;
    if (this.slots[this.heard] !== current) this.heard = this.slots.indexOf(current);
    this.emit("change");
  }
}
