// Words to end the prompt with: known materials and qualities, as an ARIA combobox with a list.

import { announce, element } from "./dom.js";
import { texts } from "./texts.js";

const MOST = 8;
/** Words at the prompt's end that may together be the start of one name. */
const LONGEST_NAME = 4;

/** The words to suggest after `before`, each with the place where it replaces the end of the prompt. */
export function suggest(before, words) {
  const ends = [...before.matchAll(/[^\s,;]+/g)].slice(-LONGEST_NAME).map((match) => match.index);
  if (ends.length === 0 || /[\s,;]$/.test(before)) return [];
  const found = new Map();
  const add = (rank, at, word) => found.has(word) || found.set(word, { rank, at, word });
  for (const at of ends) {
    const typed = before.slice(at).toLowerCase();
    if (typed.length < 2) continue;
    for (const word of words) {
      const known = word.toLowerCase();
      if (known === typed) continue;
      if (known.startsWith(typed)) add(0, at, word);
      else if (at === ends.at(-1) && known.split(/[\s-]/).some((part) => part.startsWith(typed))) add(1, at, word);
    }
  }
  return [...found.values()]
    .sort((a, b) => a.rank - b.rank || a.at - b.at || a.word.length - b.word.length || (a.word < b.word ? -1 : 1))
    .slice(0, MOST);
}

export class Suggestions {
  #input;
  #list;
  #words = [];
  #found = [];
  #active = -1;

  constructor(input, list) {
    this.#input = input;
    this.#list = list;
    input.addEventListener("input", () => this.#update());
    input.addEventListener("blur", () => this.close());
    // Before the field loses the focus.
    list.addEventListener("pointerdown", (event) => event.preventDefault());
  }

  set words(words) {
    this.#words = words;
  }

  get open() {
    return this.#found.length > 0;
  }

  /** Whether the list took the key. */
  key(event) {
    if (!this.open) return false;
    switch (event.key) {
      case "ArrowDown":
      case "ArrowUp":
        this.#choose(this.#active + (event.key === "ArrowDown" ? 1 : -1));
        return true;
      case "Escape":
        this.close();
        return true;
      case "Enter":
        if (this.#active < 0) return false;
        this.#take(this.#active);
        return true;
    }
    return false;
  }

  close() {
    this.#show([]);
  }

  #update() {
    const { value, selectionEnd } = this.#input;
    this.#show(selectionEnd === value.length ? suggest(value, this.#words) : []);
    if (this.open) announce(texts.prompt.suggested(this.#found.length));
  }

  #show(found) {
    this.#found = found;
    this.#list.replaceChildren(...found.map(({ word }, n) =>
      element("li", { role: "option", id: `suggestion-${n}`, "aria-selected": "false", onclick: () => this.#take(n) }, word)));
    this.#list.hidden = found.length === 0;
    this.#input.setAttribute("aria-expanded", String(found.length > 0));
    this.#choose(-1);
  }

  /** One beyond either end is the field itself. */
  #choose(n) {
    const count = this.#found.length;
    this.#active = n < -1 ? count - 1 : n >= count ? -1 : n;
    [...this.#list.children].forEach((option, at) => option.setAttribute("aria-selected", String(at === this.#active)));
    if (this.#active < 0) this.#input.removeAttribute("aria-activedescendant");
    else {
      this.#input.setAttribute("aria-activedescendant", `suggestion-${this.#active}`);
      this.#list.children[this.#active].scrollIntoView({ block: "nearest" });
    }
  }

  #take(n) {
    const { at, word } = this.#found[n];
    this.#input.value = this.#input.value.slice(0, at) + word;
    this.#input.focus();
    this.close();
  }
}
