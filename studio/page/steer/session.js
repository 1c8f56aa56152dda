// The textures of this session in their order, and which of them is shown: undo and redo over everything.
//
// An entry is { texture, base, steps, how }; of textures that are not shown, identifier and name are kept alone.
// In an entry, `steps` of the sliders lead from `base` to the texture, where `base` is what was there before the sliders
// moved. So an asset stores one edit, however often they move.

import { Events } from "../events.js";

const MOST = 200;
/** What of `how` says how an entry came about. */
const SAID = ["kind", "words", "t", "seed", "prompt", "walks"];

const slim = ({ id, name }) => ({ id, name });

/** What a project keeps of an entry. */
export const keptOf = ({ texture, base, steps, how }) => ({ texture: slim(texture), base: slim(base), steps,
  how: Object.fromEntries(SAID.filter((name) => how[name] !== undefined).map((name) => [name, how[name]])) });

/** Emits "change". */
export class Session extends Events {
  entries = [];
  #at = -1;
  /** Where undo and redo have gone while the server answers. */
  #aim = null;
  #loader;
  #server;

  constructor(loader, server) {
    super();
    this.#loader = loader;
    this.#server = server;
    loader.on("shown", ({ texture, how }) => this.#shown(texture, how));
    loader.on("refused", () => (this.#aim = null));
  }

  get current() {
    return this.entries[this.#at] ?? null;
  }

  get at() {
    return this.#at;
  }

  undo() {
    this.#step(-1);
  }

  redo() {
    this.#step(1);
  }

  /** Shows an entry again, also one that is in the list no longer. */
  show(entry, begins = false) {
    const at = this.entries.indexOf(entry);
    this.#aim = at < 0 ? null : at;
    return this.#loader.take((signal) => this.whole(entry, signal), { kind: "undo", entry, begins });
  }

  /** The texture of an entry, and its base, with all that the server knows of them. */
  async whole(entry, signal) {
    const { texture, base } = entry;
    const full = (part) => (part.inspect ? part : this.#server.shown(part, signal));
    entry.texture = await full(texture);
    entry.base = base.id === texture.id ? entry.texture : await full(base);
    return entry.texture;
  }

  /** What a project keeps of it. */
  get kept() {
    return { version: 1, entries: this.entries.map(keptOf), at: this.#at };
  }

  /** The entry of the same texture and base, or else this one itself. */
  like(entry) {
    return this.entries.find(({ texture, base }) => texture.id === entry.texture.id && base.id === entry.base.id) ?? entry;
  }

  /** Brings back what a project kept, and shows it. */
  restore({ entries, at }) {
    this.entries = entries;
    this.emit("change");
    return this.show(entries[at] ?? entries.at(-1), true);
  }

  /** Plays what is shown, after drafts of something else. */
  sound() {
    const { current } = this;
    // Where the server has it no longer, what plays stays.
    if (current) this.#loader.draft(() => this.whole(current), current).catch(() => {});
  }

  #step(by) {
    const entry = this.entries[(this.#aim ?? this.#at) + by];
    if (entry) this.show(entry);
  }

  #shown(texture, how) {
    this.#aim = null;
    const { current } = this;
    // Files do not say again what they said of a texture.
    if (current && current.texture.id !== texture.id && !this.#server?.exported) Object.assign(current, { texture: slim(current.texture), base: slim(current.base) });
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

  /** What was undone goes; the same texture again is no change. Walking through a gallery is one step, and undoes nothing. */
  #add(entry) {
    const { current } = this;
    if (current?.texture.id === entry.texture.id && current.base.id === entry.base.id) return;
    const walks = entry.how.walks === true;
    if (walks && current?.how.walks) this.entries[this.#at] = entry;
    else this.entries.splice(++this.#at, walks ? 0 : Infinity, entry);
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
