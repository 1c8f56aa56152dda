// The pictures of a library as a list box: only the cells that are seen are in the document.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { Thumbnails } from "./thumbnails.js";

/** The least width of a cell, its gap, and the height of a name and of a note below the picture, rem. */
const LEAST_REM = 6.25;
const GAP_REM = 0.5;
const NAME_REM = 1.375;
const NOTE_REM = 0.9375;
/** Rows beyond the edges that are there already. */
const BEYOND = 1;

const rem = () => parseFloat(getComputedStyle(document.documentElement).fontSize);

export class Grid {
  address; pick; reached; chosen; isKept;
  #sizer = element("div", { class: "sizer" });
  #cells = new Map();
  #thumbnails = new Thumbnails();
  #library = null;
  #places = [];
  #note = null;
  /** Index into the places, −1 for none. */
  #active = -1;
  #shown = null;
  #layout = { columns: 1, width: 100, height: 100, gap: 8 };
  #frame = 0;
  /** Where the view rests; a list that is hidden forgets it. */
  #top = 0;
  #hidden = true;

  /**
   * `address(library, place)` promises that of a picture; `pick(place)` takes a texture; `reached(place)` hears of the
   * arrow keys; `chosen` are several at once, and `isKept(place)` tells those that have a star.
   */
  constructor({ address, pick, reached, chosen, isKept }) {
    Object.assign(this, { address, pick, reached, chosen, isKept });
    this.element = element("div", { class: "cells", role: "listbox", tabindex: "0", "aria-multiselectable": "true", "aria-label": texts.gallery.pictures },
      this.#sizer);
    this.element.addEventListener("scroll", () => {
      if (this.element.clientWidth > 0) this.#top = this.element.scrollTop;
      this.#request();
    });
    this.element.addEventListener("keydown", (event) => this.#key(event));
    this.element.addEventListener("focus", () => this.#active < 0 && this.#activate(this.#first()));
    this.#sizer.addEventListener("click", (event) => {
      const cell = event.target.closest(".cell");
      if (!cell) return;
      this.#activate(Number(cell.dataset.index));
      this.#take(Number(cell.dataset.place), event);
    });
    new ResizeObserver(() => this.#resize()).observe(this.element);
  }

  /** Shows textures of a library; `note(place)`, or nothing, is what stands below a name. */
  show(library, places, note) {
    const kept = library.id === this.#library?.id ? this.#places[this.#active] : undefined;
    const top = library !== this.#library && library.id === this.#library?.id ? this.#top : 0;
    this.#clear();
    this.#library = library;
    this.#places = places;
    this.#note = note;
    this.#active = kept === undefined ? -1 : places.indexOf(kept);
    this.#top = top;
    this.#resize();
    this.element.scrollTop = top;
    this.#draw();
  }

  /** Marks the texture that is on the surface, and brings it into view if asked to. */
  choose(place, scroll = false) {
    this.#shown = place;
    this.mark();
    const index = place === null ? -1 : this.#places.indexOf(place);
    if (scroll && index >= 0) this.#activate(index);
  }

  /** What is chosen or kept has changed. */
  mark() {
    for (const cell of this.#cells.values()) this.#mark(cell);
  }

  /** Picks a texture, or chooses it as one of several. */
  #take(place, { ctrlKey, metaKey, shiftKey }) {
    if (ctrlKey || metaKey || shiftKey || this.chosen.isOn) this.chosen.toggle(place, this.#places, shiftKey);
    else {
      this.chosen.from(place);
      this.pick(place);
    }
  }

  #clear() {
    for (const index of [...this.#cells.keys()]) this.#remove(index);
  }

  #first() {
    const chosen = this.#shown === null ? -1 : this.#places.indexOf(this.#shown);
    if (chosen >= 0) return chosen;
    const { columns, height } = this.#layout;
    return Math.min(Math.ceil(this.element.scrollTop / height) * columns, this.#places.length - 1);
  }

  #resize() {
    const { clientWidth } = this.element;
    const shown = clientWidth > 0;
    if (shown && this.#hidden) this.element.scrollTop = this.#top;
    this.#hidden = !shown;
    if (!shown) return;
    const gap = GAP_REM * rem();
    const columns = Math.max(Math.floor((clientWidth + gap) / (LEAST_REM * rem() + gap)), 1);
    const width = (clientWidth - (columns - 1) * gap) / columns;
    const height = width + (NAME_REM + (this.#note ? NOTE_REM : 0)) * rem() + gap;
    // What was at the top stays there.
    const top = (this.element.scrollTop / this.#layout.height) * this.#layout.columns;
    const changed = height !== this.#layout.height || columns !== this.#layout.columns;
    this.#layout = { columns, width, height, gap };
    this.#sizer.style.height = `${Math.max(Math.ceil(this.#places.length / columns) * height - gap, 0)}px`;
    if (changed) {
      this.element.scrollTop = Math.floor(top / columns) * height;
      for (const [index, cell] of this.#cells) this.#place(cell, index);
    }
    this.#draw();
  }

  #request() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#draw();
    });
  }

  #draw() {
    const { columns, height } = this.#layout;
    const { scrollTop, clientHeight } = this.element;
    const from = Math.max(Math.floor(scrollTop / height) - BEYOND, 0) * columns;
    const to = Math.min((Math.ceil((scrollTop + clientHeight) / height) + BEYOND) * columns, this.#places.length);
    for (const index of [...this.#cells.keys()]) if (index < from || index >= to) this.#remove(index);
    const made = [];
    for (let index = from; index < to; index++) {
      if (this.#cells.has(index)) continue;
      made.push(this.#cell(index));
    }
    this.#sizer.append(...made);
    this.#pointAtActive();
  }

  #cell(index) {
    const place = this.#places[index];
    const { names, prompts } = this.#library;
    const image = element("img", { alt: "", decoding: "async", draggable: "false" });
    const prompt = prompts[place] && prompts[place] !== names[place] ? `\n${prompts[place]}` : "";
    const cell = element("div", { class: "cell", role: "option", id: `texture-${index}`, "data-index": index, "data-place": place,
      "aria-setsize": this.#places.length, "aria-posinset": index + 1, title: `${names[place]}${prompt}` },
    element("span", { class: "thumb" }, image), element("span", { class: "called" }, names[place]),
    ...(this.#note ? [element("span", { class: "amount" }, this.#note(place))] : []));
    this.#cells.set(index, cell);
    this.#place(cell, index);
    this.#mark(cell);
    const library = this.#library;
    this.#thumbnails.load(image, () => this.address(library, place));
    return cell;
  }

  #place(cell, index) {
    const { columns, width, height, gap } = this.#layout;
    cell.style.width = `${width}px`;
    cell.style.height = `${height - gap}px`;
    cell.style.transform = `translate(${(index % columns) * (width + gap)}px, ${Math.floor(index / columns) * height}px)`;
  }

  #mark(cell) {
    const place = Number(cell.dataset.place);
    cell.setAttribute("aria-selected", String(place === this.#shown));
    cell.setAttribute("aria-checked", String(this.chosen.has(place)));
    cell.classList.toggle("kept", this.isKept(place));
    cell.classList.toggle("active", Number(cell.dataset.index) === this.#active);
  }

  #remove(index) {
    const cell = this.#cells.get(index);
    this.#cells.delete(index);
    this.#thumbnails.drop(cell.querySelector("img"));
    cell.remove();
  }

  #pointAtActive() {
    if (this.#cells.has(this.#active)) this.element.setAttribute("aria-activedescendant", `texture-${this.#active}`);
    else this.element.removeAttribute("aria-activedescendant");
  }

  #activate(index) {
    if (index < 0 || index >= this.#places.length) return;
    this.#active = index;
    const { columns, height, gap } = this.#layout;
    const top = Math.floor(index / columns) * height;
    const { scrollTop, clientHeight } = this.element;
    if (top < scrollTop) this.element.scrollTop = top;
    else if (top + height - gap > scrollTop + clientHeight) this.element.scrollTop = top + height - gap - clientHeight;
    this.#draw();
    this.mark();
  }

  #key(event) {
    if (event.altKey || this.#places.length === 0) return;
    const several = event.ctrlKey || event.metaKey;
    if (several && event.key === "a") {
      event.preventDefault();
      return this.chosen.all(this.#places);
    }
    if (event.key === "Escape") return this.chosen.clear();
    if (several && event.key !== " ") return;
    const { columns, height } = this.#layout;
    const last = this.#places.length - 1;
    const page = Math.max(Math.floor(this.element.clientHeight / height), 1) * columns;
    const at = this.#active;
    const to = { ArrowLeft: at - 1, ArrowRight: at + 1, ArrowUp: at - columns, ArrowDown: at + columns,
      PageUp: Math.max(at - page, at % columns), PageDown: Math.min(at + page, last), Home: 0, End: last }[event.key];
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      if (at >= 0) this.#take(this.#places[at], event);
    } else if (to !== undefined) {
      event.preventDefault();
      if (to < 0 || to > last || to === at) return;
      this.#activate(to);
      this.reached(this.#places[to]);
    }
  }
}
