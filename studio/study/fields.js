// Questions: sliders that begin without a value, points of a scale, and texts.

import { element } from "../page/dom.js";
import { texts } from "./texts.js";

/** Scales with no more points than this between their ends are chosen from, not slid on. */
const MOST_POINTS = 10;

/** The field of an item: { element, name, value }, where `value` is null until it was given. `changed()` hears of it. */
export function field(item, changed) {
  if (item.text) return text(item, changed);
  return item.most - item.least <= MOST_POINTS ? points(item, changed) : slider(item, changed);
}

export function slider(item, changed) {
  const { name, question, low, high, least, most, step = 1 } = item;
  const id = `field-${name}`;
  const middle = least + step * Math.round((most - least) / 2 / step);
  const input = element("input", { type: "range", class: "rate", id, min: least, max: most, step, value: middle, "data-untouched": true,
    "aria-describedby": `${id}-low ${id}-high`, "aria-valuetext": texts.scale.untouched });
  const output = element("output", { for: id, class: "untouched" }, texts.scale.untouched);
  const made = {
    name,
    kind: "slider",
    value: null,
    element: element("div", { class: "field" }, element("label", { for: id }, question), input,
      element("p", { class: "ends" }, element("span", { id: `${id}-low` }, low), output, element("span", { id: `${id}-high` }, high))),
  };
  const touch = () => {
    made.value = Number(input.value);
    input.removeAttribute("data-untouched");
    input.setAttribute("aria-valuetext", texts.scale.spoken(made.value, item));
    output.className = "";
    output.textContent = texts.scale.value(made.value);
    changed();
  };
  input.addEventListener("input", touch);
  // The middle, where it stands already, is a value too: by a click, or by a key that confirms it.
  input.addEventListener("click", touch);
  input.addEventListener("keydown", ({ key }) => (key === "Enter" || key === " ") && touch());
  return made;
}

function points(item, changed) {
  const { name, question, low, high, least, most, step = 1 } = item;
  const made = { name, kind: "points", value: null, element: null };
  const values = Array.from({ length: Math.floor((most - least) / step) + 1 }, (_, n) => least + n * step);
  const choose = ({ target }) => {
    made.value = Number(target.value);
    changed();
  };
  made.element = element("fieldset", { class: "field" }, element("legend", {}, question),
    element("div", { class: "points" }, ...values.map((value) => element("label", {},
      element("input", { type: "radio", name: `field-${name}`, value, "aria-label": texts.scale.point(value, item), onchange: choose }),
      element("span", { "aria-hidden": "true" }, String(value))))),
    element("p", { class: "ends", "aria-hidden": "true" }, element("span", {}, low), element("span", {}, high)));
  return made;
}

function text({ name, question }, changed) {
  const id = `field-${name}`;
  const input = element("textarea", { id, rows: 3, maxlength: 4000 });
  const made = { name, kind: "text", value: "",
    element: element("div", { class: "field" }, element("label", { for: id }, question), input) };
  input.addEventListener("input", () => {
    made.value = input.value;
    changed();
  });
  return made;
}

/** What fields were answered: { name: value }. */
export const answers = (fields) => Object.fromEntries(fields.map(({ name, value }) => [name, value]));

/** What they still need, in words. */
export function unanswered(fields) {
  const open = fields.filter(({ value }) => value === null).length;
  if (open === 0) return [];
  return [fields.every(({ kind }) => kind === "slider") ? texts.missing.sliders(open, fields.length) : texts.missing.answers(open)];
}
