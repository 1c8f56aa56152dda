// Events, by which the parts of the page hear of each other.

export class Events extends EventTarget {
  /** Calls `hear` with what `emit` gives it. */
  on(name, hear) {
    this.addEventListener(name, (event) => hear(/** @type {CustomEvent} */ (event).detail));
  }

  emit(name, detail = undefined) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}
