// Choosing one texture: of the session, of the slots, or by words, which are compiled.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { describe } from "./timeline.js";

const WORDS = "words";

export class Choice {
  element;
  #select;
  #input;
  #pool = new Map();
  /** Whether a person chose. */
  #chose = false;
  /** What the words were compiled to. */
  #compiled = null;
  #server;

  /** `pool()` gives [label of a group, [[label, texture]]]; `changed` hears of another choice. */
  constructor({ server, name, label, words, changed }) {
    this.#server = server;
    this.#select = element("select", { id: `mix-${name}`, onchange: () => this.#chosen(changed) });
    this.#input = element("input", { type: "text", id: `mix-${name}-words`, list: words, maxlength: 2000, hidden: true,
      "aria-label": texts.steer.mix.words_of(label), placeholder: texts.steer.mix.placeholder, onchange: changed,
      spellcheck: "false", autocapitalize: "off", autocomplete: "off" });
    this.element = element("div", { class: "pick" }, element("label", { for: `mix-${name}` }, label), this.#select, this.#input);
  }

  /** Offers slots and entries; what a person chose stays, else `otherwise` is; `forced` takes its place. */
  offer({ slots, entries }, otherwise, forced = null) {
    const byWords = this.#select.value === WORDS && this.#input.value.trim() !== "";
    const keeps = byWords && (!forced || forced.id === this.#compiled?.id);
    const chosen = keeps ? null : forced || (this.#chose && this.#pool.get(this.#select.value));
    this.#pool.clear();
    const option = (key, label, texture) => {
      this.#pool.set(key, texture);
      return element("option", { value: key }, label);
    };
    const group = (label, options) => (options.length ? [element("optgroup", { label }, ...options)] : []);
    const known = chosen && !entries.some(({ texture }) => texture.id === chosen.id) && !slots.some(({ texture }) => texture.id === chosen.id);
    this.#select.replaceChildren(
      ...group(texts.steer.mix.session, entries.map((entry, n) =>
        option(`e${n}`, texts.steer.timeline.entry(n + 1, describe(entry)), entry.texture))),
      ...group(texts.steer.mix.slots, slots.map(({ label, texture }, n) => option(`s${n}`, label, texture))),
      ...(known ? group(texts.steer.mix.chosen, [option("c", chosen.name, chosen)]) : []),
      element("option", { value: WORDS }, texts.steer.mix.words));
    const wanted = keeps ? undefined : (chosen || otherwise)?.id;
    const key = wanted === undefined ? WORDS : [...this.#pool].find(([, texture]) => texture.id === wanted)?.[0] ?? WORDS;
    this.#select.value = key;
    this.#input.hidden = key !== WORDS;
  }

  /** What names the choice; empty without one. */
  get key() {
    const words = this.#input.value.trim();
    return this.#select.value === WORDS ? words && `${WORDS} ${words}` : this.#pool.get(this.#select.value)?.id ?? "";
  }

  /** The texture; words are compiled once. */
  async texture() {
    if (this.#select.value !== WORDS) return this.#pool.get(this.#select.value);
    const prompt = this.#input.value.trim();
    if (this.#compiled?.compiled.prompt !== prompt) this.#compiled = await this.#server.compile({ prompt });
    return this.#compiled;
  }

  #chosen(changed) {
    this.#chose = true;
    this.#input.hidden = this.#select.value !== WORDS;
    if (!this.#input.hidden) this.#input.focus();
    changed();
  }
}
