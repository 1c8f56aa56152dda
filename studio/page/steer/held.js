// Whether a person moves a slider: from the first change until it is released, which with keys is when it rests.

/** After a key, the slider counts as released when it rests so long. */
const REST_MS = 400;

export class Held {
  on = false;
  #rest = null;
  #released;

  /** `moved` hears of every change, `released` once after the last. */
  constructor(input, { moved, released }) {
    this.#released = released;
    let byPointer = false;
    input.addEventListener("pointerdown", () => (byPointer = true));
    input.addEventListener("keydown", () => (byPointer = false));
    input.addEventListener("input", () => {
      this.on = true;
      clearTimeout(this.#rest);
      if (!byPointer) this.#rest = setTimeout(() => this.release(), REST_MS);
      moved();
    });
    // No change is told where a pointer comes back to where it began.
    for (const end of ["pointerup", "pointercancel", "blur"]) input.addEventListener(end, () => this.release());
    input.addEventListener("change", () => byPointer && this.release());
  }

  release() {
    clearTimeout(this.#rest);
    if (!this.on) return;
    this.on = false;
    this.#released();
  }
}
