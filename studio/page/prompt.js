// The field: typing, suggestions, history, and what the server said against the prompt.

import { element, find, showRefusal } from "./dom.js";
import { History } from "./prompt-history.js";
import { Suggestions } from "./suggest.js";
import { texts } from "./texts.js";

/** A second click of those who double-click comes sooner. */
const LONG_MS = 2000;

export class Prompt {
  #input = find("prompt");
  #error = find("prompt-error");
  #suggestions = new Suggestions(find("prompt"), find("suggestions"));
  #history;
  /** What compiled last. */
  #compiled = "";
  #busy = false;
  /** Whether a prompt compiles for so long that the button gives it up. */
  #long = false;
  #timer = null;

  /** `compile` takes the text of a prompt, `cancel` gives it up. */
  constructor(compile, cancel) {
    this.cancel = cancel;
    this.compile = (prompt) => {
      const text = prompt.trim();
      this.#input.value = text;
      this.#suggestions.close();
      if (text) compile(text);
      else this.refuse({ message: texts.prompt.empty });
    };
    this.#history = new History(this.compile);
    find("compile").addEventListener("click", (event) => {
      if (!this.#long) return;
      event.preventDefault();
      this.cancel();
    });
    find("prompt-form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.compile(this.#input.value);
    });
    this.#input.addEventListener("input", () => this.#history.leave());
    this.#input.addEventListener("keydown", (event) => this.#key(event));
  }

  set words(words) {
    this.#suggestions.words = words;
  }

  set busy(busy) {
    clearTimeout(this.#timer);
    this.#long = false;
    this.#busy = busy;
    find("compile").textContent = busy ? texts.prompt.compiling : texts.prompt.compile;
    if (busy) {
      this.#timer = setTimeout(() => {
        this.#long = true;
        find("compile").textContent = texts.prompt.cancel;
      }, LONG_MS);
    }
    find("prompt-form").setAttribute("aria-busy", String(busy));
  }

  /** The server compiles no prompts. */
  withdraw() {
    for (const id of ["prompt", "compile"]) find(id).disabled = true;
    find("prompt-hint").textContent = texts.prompt.none;
    find("invitation").replaceChildren(element("p", {}, texts.prompt.none));
  }

  /** The prompt compiled. */
  accept(prompt) {
    this.refuse(null);
    this.#compiled = prompt;
    this.#history.add(prompt);
  }

  /** An earlier prompt is back; what is being typed stays. */
  bring(prompt) {
    if (this.#input.value !== this.#compiled) return;
    this.#input.value = prompt;
    this.#compiled = prompt;
  }

  /** Shows an error with its help, or none. */
  refuse(refusal) {
    this.#input.setAttribute("aria-invalid", String(refusal !== null));
    showRefusal(this.#error, refusal);
  }

  #key(event) {
    // An input method is composing.
    if (event.isComposing || event.altKey || event.ctrlKey || event.metaKey) return;
    if (this.#suggestions.key(event)) return event.preventDefault();
    if (event.key === "Escape" && this.#busy) return this.cancel();
    const by = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    const earlier = this.#history.step(by, this.#input.value);
    if (earlier === null) return;
    this.#input.value = earlier;
    this.#input.setSelectionRange(earlier.length, earlier.length);
  }
}
