// The panel “Take it with you”: every file of the texture, and its link.

import { announce, busily, copy, element, find, notify, save, withdraw } from "../dom.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";

const COLUMNS = [["own", "see", "hear"], ["tools", "code"]];

const GROUPS = {
  own: ["asp", "json"],
  see: ["png", "normal.png", "height.png", "plot.png"],
  hear: ["listen.wav", "export.wav", "export.csv"],
  tools: ["export.hjif", "export.hmpg", "export.ahap", "export.haptic", "export.gltf"],
  code: ["export.c", "export.h", "export.rs"],
};
/** What follows the name of the texture's own file, where the ending alone would not tell. */
const SUFFIXES = { "normal.png": " normal.png", "height.png": " height.png", "plot.png": " plot.png", "export.wav": " acceleration.wav",
  "export.csv": " acceleration.csv", "listen.wav": ".wav" };

/** { group: [{ ending, suffix, label, purpose }] }, of `about`. */
function kindsOf({ exports, files, opens }) {
  const known = new Set(Object.values(GROUPS).flat());
  const offered = new Map(exports.map((entry) => [entry.ending, entry]));
  const kind = (ending) => {
    const [label, purpose] = texts.files.kinds[ending] ?? texts.files.other(offered.get(ending).format);
    return { ending, suffix: SUFFIXES[ending] ?? `.${offered.get(ending)?.file_ending ?? ending}`, label, purpose };
  };
  const isThere = (ending) => (files && !opens ? files.includes(ending) : !ending.startsWith("export.") || offered.has(ending));
  const others = [...offered.keys()].filter((ending) => !known.has(ending));
  return Object.fromEntries(Object.entries({ ...GROUPS, tools: [...GROUPS.tools, ...others] }).map(([group, endings]) =>
    [group, endings.filter(isThere).map(kind)]));
}

/** The name of such a file: `wet ice.asp` gives `wet ice.png`. */
const fileName = ({ file }, suffix) => file.replace(/\.asp$/, "") + suffix;

export class Out {
  #server;
  #links;

  constructor({ server, state, links }) {
    this.#server = server;
    this.#links = links;
    this.link = element("div", { class: "link-row" });
    this.title = element("span", { class: "file" });
    this.kinds = element("div", { class: "kinds" });
    find("take").append(
      element("div", { class: "row" }, element("h2", { id: "take-title" }, texts.files.take), this.title,
        element("button", { type: "button", class: "quiet", popovertarget: "take", popovertargetaction: "hide" }, texts.files.close)),
      this.kinds, this.link);
    state.on(["texture", "about"], ({ texture, about }) => this.#show(texture, about));
  }

  #show(texture, about) {
    find("take-button").disabled = texture === null;
    if (!texture || !about) return;
    this.title.textContent = texture.name;
    const button = (kind) => {
      const name = fileName(texture, kind.suffix);
      return element("li", {}, element("button", { type: "button", class: "kind", title: name, "data-ending": kind.ending,
        onclick: ({ currentTarget }) => busily(currentTarget, () => this.#save(texture, kind, name)) },
      element("span", { class: "label" }, kind.label), element("span", { class: "ending" }, kind.suffix.trim()),
      element("span", { class: "purpose" }, kind.purpose)));
    };
    this.#showLink(texture);
    const groups = kindsOf(about);
    const section = (group) => element("section", {}, element("h3", {}, texts.files.groups[group]),
      element("ul", {}, ...groups[group].map(button)));
    this.kinds.replaceChildren(...COLUMNS.map((column) => element("div", {},
      ...column.filter((group) => groups[group].length > 0).map(section))));
  }

  #showLink(texture) {
    const address = this.#links.address(texture);
    const title = element("h3", {}, texts.link.label);
    if (!address) return this.link.replaceChildren(title, element("p", { class: "small" }, texts.link.none));
    const code = element("code", { tabindex: "0", "aria-label": texts.link.label }, address);
    const button = element("button", { type: "button", id: "copy-link", onclick: () => copy(button, address, code) }, texts.copy.copy);
    this.link.replaceChildren(title, code, button, element("p", { class: "small" }, texture.link ? texts.link.about : texts.link.about_name));
  }

  async #save(texture, { ending }, name) {
    try {
      save(name, await this.#server.download(texture, ending));
      withdraw(`save ${ending}`);
      announce(texts.files.saved(name));
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      notify(`save ${ending}`, { text: texts.files.not_saved(name, error.message), help: error.help });
    }
  }
}
