// What is heard while a slider moves: one request at a time, the latest value next; and while a person moves it.

export class Live {
  #loader;
  #made = new Map();
  /** Done when the last request is. */
  /** @type {Promise<any>} */
  #last = Promise.resolve();
  #next = null;
  #running = false;
  #heard;
  #refused;

  /** `heard` takes the texture of a draft, `refused` what the server says against one. */
  constructor(loader, heard, refused) {
    this.#loader = loader;
    this.#heard = heard;
    this.#refused = refused;
  }

  /** Plays what `make()` gives as a draft. The same `key` means the same texture; `base` is what sliders began at. */
  async hear(key, make, base) {
    this.#next = { key, make, base };
    if (this.#running) return;
    this.#running = true;
    while (this.#next) {
      const { key, make, base } = this.#next;
      this.#next = null;
      try {
        const texture = await this.#loader.draft(() => this.#once(key, make), { base });
        if (texture) this.#heard(texture);
      } catch (refusal) {
        if (this.#next) continue;
        this.#refused(refusal);
      }
    }
    this.#running = false;
  }

  /** Shows what `make()` gives; `how` as of the loader. What has the key of a draft is not asked for again. */
  settle(key, make, how) {
    this.#next = null;
    return this.#loader.take(() => this.#once(key, make), how);
  }

  /** Other drafts begin, from another texture. */
  forget() {
    this.#next = null;
    this.#made.clear();
  }

  #once(key, make) {
    if (!this.#made.has(key)) {
      const making = this.#last.then(make);
      this.#last = making.catch(() => this.#made.delete(key));
      this.#made.set(key, making);
    }
    return this.#made.get(key);
  }
}

/** After a key, the slider counts as released when it rests so long. */
const REST_MS = 400;

/** Whether a person moves a slider: from the first change until it is released, which with keys is when it rests. */
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
