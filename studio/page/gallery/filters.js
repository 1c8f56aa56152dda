// What is looked for in a library: words, an order, ranges of the attributes.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { ATTRIBUTES } from "./attributes.js";
import { Span } from "./span.js";

const ORDERS = ["library", "name", ...ATTRIBUTES.flatMap(({ name }) => [`${name} falling`, `${name} rising`])];
/** Typing goes on before the list changes, ms. */
const TYPING_MS = 120;

export class Filters {
  #timer = null;
  #changed;
  #spans;
  #count;

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
    this.#spans = ATTRIBUTES.map((attribute) => new Span(attribute, this.#changed));
    this.#count = element("span", { class: "count" });
    this.details = element("details", { class: "ranges" },
      element("summary", {}, texts.gallery.ranges, " ", this.#count),
      ...this.#spans.map((span) => span.element),
      element("button", { type: "button", class: "quiet", onclick: () => this.reset() }, texts.gallery.reset));
    this.element = element("div", { class: "filters" }, this.search, this.order, this.details);
  }

  /** Takes the ends of a library; words and order stay. */
  begin(library) {
    this.#spans.forEach((span) => span.begin(library.ends[span.attribute.name]));
    this.#tell();
  }

  /** What `Library.choose` takes. */
  get wanted() {
    const [by, way] = this.order.value.split(" ");
    const ranges = this.#spans.filter(({ range }) => range).map(({ attribute, range }) => [attribute.name, range]);
    return { words: this.search.value, order: { by, falling: way === "falling" }, ranges: Object.fromEntries(ranges) };
  }

  /** The attribute that orders, or `undefined`. */
  get attribute() {
    return ATTRIBUTES.find(({ name }) => name === this.wanted.order.by);
  }

  reset() {
    this.search.value = "";
    for (const span of this.#spans) span.reset();
    this.#changed();
  }

  #tell() {
    const count = Object.keys(this.wanted.ranges).length;
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
