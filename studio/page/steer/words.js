// Changes in words, such as “less gritty, more waxy”, and what was understood of them.

import { element, find, showRefusal } from "../dom.js";
import { texts } from "../texts.js";

/** Smallest move that is shown, steps. */
const LEAST = 0.5;

export class Words {
  #parts;
  #input = element("input", { type: "text", id: "words", maxlength: 500, spellcheck: "false", autocapitalize: "off",
    "aria-describedby": "words-understood", placeholder: texts.steer.words.placeholder });
  #apply = element("button", { type: "submit" }, texts.steer.words.apply);
  #understood = element("p", { class: "small understood", id: "words-understood", role: "status" });
  #error = element("div", { class: "error", role: "alert" });
  #examples;

  constructor(parts) {
    this.#parts = parts;
    this.#examples = texts.steer.words.examples.map((example) => element("button", { type: "button", class: "example",
      onclick: () => this.#ask(example) }, example));
    const form = element("form", { class: "words-form", autocomplete: "off" },
      element("label", { for: "words" }, texts.steer.words.label), this.#input, this.#apply);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#ask(this.#input.value);
    });
    find("words-panel").append(form,
      element("div", { class: "examples", role: "group", "aria-label": texts.steer.words.try }, ...this.#examples), this.#understood, this.#error);
    parts.session.on("change", () => this.#show());
    parts.loader.on("refused", ({ refusal, how }) => how?.kind === "words" && showRefusal(this.#error, refusal));
    parts.state.on(["about"], () => this.#show());
  }

  #ask(words) {
    const { server, session, loader } = this.#parts;
    const text = words.trim();
    this.#input.value = text;
    if (!text) return showRefusal(this.#error, { message: texts.steer.words.empty });
    const { texture } = session.current;
    loader.take((signal) => server.edit(texture, { words: text }, signal), { kind: "words", words: text, of: texture });
  }

  #show() {
    const { session, state } = this.#parts;
    const entry = session.current;
    const enabled = entry?.texture.editable === true && state.get("about")?.prompts !== false;
    for (const control of [this.#input, this.#apply, ...this.#examples]) control.disabled = !enabled;
    showRefusal(this.#error, null);
    const by = entry?.how.kind === "words" ? entry : null;
    this.#understood.replaceChildren(...(by ? this.#moves(by) : []));
    if (by && this.#input.value === by.how.words) this.#input.value = "";
  }

  #moves({ how, texture }) {
    const moved = Object.entries(texture.made?.moved ?? {}).filter(([, by]) => Math.abs(by) >= LEAST);
    const moves = moved.map(([axis, by]) => element("span", { class: `move ${axis}` }, texts.steer.moved(axis, by)));
    const parts = moves.length ? moves.flatMap((move, n) => (n ? [", ", move] : [move])) : [texts.steer.words.nothing];
    return [`${texts.steer.words.said(how.words)} `, ...parts];
  }
}
