// What changed between two libraries, each texture to pick.

import { element } from "../dom.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";

/** Entries of a kind that are listed. */
const MOST = 300;

/** What changed in a texture, as `asperity diff` says it. */
function changes({ felt, spectrum_db, vibration_n, tap_n, stiffness_n_m, mu, depth_mm = [0, 0], picture, sections }) {
  const said = texts.gallery.changes;
  const parts = [];
  if (spectrum_db === null) parts.push(said.no_spectra);
  else if (spectrum_db[1] > 0) parts.push(said.spectra(...spectrum_db));
  for (const [name, [old, now]] of Object.entries({ vibration_n, tap_n, stiffness_n_m, mu, depth_mm })) {
    if (old !== now) parts.push(said[name](old, now));
  }
  if (picture) parts.push(said.picture);
  if (parts.length === 0) parts.push(said.only(sections.join(", ")));
  return { felt: felt.length ? said.felt(felt) : said.not_felt, parts: parts.join("; ") };
}

export class Compare {
  #server;
  #pick;
  #libraries = [];
  #abort = new AbortController();

  /** `pick(library, name)` takes a texture of one of the libraries. */
  constructor({ server, pick }) {
    this.#server = server;
    this.#pick = pick;
    const select = (label) => element("select", { "aria-label": label, onchange: () => this.#compare() });
    this.old = select(texts.gallery.before);
    this.now = select(texts.gallery.now);
    this.found = element("div", { class: "found", tabindex: "0", role: "group", "aria-label": texts.gallery.differences });
    this.element = element("div", { class: "compare" },
      element("div", { class: "axes" }, element("label", {}, texts.gallery.before, " ", this.old),
        element("label", {}, texts.gallery.now, " ", this.now)), this.found);
  }

  /** Offers libraries; the two last are compared. */
  offer(libraries) {
    this.#libraries = libraries;
    [this.old, this.now].forEach((select, n) => {
      select.replaceChildren(...libraries.map(({ name, id }, at) =>
        element("option", { value: id, selected: at === libraries.length - 2 + n }, name)));
    });
    if (libraries.length > 1 && this.element.isConnected) this.#compare();
  }

  /** It is seen now. */
  open() {
    if (this.#libraries.length > 1 && this.found.childElementCount === 0) this.#compare();
  }

  async #compare() {
    this.#abort.abort();
    this.#abort = new AbortController();
    const [old, now] = [this.old, this.now].map(({ value }) => this.#libraries.find(({ id }) => id === value));
    this.found.replaceChildren(element("p", { class: "none" }, texts.gallery.comparing));
    try {
      this.#show(await this.#server.difference(old, now, this.#abort.signal), old, now);
    } catch (error) {
      if (error.name === "AbortError") return;
      if (!(error instanceof Refusal)) throw error;
      this.found.replaceChildren(element("p", { class: "error" }, element("strong", {}, error.message), " ",
        error.help));
    }
  }

  #show({ added, removed, changed, same }, old, now) {
    const button = (library, name, text = name) => element("button", { type: "button", class: "link",
      title: texts.gallery.pick_from(name, library.name), onclick: () => this.#pick(library, name) }, text);
    const names = (library) => (name) => element("li", {}, button(library, name));
    const both = ([name, change]) => {
      const { felt, parts } = changes(change);
      return element("li", { class: "changed" }, element("strong", {}, name), element("span", { class: "sides" },
        button(old, name, texts.gallery.before), button(now, name, texts.gallery.now)),
      element("p", { class: "small" }, element("strong", {}, felt), " ", parts));
    };
    const list = (title, entries, item) => (entries.length === 0 ? [] : [
      element("h3", {}, texts.gallery.counted(title, entries.length)),
      ...(entries.length > MOST ? [element("p", { class: "small" }, texts.gallery.first(MOST))] : []),
      element("ul", {}, ...entries.slice(0, MOST).map(item))]);
    const changes_of = Object.entries(changed);
    this.found.replaceChildren(
      element("p", { class: "small" }, texts.gallery.same(same)),
      ...list(texts.gallery.changed, changes_of, both),
      ...list(texts.gallery.added, added, names(now)),
      ...list(texts.gallery.removed, removed, names(old)));
  }
}
