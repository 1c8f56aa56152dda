// Earlier prompts, the latest first: by arrow keys in the field, and as a list.

import { element, find, recall, remember } from "./dom.js";
import { texts } from "./texts.js";

const MOST = 50;
const LISTED = 12;

export class History {
  #prompts;
  /** The place in the history, −1 for what is being typed. */
  #at = -1;
  #typed = "";
  #compile;

  constructor(compile) {
    const recalled = recall("history", []);
    this.#prompts = Array.isArray(recalled) ? recalled.filter((prompt) => typeof prompt === "string") : [];
    this.#compile = compile;
    find("forget").addEventListener("click", () => {
      this.#keep([]);
      find("prompt").focus();
    });
    this.#list();
  }

  add(prompt) {
    this.#at = -1;
    this.#keep([prompt, ...this.#prompts.filter((other) => other !== prompt)].slice(0, MOST));
  }

  /** The prompt one step older (1) or newer (−1) than what the field shows; `null` beyond the ends. */
  step(by, shown) {
    const at = this.#at + by;
    if (at < -1 || at >= this.#prompts.length) return null;
    if (this.#at === -1) this.#typed = shown;
    this.#at = at;
    return at === -1 ? this.#typed : this.#prompts[at];
  }

  /** Something else is being typed. */
  leave() {
    this.#at = -1;
  }

  #keep(prompts) {
    this.#prompts = prompts;
    remember("history", prompts);
    this.#list();
  }

  #list() {
    const entry = (prompt) => element("li", {},
      element("button", { type: "button", class: "link", title: texts.history.compile(prompt),
        onclick: () => this.#compile(prompt) }, prompt));
    const entries = this.#prompts.slice(0, LISTED).map(entry);
    find("history").replaceChildren(...(entries.length ? entries : [element("li", { class: "none" }, texts.history.none)]));
    find("forget").hidden = entries.length === 0;
  }
}
