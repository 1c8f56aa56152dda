// Several textures of a library at once: which are chosen, and what is done with them.

import { element, find, notify, withdraw } from "../dom.js";
import { OWN, tagsOf } from "../library/own.js";
import { remove, saveLibrary } from "../library/panel.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";

/** After so many the project is written, since a server holds the last 256 textures alone. */
const AT_ONCE = 50;

export class Chosen {
  #parts;
  #library = null;
  /** Places, or what names the textures of one's own library, whose places change. */
  #keys = new Set();
  #listed = [];
  /** Where a range begins. */
  #anchor = null;
  #abort = null;

  /** `changed()` hears of what is chosen. */
  constructor(parts, changed) {
    this.#parts = parts;
    this.changed = changed;
    const button = (label, run, attributes = {}) => element("button", { type: "button", onclick: run, ...attributes }, label);
    this.several = button(texts.chosen.several, () => this.#turn(), { class: "quiet", id: "several", "aria-pressed": "false", title: texts.chosen.several_title });
    this.count = element("span", { class: "small", role: "status" });
    this.keep = button(texts.chosen.keep, () => (this.#abort ? this.#abort.abort() : this.#keep()), { id: "keep-chosen", "data-needs": "server" });
    this.tag = element("input", { type: "text", "aria-label": texts.chosen.tag, placeholder: texts.chosen.tag, spellcheck: "false",
      onkeydown: ({ key }) => key === "Enter" && this.#tag() });
    this.pack = button(texts.chosen.pack, () => saveLibrary(parts.own, parts.server, this.#items));
    this.drop = button(texts.chosen.drop, () => remove(parts.own, this.#items), { class: "quiet" });
    this.element = element("div", { class: "row chosen", hidden: true }, this.count, this.keep, this.tag, this.pack, this.drop,
      button(texts.chosen.clear, () => this.clear(), { class: "quiet" }));
  }

  /** Begins with a library, or with the same one as it is now. */
  begin(library) {
    if (library.id !== this.#library?.id) this.#forget();
    this.#library = library;
    if (library.id === OWN) this.#keys = new Set([...this.#keys].filter((id) => library.textures.includes(id)));
    this.#show();
  }

  /** Hears which places the gallery lists. */
  list(places) {
    this.#listed = places;
    this.#show();
  }

  /** A range begins at what was picked. */
  from(place) {
    this.#anchor = this.#key(place);
  }

  has(place) {
    return this.#keys.has(this.#key(place));
  }

  /** Whether a click chooses, and does not pick. */
  get isOn() {
    return this.several.getAttribute("aria-pressed") === "true";
  }

  /** Chooses a place, or no longer; `to` reaches there from the last one, in the order of `places`. */
  toggle(place, places, to = false) {
    const keys = Array.from(places, (each) => this.#key(each));
    const [from, at] = [keys.indexOf(this.#anchor), places.indexOf(place)];
    if (to && from >= 0) for (const key of keys.slice(Math.min(from, at), Math.max(from, at) + 1)) this.#keys.add(key);
    else if (!this.#keys.delete(keys[at])) this.#keys.add(keys[at]);
    this.#anchor = keys[at];
    this.#show();
  }

  all(places) {
    this.#keys = new Set(Array.from(places, (place) => this.#key(place)));
    this.#show();
  }

  clear() {
    this.#forget();
    this.several.setAttribute("aria-pressed", "false");
    this.#show();
  }

  #forget() {
    this.#keys = new Set();
    this.#anchor = null;
  }

  #key(place) {
    return this.#library.id === OWN ? this.#library.textures[place] : place;
  }

  get #items() {
    return this.#parts.own.items.filter(({ id }) => this.#keys.has(id));
  }

  #turn() {
    this.several.setAttribute("aria-pressed", String(!this.isOn));
  }

  #show() {
    const count = this.#keys.size;
    const seen = this.#listed.reduce((sum, place) => sum + (this.has(place) ? 1 : 0), 0);
    const isOwn = this.#library?.id === OWN;
    this.element.hidden = count === 0;
    this.count.textContent = texts.chosen.count(count, count - seen);
    this.keep.hidden = isOwn;
    for (const part of [this.tag, this.pack, this.drop]) part.hidden = !isOwn;
    this.changed();
  }

  #tag() {
    const tags = tagsOf(this.tag.value);
    this.tag.value = "";
    this.#parts.own.tag(this.#items, tags);
  }

  /** Has the server open each, since only what it has opened can be kept. */
  async #keep() {
    const { server, own, from, flush } = this.#parts;
    const [library, places] = [this.#library, [...this.#keys]];
    this.#abort = new AbortController();
    const { signal } = this.#abort;
    withdraw("keep");
    this.keep.textContent = texts.chosen.stop;
    try {
      for (let n = 0; n < places.length; n += AT_ONCE) {
        const some = [];
        for (const place of places.slice(n, n + AT_ONCE)) {
          find("opening").textContent = texts.chosen.keeping(n + some.length + 1, places.length);
          some.push({ texture: await server.pick(library, place, signal), from: from(library, place) });
        }
        own.keep(some);
        await flush();
      }
      this.clear();
    } catch (error) {
      if (!(error instanceof Refusal) && error.name !== "AbortError") throw error;
      if (error instanceof Refusal) notify("keep", { text: texts.chosen.not_kept(error.message), help: error.help });
    } finally {
      this.#abort = null;
      find("opening").textContent = "";
      this.keep.textContent = texts.chosen.keep;
    }
  }
}
