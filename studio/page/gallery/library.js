// One library: its columns, and which of its textures a search, ranges and an order choose.

import { ATTRIBUTES, endsOf, valuesOf } from "./attributes.js";

/** Without accents and case, so that “Käse” is found as “kase”. */
export const folded = (text) => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();

const byName = new Intl.Collator("en", { numeric: true, sensitivity: "base" });

export class Library {
  id; name; names; prompts; textures; certainty; count;
  #orders = new Map();
  #folded;
  #places;

  /** @param {Columns} columns */
  constructor(columns) {
    const { id, name, names, prompts, textures, certainty, notes = [] } = columns;
    Object.assign(this, { id, name, names, prompts, textures, certainty, count: names.length });
    this.values = Object.fromEntries(ATTRIBUTES.map((attribute) => [attribute.name, valuesOf(attribute, columns)]));
    this.ends = Object.fromEntries(ATTRIBUTES.map(({ name }) => [name, endsOf(this.values[name])]));
    this.#folded = names.map((name, place) => folded(`${name}\n${prompts[place] ?? ""}\n${notes[place] ?? ""}`));
    this.#places = new Map(names.map((name, place) => [name, place]));
  }

  /** The place of a name; `undefined` where it is missing. */
  placeOf(name) {
    return this.#places.get(name);
  }

  /** Names a place beyond this page. */
  origin(place) {
    return `${this.name}\n${this.names[place]}`;
  }

  /**
   * The places of the textures that have all `words`, one of the `certainties`, where there are any, and lie in
   * `ranges` ({ attribute: [low, high] }), in an `order` ({ by, falling, like }); and how many are left out because they
   * define no value of a range's attribute.
   */
  choose({ words, certainties, ranges, order }) {
    const sought = folded(words).split(/\s+/).filter(Boolean);
    const bounds = Object.entries(ranges).map(([name, [low, high]]) => ({ values: this.values[name], low, high }));
    let without = 0;
    const places = this.#ordered(order).filter((place) => {
      if (!sought.every((word) => this.#folded[place].includes(word))) return false;
      if (certainties && !certainties.includes(this.certainty[place])) return false;
      let known = true;
      for (const { values, low, high } of bounds) {
        if (values[place] < low || values[place] > high) return false;
        known &&= !Number.isNaN(values[place]);
      }
      if (!known) without++;
      return known;
    });
    return { places, without };
  }

  /** All places in an order; what defines no value comes last. */
  #ordered({ by, falling, like }) {
    if (by === "like") return this.#alike(like);
    const key = `${by} ${falling}`;
    if (!this.#orders.has(key)) this.#orders.set(key, this.#sorted(by, falling));
    return this.#orders.get(key);
  }

  /** What feels like these attributes first: each counts by its share of the library's span, and 1 where it is not defined. */
  #alike(like) {
    const away = new Float64Array(this.count);
    for (const { name, column, sign, log } of ATTRIBUTES) {
      if (!this.ends[name] || like[column] === null) continue;
      const scale = log ? Math.log : (value) => value;
      const [low, high] = this.ends[name].map(scale);
      const at = scale(sign * like[column]);
      this.values[name].forEach((value, place) => (away[place] += Number.isNaN(value) ? 1 : ((scale(value) - at) / (high - low || 1)) ** 2));
    }
    return Int32Array.from(away.keys()).sort((a, b) => away[a] - away[b] || a - b);
  }

  #sorted(by, falling) {
    const places = Int32Array.from({ length: this.count }, (_, place) => place);
    if (by === "library") return places;
    if (by === "name") return places.sort((a, b) => byName.compare(this.names[a], this.names[b]) || a - b);
    const values = this.values[by];
    const last = (value) => (Number.isNaN(value) ? 1 : 0);
    return places.sort((a, b) => last(values[a]) - last(values[b])
      || (last(values[a]) ? 0 : falling ? values[b] - values[a] : values[a] - values[b]) || a - b);
  }
}
