// Several textures of a library at once: which are chosen, and what is done with them.

import { element, find, notify, withdraw } from "../dom.js";
import { OWN, tagsOf } from "../library/own.js";
import { letGo, saveLibrary } from "../library/panel.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";

/** After so many the project is written, since a server holds the last 256 textures alone. */
const AT_ONCE = 50;

export class Chosen {
  #parts;
  #library = null;
  #places = new Set();
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
    this.drop = button(texts.chosen.drop, () => letGo(parts.own, this.#items), { class: "quiet" });
    this.element = element("div", { class: "row chosen", hidden: true }, this.count, this.keep, this.tag, this.pack, this.drop,
      button(texts.chosen.clear, () => this.clear(), { class: "quiet" }));
  }

  /** Begins with a library, or with the same one as it is now. */
  begin(library) {
    const stays = library.id === this.#library?.id && library.count >= this.#library.count;
    this.#library = library;
    this.#places = stays ? this.#places : new Set();
    this.#show();
  }

  has(place) {
    return this.#places.has(place);
  }

  /** Whether a click chooses, and does not pick. */
  get isOn() {
    return this.several.getAttribute("aria-pressed") === "true";
  }

  /** Chooses a place or lets it go; `to` reaches there from the last one, in the order of `places`. */
  toggle(place, places, to = false) {
    const from = places.indexOf(this.#anchor);
    if (to && from >= 0) {
      const at = places.indexOf(place);
      for (const each of places.slice(Math.min(from, at), Math.max(from, at) + 1)) this.#places.add(each);
    } else if (!this.#places.delete(place)) {
      this.#places.add(place);
    }
    this.#anchor = place;
    this.#show();
  }

  all(places) {
    this.#places = new Set(places);
    this.#show();
  }

  clear() {
    this.#places.clear();
    this.several.setAttribute("aria-pressed", "false");
    this.#show();
  }

  get #items() {
    return this.#parts.own.items.filter((_, place) => this.#places.has(place));
  }

  #turn() {
    this.several.setAttribute("aria-pressed", String(!this.isOn));
  }

  #show() {
    const count = this.#places.size;
    const isOwn = this.#library?.id === OWN;
    this.element.hidden = count === 0;
    this.count.textContent = texts.chosen.count(count);
    this.keep.hidden = isOwn;
    for (const part of [this.tag, this.pack, this.drop]) part.hidden = !isOwn;
    this.changed();
  }

  #tag() {
    const tags = tagsOf(this.tag.value);
    this.tag.value = "";
    for (const item of this.#items) item.tags = [...new Set([...item.tags, ...tags])];
    this.#parts.own.emit("change");
  }

  /** Has the server open each, since only what it has opened can be kept. */
  async #keep() {
    const { server, own, from, flush } = this.#parts;
    const [library, places] = [this.#library, [...this.#places]];
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
