// The panel “Take it with you”: every file of the texture, and a library of the session.

import { announce, element, find } from "../dom.js";
import { notify, withdraw } from "../notices.js";
import { save } from "../save.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";
import { fileName, kindsOf } from "./kinds.js";
import { Pack } from "./pack.js";

const COLUMNS = [["own", "see", "hear"], ["tools", "code"]];

export class Out {
  #server;
  #texture = null;

  constructor({ server, state, loader }) {
    this.#server = server;
    this.title = element("span", { class: "file" });
    this.kinds = element("div", { class: "kinds" });
    const pack = new Pack({ server, loader });
    find("take").append(
      element("div", { class: "row" }, element("h2", { id: "take-title" }, texts.files.take), this.title,
        element("button", { type: "button", class: "quiet", popovertarget: "take", popovertargetaction: "hide" }, texts.files.close)),
      this.kinds, pack.element);
    state.on(["texture", "about"], ({ texture, about }) => this.#show(texture, about));
  }

  #show(texture, about) {
    this.#texture = texture;
    find("take-button").disabled = texture === null;
    if (!texture || !about) return;
    this.title.textContent = texture.name;
    const button = (kind) => {
      const name = fileName(texture, kind.suffix);
      return element("li", {}, element("button", { type: "button", class: "kind", title: name, "data-ending": kind.ending,
        onclick: ({ currentTarget }) => this.#save(texture, kind, name, currentTarget) },
      element("span", { class: "label" }, kind.label), element("span", { class: "ending" }, kind.suffix.trim()),
      element("span", { class: "purpose" }, kind.purpose)));
    };
    const groups = kindsOf(about);
    const section = (group) => element("section", {}, element("h3", {}, texts.files.groups[group]),
      element("ul", {}, ...groups[group].map(button)));
    this.kinds.replaceChildren(...COLUMNS.map((column) => element("div", {},
      ...column.filter((group) => groups[group].length > 0).map(section))));
  }

  async #save(texture, { ending }, name, button) {
    if (button.getAttribute("aria-busy") === "true") return;
    button.setAttribute("aria-busy", "true");
    try {
      save(name, await this.#server.download(texture, ending));
      withdraw(`save ${ending}`);
      announce(texts.files.saved(name));
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      notify(`save ${ending}`, { text: texts.files.not_saved(name, error.message), help: error.help });
    } finally {
      button.removeAttribute("aria-busy");
    }
  }
}
