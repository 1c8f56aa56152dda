// The gallery: which library is shown, how, and what is picked from it.

import { element, find, notify, withdraw } from "../dom.js";
import { OWN } from "../library/own.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";
import { valueText } from "./attributes.js";
import { Chosen } from "./chosen.js";
import { Compare } from "./compare.js";
import { Filters } from "./filters.js";
import { Grid } from "./grid.js";
import { Library } from "./library.js";
import { mountScatter } from "./scatter.js";
import { startViews } from "./views.js";

/** How long the arrow keys rest before what they reached is picked, ms. */
const REACHED_MS = 150;
/** Textures whose places are known: more than a session has. */
const MOST_ORIGINS = 256;

class Gallery {
  #parts;
  #libraries = [];
  #library = null;
  /** Where the textures that were picked come from, by their names on the server. */
  #origins = new Map();
  /** The origins of what is kept. */
  #kept = new Set();
  #timer = null;
  #views;
  #mode = "pictures";
  /** What grid and scatter show now. */
  #listed = "";

  constructor(parts) {
    this.#parts = parts;
    const { server, state, own, flush } = parts;
    const pick = (place) => this.#pick(this.#library, place);
    const address = (library, place) => server.thumbnail(library, place);
    this.chosen = new Chosen({ server, own, flush, from: (library, place) => library.origin(place) }, () => this.grid?.mark());
    this.grid = new Grid({ address, pick, reached: (place) => this.#reached(place), chosen: this.chosen,
      isKept: (place) => this.#library !== null && this.#library.id !== OWN && this.#kept.has(this.#library.origin(place)) });
    this.plot = element("div", { class: "plots scatter" });
    this.compare = new Compare({ server, pick: (library, name) => this.#pick(library, library.placeOf(name)) });
    this.filters = new Filters(() => this.#list());
    this.#build();
    this.scatter = mountScatter(this.plot, pick, address);
    this.#views = startViews(() => this.#list());
    let begun = false;
    state.on(["about"], ({ about }) => {
      if (!about || begun) return;
      begun = true;
      if (about.library?.id) this.add(about.library);
    });
    state.on(["texture"], ({ texture }) => this.#mark(texture));
    own.on("change", () => this.#follow());
  }

  /** Where a texture was picked from a library, as a project keeps it. */
  from({ id }) {
    const picked = this.#origins.get(id);
    if (picked) return picked.library.origin(picked.place);
    const library = this.#libraries.find((each) => each.id !== OWN && each.textures?.includes(id));
    return library?.origin(library.textures.indexOf(id));
  }

  /** Shows the library of one's own. */
  browse() {
    this.#show(this.#libraries.find(({ id }) => id === OWN));
    this.#views.show("gallery");
  }

  /** Follows what is kept. */
  #follow() {
    const { own } = this.#parts;
    this.#kept = own.origins;
    const others = this.#libraries.filter(({ id }) => id !== OWN);
    const library = own.items.length > 0 ? new Library(own.columns) : null;
    this.#libraries = library ? [...others, library] : others;
    this.#offer();
    if (!this.modes.firstChild) this.#offerModes();
    if (this.#library && this.#library.id !== OWN) return this.grid.mark();
    const shown = library ?? others[0];
    this.invitation.hidden = Boolean(shown);
    this.body.hidden = !shown;
    if (shown) this.#show(shown);
    else this.#library = null;
  }

  /** Shows a library, as the server describes it, and keeps it with those that were there. */
  async add({ id, name }) {
    try {
      const known = this.#libraries.find((library) => library.id === id);
      const library = known ?? new Library(await this.#parts.server.library(id));
      if (!known) this.#libraries.push(library);
      withdraw("gallery");
      this.#offer();
      this.#offerModes();
      this.#show(library);
      this.#views.show("gallery");
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      notify("gallery", { text: texts.gallery.failed(name, error.message), help: error.help,
        action: { label: texts.server.retry, run: () => this.add({ id, name }) } });
    }
  }

  #build() {
    this.choice = element("select", { id: "gallery-library", "aria-label": texts.gallery.library, hidden: true,
      onchange: ({ target }) => this.#show(this.#libraries.find(({ id }) => id === target.value)) });
    this.name = element("span", { class: "library" });
    this.count = element("p", { class: "small", role: "status" });
    this.modes = element("div", { class: "segments modes", role: "group", "aria-label": texts.gallery.show });
    this.like = element("button", { type: "button", class: "quiet", id: "like", onclick: () => this.#like() }, texts.gallery.like);
    this.follow = element("input", { type: "checkbox", id: "gallery-follow", checked: true });
    this.following = element("label", { class: "small follow" }, this.follow, " ", texts.gallery.follow);
    this.none = element("p", { class: "none" }, texts.gallery.nothing, " ",
      element("button", { type: "button", class: "quiet", onclick: () => this.filters.reset() }, texts.gallery.reset));
    this.body = element("div", { class: "shelf", hidden: true },
      element("div", { class: "tools" }, this.filters.element,
        element("div", { class: "row" }, this.modes, this.count, this.like, this.chosen.several), this.chosen.element),
      this.grid.element, this.plot, this.compare.element, this.none,
      this.following);
    this.invitation = element("div", { class: "start" }, element("p", {}, texts.gallery.invitation),
      element("button", { type: "button", class: "strong", onclick: () => find("open").click() }, texts.files.open),
      element("p", { class: "small" }, texts.gallery.invitation_command),
      element("code", {}, texts.gallery.command));
    find("gallery").append(
      element("div", { class: "row" }, element("h2", { id: "gallery-title" }, texts.gallery.title), this.name, this.choice),
      this.invitation, this.body);
  }

  #offer() {
    const several = this.#libraries.length > 1;
    this.choice.hidden = !several;
    this.name.hidden = several;
    this.choice.replaceChildren(...this.#libraries.map(({ id, name, count }) =>
      element("option", { value: id }, texts.gallery.named(name, count))));
    if (this.#library) this.choice.value = this.#library.id;
  }

  #offerModes() {
    const files = this.#libraries.filter(({ id }) => id !== OWN);
    const several = files.length > 1;
    this.compare.offer(files);
    const modes = ["pictures", "scatter", ...(several ? ["compare"] : [])];
    this.modes.style.gridTemplateColumns = `repeat(${modes.length}, auto)`;
    this.modes.replaceChildren(...modes.map((mode) => element("label", {},
      element("input", { type: "radio", name: "gallery-mode", value: mode, checked: mode === this.#mode,
        onchange: () => this.#turn(mode) }), element("span", {}, texts.gallery.modes[mode]))));
  }

  #turn(mode) {
    this.#mode = mode;
    this.#list();
    if (mode === "compare") this.compare.open();
  }

  /** Orders by how much is like what is on the surface. */
  #like() {
    const texture = this.#parts.state.get("texture");
    if (texture) this.filters.like(texture);
  }

  #show(library) {
    const isSame = library.id === this.#library?.id && JSON.stringify(library.ends) === JSON.stringify(this.#library.ends);
    this.#library = library;
    this.#listed = "";
    this.chosen.begin(library);
    this.choice.value = library.id;
    this.name.textContent = texts.gallery.named(library.name, library.count);
    this.invitation.hidden = true;
    this.body.hidden = false;
    if (!isSame) this.filters.begin(library);
    this.#list();
    this.#mark(this.#parts.state.get("texture"), true);
  }

  #list() {
    if (!this.#library) return;
    const { wanted } = this.filters;
    const { places, without } = this.#library.choose(wanted);
    const { attribute } = this.filters;
    const values = attribute && this.#library.values[attribute.name];
    const compares = this.#mode === "compare";
    this.count.textContent = compares ? "" : texts.gallery.found(places.length, this.#library.count, without);
    this.none.hidden = compares || places.length > 0;
    this.filters.element.hidden = compares;
    this.grid.element.hidden = this.#mode !== "pictures" || places.length === 0;
    this.plot.hidden = this.#mode !== "scatter" || places.length === 0;
    this.compare.element.hidden = !compares;
    this.following.hidden = this.#mode !== "pictures";
    const listed = JSON.stringify([this.#library.id, wanted]);
    if (listed === this.#listed) return;
    this.#listed = listed;
    this.chosen.list(places);
    this.grid.show(this.#library, places, values && ((place) => valueText(attribute, values[place])));
    this.scatter.show(this.#library, places);
  }

  #reached(place) {
    clearTimeout(this.#timer);
    if (this.follow.checked) this.#timer = setTimeout(() => this.#pick(this.#library, place, true), REACHED_MS);
  }

  /** `walks` where arrow keys pass by. */
  #pick(library, place, walks = false) {
    clearTimeout(this.#timer);
    const { server, loader } = this.#parts;
    loader.take(async (signal) => {
      const texture = await (library.id === OWN ? server.shown({ id: library.textures[place] }, signal) : server.pick(library, place, signal));
      if (library.id !== OWN) this.#origins.set(texture.id, { library, place });
      if (this.#origins.size > MOST_ORIGINS) this.#origins.delete(this.#origins.keys().next().value);
      return texture;
    }, { kind: "pick", name: library.names[place], walks });
  }

  /** Marks the texture on the surface in the library that is shown. */
  #mark(texture, scroll = false) {
    const origin = texture && this.#origins.get(texture.id);
    const known = texture ? (this.#library?.textures?.indexOf(texture.id) ?? -1) : -1;
    const place = origin && origin.library === this.#library ? origin.place : known >= 0 ? known : null;
    this.grid.choose(place, scroll);
    this.scatter.choose(place);
  }
}

export function startGallery(parts) {
  const { loader } = parts;
  const gallery = new Gallery(parts);
  loader.on("refused", ({ refusal: { message, help }, how }) => {
    if (how?.kind === "pick") notify("pick", { text: texts.gallery.not_picked(how.name, message), help });
  });
  loader.on("shown", ({ how: { kind } }) => kind === "pick" && withdraw("pick"));
  return gallery;
}
