// The textures that a person chose to keep: a library of their own, with a name, a note and tags for each.

import { save } from "../dom.js";
import { Events } from "../events.js";
import { texts } from "../texts.js";

/** What the gallery calls it among the libraries that files hold. */
export const OWN = "own";
/** Bytes of a texture's name in a library. */
const NAME_BYTES = 64;
/** What the gallery orders by, as the server's columns name it. */
const FIGURES = ["rough_db", "sharp_hz", "hard_hz", "mu"];

const bytesOf = (text) => new TextEncoder().encode(text).length;

/** `name` itself, or with the first number that makes it another one than `taken`, within the bytes of a name. */
export function distinct(name, taken) {
  for (let n = 1; ; n++) {
    const end = n === 1 ? "" : ` ${n}`;
    let kept = [...name];
    while (bytesOf(kept.join("")) + end.length > NAME_BYTES) kept = kept.slice(0, -1);
    const tried = kept.join("").trim() + end;
    if (!taken.has(tried)) return tried;
  }
}

/** `tags` as a person writes them: with commas, with or without a number sign. */
export const tagsOf = (text) => [...new Set(text.split(",").map((tag) => tag.trim().replace(/^#/, "")).filter(Boolean))];

/** Emits "change". An item is { id, name, note, tags, prompt, certainty, from, rough_db, … }, all that a project keeps of it. */
export class OwnLibrary extends Events {
  items = [];

  /** The item of a texture; `undefined` where it is not kept. */
  of(id) {
    return this.items.find((item) => item.id === id);
  }

  /** Keeps textures, [{ texture, from }], where `from` tells the place in a library that it was picked at. */
  keep(textures) {
    const names = new Set(this.items.map(({ name }) => name));
    for (const { texture: { id, name, inspect, certainty }, from } of textures) {
      if (this.of(id)) continue;
      const own = distinct(name, names);
      names.add(own);
      const figures = FIGURES.map((figure) => [figure, inspect.attributes[figure]]);
      this.items.push({ id, name: own, note: "", tags: [], prompt: inspect.prompt, certainty, from, ...Object.fromEntries(figures) });
    }
    this.emit("change");
  }

  /** Removes textures; gives what undoes that. */
  remove(ids) {
    const before = this.items;
    this.items = before.filter(({ id }) => !ids.has(id));
    this.emit("change");
    return () => {
      const since = this.items.filter(({ id }) => !before.some((item) => item.id === id));
      this.restore([...before, ...since]);
    };
  }

  /** What is wrong with a name for an item, or `null`. */
  fault(item, name) {
    if (name === "") return texts.own.name_empty;
    if (bytesOf(name) > NAME_BYTES) return texts.own.name_long(name);
    return this.items.some((other) => other !== item && other.name === name) ? texts.own.name_twice(name) : null;
  }

  change(item, fields) {
    Object.assign(item, fields);
    this.emit("change");
  }

  /** Adds tags to some. */
  tag(items, tags) {
    for (const item of items) item.tags = [...new Set([...item.tags, ...tags])];
    this.emit("change");
  }

  restore(items) {
    this.items = items;
    this.emit("change");
  }

  /** The places in libraries that textures were kept from. */
  get origins() {
    return new Set(this.items.map(({ from }) => from).filter(Boolean));
  }

  /** What the gallery shows of it: columns, as the server gives them of a library. */
  get columns() {
    const column = (name) => this.items.map((item) => item[name] ?? null);
    const notes = this.items.map(({ note, tags }) => [note, ...tags.map((tag) => `#${tag}`)].filter(Boolean).join(" "));
    return { id: OWN, name: texts.own.title, textures: column("id"), names: column("name"), prompts: column("prompt"), notes,
      certainty: column("certainty"), ...Object.fromEntries(FIGURES.map((figure) => [figure, column(figure)])) };
  }

  /** Saves items as the file of a library. */
  async pack(server, items) {
    save(texts.own.file, await server.pack(items.map(({ id, name }) => ({ texture: { id }, name }))));
  }
}
