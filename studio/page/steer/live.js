// What is heard while a slider moves: one request at a time, the latest value next.

export class Live {
  #loader;
  #made = new Map();
  /** Done when the last request is. */
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

  /** Plays what `make()` gives as a draft. The same `key` means the same texture. */
  async hear(key, make) {
    this.#next = { key, make };
    if (this.#running) return;
    this.#running = true;
    while (this.#next) {
      const { key, make } = this.#next;
      this.#next = null;
      try {
        const texture = await this.#loader.draft(() => this.#once(key, make));
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
