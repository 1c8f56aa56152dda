// What the parts of the page share. A part sets values; others hear of those that changed.

export class State {
  #values;
  #listeners = new Map();

  constructor(values) {
    this.#values = { ...values };
  }

  get(name) {
    return this.#values[name];
  }

  set(values) {
    const changed = Object.keys(values).filter((name) => this.#values[name] !== values[name]);
    Object.assign(this.#values, values);
    const listeners = new Set(changed.flatMap((name) => this.#listeners.get(name) ?? []));
    for (const listener of listeners) listener(this.#values);
  }

  /** Calls `listener` with all values now, and when one of the named ones changed. */
  on(names, listener) {
    for (const name of names) this.#listeners.set(name, [...(this.#listeners.get(name) ?? []), listener]);
    listener(this.#values);
  }
}
