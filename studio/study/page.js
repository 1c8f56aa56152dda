// What every step has: its heading, its place in the study, what is missing, and the button that leads on.

import { element, find } from "../page/dom.js";
import { texts } from "./texts.js";

/** Paragraphs of a text, which empty lines part. */
export const paragraphs = (text) => text.split(/\n\s*\n/).map((part) => part.trim()).filter(Boolean).map((part) => element("p", {}, part));

export class Page {
  /** When the step was shown, ms of the page's clock. */
  shown_ms = 0;
  #title = "";
  #sending = false;
  #closed = false;
  #pressed = (/** @type {boolean} */ _is) => {};

  /** `gesture()` hears of every click that leads on. */
  constructor(gesture) {
    find("stage").setAttribute("aria-label", texts.stage.label);
    find("touched").setAttribute("aria-label", texts.stage.region);
    find("force-label").textContent = texts.stage.force;
    find("next").addEventListener("click", () => {
      gesture();
      this.#pressed(true);
    });
  }

  /** Where a step is in the study. */
  place({ index, of, title }) {
    this.#title = title;
    find("title").textContent = title;
    find("place").textContent = texts.place(index, of);
    // The end comes after the last step.
    Object.assign(find("progress"), { max: of, value: index });
    find("main").dataset.index = index;
  }

  /** Shows a step: its heading, which gets the focus, its content, and the label of the button, if it has one. */
  show({ heading, kind, content, next = null, touched = false }) {
    if (this.#closed) return;
    this.sending(false);
    find("main").dataset.kind = kind;
    find("touched").hidden = !touched;
    find("step").replaceChildren(...content);
    Object.assign(find("next"), { hidden: next === null, textContent: next ?? "" });
    document.title = this.#title ? texts.titled(heading, this.#title) : heading;
    const title = find("heading");
    title.textContent = heading;
    title.focus({ preventScroll: true });
    scrollTo(0, 0);
    this.shown_ms = performance.now();
  }

  /** Something that takes a moment. */
  wait(text) {
    this.show({ heading: text, kind: "wait", content: [] });
  }

  /** Shows a page that nothing follows. */
  close(heading, text) {
    this.show({ heading, kind: "end", content: paragraphs(text) });
    this.#closed = true;
  }

  /** The surface joins a step that is shown already. */
  join() {
    find("touched").hidden = false;
  }

  /** Says what is missing; without anything, the step can be left. */
  missing(parts, otherwise = "") {
    if (this.#sending) return;
    const text = texts.missing.all(parts) || otherwise;
    if (find("missing").textContent !== text) find("missing").textContent = text;
    find("next").disabled = parts.length > 0;
  }

  /** Resolves with true when the person goes on, and false when the step is not open any more. @returns {Promise<boolean>} */
  pressed() {
    return new Promise((done) => (this.#pressed = done));
  }

  /** Gives up the step that is shown. */
  interrupt() {
    this.#pressed(false);
  }

  /** Nobody answers twice while an answer is on its way. */
  sending(on) {
    this.#sending = on;
    for (const id of ["step", "touched"]) find(id).inert = on;
    const button = find("next");
    button.disabled = on;
    button.setAttribute("aria-busy", String(on));
    find("missing").textContent = on ? texts.missing.sending : "";
  }
}
