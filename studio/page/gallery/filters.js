// What is looked for in a library: words, an order, ranges of the attributes.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { ATTRIBUTES } from "./attributes.js";
import { Span } from "./span.js";

const ORDERS = ["library", "name", ...ATTRIBUTES.flatMap(({ name }) => [`${name} falling`, `${name} rising`])];
/** What a choice of certainty lets through, by the levels of the columns. */
const CERTAINTIES = { any: null, known: ["known"], close: ["close"], guess: ["guess", "no_contact"] };
/** Typing goes on before the list changes, ms. */
const TYPING_MS = 120;

export class Filters {
  #timer = null;
  #changed;
  #spans;
  #count;
  /** The attributes of what others are to be like. */
  #like = null;

  constructor(changed) {
    this.#changed = () => {
      clearTimeout(this.#timer);
      this.#tell();
      changed();
    };
    this.search = element("input", { type: "text", id: "gallery-search", "aria-label": texts.gallery.search,
      placeholder: texts.gallery.search, autocomplete: "off", spellcheck: "false", oninput: () => this.#typed(),
      onkeydown: (event) => this.#key(event) });
    this.order = element("select", { id: "gallery-order", "aria-label": texts.gallery.order, onchange: this.#changed },
      ...ORDERS.map((order) => element("option", { value: order }, texts.gallery.orders[order])));
    this.alike = element("option", { value: "like", hidden: true });
    this.order.append(this.alike);
    this.certainty = element("select", { id: "gallery-certainty", onchange: this.#changed },
      ...Object.keys(CERTAINTIES).map((level) => element("option", { value: level }, texts.gallery.certainties[level])));
    this.certain = element("label", { class: "certain" }, texts.gallery.certainty, " ", this.certainty);
    this.#spans = ATTRIBUTES.map((attribute) => new Span(attribute, this.#changed));
    this.#count = element("span", { class: "count" });
    this.details = element("details", { class: "ranges" },
      element("summary", {}, texts.gallery.ranges, " ", this.#count),
      this.certain, ...this.#spans.map((span) => span.element),
      element("button", { type: "button", class: "quiet", onclick: () => this.reset() }, texts.gallery.reset));
    this.element = element("div", { class: "filters" }, this.search, this.order, this.details);
  }

  /** Takes the ends of a library; words and order stay. */
  begin(library) {
    this.#spans.forEach((span) => span.begin(library.ends[span.attribute.name]));
    this.certain.hidden = !library.certainty?.some((level) => level !== null);
    if (this.certain.hidden) this.certainty.value = "any";
    this.#tell();
  }

  /** What `Library.choose` takes. */
  get wanted() {
    const [by, way] = this.order.value.split(" ");
    const ranges = this.#spans.filter(({ range }) => range).map(({ attribute, range }) => [attribute.name, range]);
    return { words: this.search.value, order: { by, falling: way === "falling", like: by === "like" ? this.#like : undefined },
      certainties: CERTAINTIES[this.certainty.value], ranges: Object.fromEntries(ranges) };
  }

  /** Orders by how much is like a texture, until another order is chosen. */
  like({ name, inspect }) {
    this.#like = inspect.attributes;
    this.alike.textContent = texts.gallery.alike(name);
    this.alike.hidden = false;
    this.order.value = "like";
    this.#changed();
  }

  /** The attribute that orders, or `undefined`. */
  get attribute() {
    return ATTRIBUTES.find(({ name }) => name === this.wanted.order.by);
  }

  reset() {
    this.search.value = "";
    this.certainty.value = "any";
    for (const span of this.#spans) span.reset();
    this.#changed();
  }

  #tell() {
    const { ranges, certainties } = this.wanted;
    const count = Object.keys(ranges).length + (certainties ? 1 : 0);
    this.#count.textContent = count ? texts.gallery.ranges_on(count) : "";
  }

  #typed() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(this.#changed, TYPING_MS);
  }

  #key(event) {
    if (event.key !== "Escape" || this.search.value === "") return;
    event.preventDefault();
    this.search.value = "";
    this.#changed();
  }
}
