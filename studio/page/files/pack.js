// The textures that were on the surface in this session, to choose a library from.

import { busily, element, save, showRefusal } from "../dom.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";

/** Bytes of a texture's name in a library. */
const NAME_BYTES = 64;
/** What has a file of its own is listed, but not chosen at first; neither is what the page began with. */
const HAS_FILE = ["open", "pick"];

const bytesOf = (text) => new TextEncoder().encode(text).length;

/** `name` itself, or with the first number that makes it another one than `taken`, within the bytes of a name. */
export function distinct(name, taken) {
  for (let n = 1; ; n++) {
    const end = n === 1 ? "" : ` ${n}`;
    let kept = [...name];
    while (bytesOf(kept.join("")) + end.length > NAME_BYTES) kept = kept.slice(0, -1);
    const tried = kept.join("").trim() + end;
    if (!taken.includes(tried)) return tried;
  }
}

export class Pack {
  #server;
  /** By the texture's name on the server: { texture, box, input }. */
  #entries = new Map();

  constructor({ server, loader }) {
    this.#server = server;
    this.list = element("ol", { class: "packs" });
    this.error = element("div", { class: "error", role: "alert" });
    this.button = element("button", { type: "button", class: "strong", id: "pack", onclick: () => busily(this.button, () => this.#pack()) });
    this.element = element("section", { class: "session-library", "data-needs": "server" }, element("h3", {}, texts.files.session),
      element("p", { class: "small" }, texts.files.session_hint), this.list, this.error, this.button);
    this.#count();
    loader.on("shown", ({ texture, how: { kind, begins } }) => this.#add(texture, !begins && !HAS_FILE.includes(kind)));
  }

  #add(texture, chosen) {
    if (this.#entries.has(texture.id)) return;
    const name = distinct(texture.name, [...this.#entries.values()].map(({ input }) => input.value));
    const box = element("input", { type: "checkbox", checked: chosen, "aria-label": texts.files.session_choose(name),
      onchange: () => this.#count() });
    const input = element("input", { type: "text", value: name, "aria-label": texts.files.session_name(name), spellcheck: "false",
      oninput: () => this.#count() });
    this.#entries.set(texture.id, { texture: { id: texture.id }, box, input });
    this.list.prepend(element("li", {}, box, input));
    this.#count();
  }

  get #chosen() {
    const chosen = [...this.#entries.values()].filter(({ box }) => box.checked);
    return chosen.map(({ texture, input }) => ({ texture, name: input.value.trim() }));
  }

  #count() {
    const chosen = this.#chosen;
    this.button.textContent = texts.files.pack(chosen.length);
    this.button.disabled = chosen.length === 0;
    showRefusal(this.error, null);
  }

  async #pack() {
    const chosen = this.#chosen;
    const names = chosen.map(({ name }) => name);
    const twice = names.find((name, n) => names.indexOf(name) !== n);
    const long = names.find((name) => bytesOf(name) > NAME_BYTES);
    const wrong = names.includes("") ? texts.files.name_empty : long !== undefined ? texts.files.name_long(long)
      : twice !== undefined ? texts.files.name_twice(twice) : null;
    if (wrong) return showRefusal(this.error, { message: wrong, help: texts.files.name_help });
    try {
      save(texts.files.session_file, await this.#server.pack(chosen));
      showRefusal(this.error, null);
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      showRefusal(this.error, { message: texts.files.not_packed(error.message), help: error.help });
    }
  }
}
