// The textures of this session in their order, and which of them is shown: undo and redo over everything.
//
// An entry is { texture, base, steps, how }: `steps` of the sliders lead from `base` to the texture, where `base` is what
// was there before the sliders moved. So an asset stores one edit, however often they move.

import { Events } from "../events.js";

const MOST = 200;

/** Emits "change". */
export class Session extends Events {
  entries = [];
  #at = -1;
  /** Where undo and redo have gone while the server answers. */
  #aim = null;
  #loader;

  constructor(loader) {
    super();
    this.#loader = loader;
    loader.on("shown", ({ texture, how }) => this.#shown(texture, how));
    loader.on("refused", () => (this.#aim = null));
  }

  get current() {
    return this.entries[this.#at] ?? null;
  }

  get at() {
    return this.#at;
  }

  get canUndo() {
    return this.#at > 0;
  }

  get canRedo() {
    return this.#at < this.entries.length - 1;
  }

  undo() {
    this.#step(-1);
  }

  redo() {
    this.#step(1);
  }

  /** Shows an entry again, also one that is in the list no longer. */
  show(entry) {
    const at = this.entries.indexOf(entry);
    this.#aim = at < 0 ? null : at;
    return this.#loader.take(async () => entry.texture, { kind: "undo", entry });
  }

  /** Plays what is shown, after drafts of something else. */
  sound() {
    const { current } = this;
    // Where the server has it no longer, what plays stays.
    if (current) this.#loader.draft(async () => current.texture, current.base).catch(() => {});
  }

  #step(by) {
    const entry = this.entries[(this.#aim ?? this.#at) + by];
    if (entry) this.show(entry);
  }

  #shown(texture, how) {
    this.#aim = null;
    const known = how.entry ?? (how.kind === "undo" && this.entries.find((entry) => entry.texture.id === texture.id));
    if (known) this.#return(known);
    else this.#add({ texture, base: how.base ?? texture, steps: how.steps ?? {}, how });
    this.emit("change");
  }

  #return(entry) {
    const at = this.entries.indexOf(entry);
    if (at >= 0) this.#at = at;
    else this.entries.splice(++this.#at, 0, entry);
    this.#limit();
  }

  /** What was undone goes; the same texture again is no change. */
  #add(entry) {
    const { current } = this;
    if (current?.texture.id === entry.texture.id && current.base.id === entry.base.id) return;
    this.entries.splice(++this.#at, Infinity, entry);
    this.#limit();
  }

  #limit() {
    while (this.entries.length > MOST) {
      // The oldest goes, unless it is the one shown.
      const oldest = this.#at > 0 ? 0 : this.entries.length - 1;
      this.entries.splice(oldest, 1);
      if (oldest === 0) this.#at--;
    }
  }
}
