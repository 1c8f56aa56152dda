// The slots A to D as buttons, and the switches of the comparison.

import { announce, element, find, recall, remember } from "../dom.js";
import { texts } from "../texts.js";
import { LETTERS } from "./compare.js";
import { changeOf, describe, portrait } from "./timeline.js";

const said = texts.steer.compare;

const named = (...lines) => element("span", { class: "slot-name" }, ...lines.filter(Boolean).map((line) => element("span", {}, line)));

/** A box to tick. */
function check(id, label, title, changed) {
  const input = element("input", { type: "checkbox", id, onchange: ({ target }) => changed(target.checked) });
  return { input, element: element("label", { class: "check", title }, input, label) };
}

/** Returns whether the keys 1 to 4 switch. */
export function startSlots({ server, session }, compare) {
  const keys = check("slot-keys", said.keys, said.keys_title, (on) => remember("slot-keys", on));
  keys.input.checked = recall("slot-keys", true) === true;
  const blind = element("button", { type: "button", id: "blind", class: "quiet", onclick: () => turn() });
  const told = element("p", { class: "small told", role: "status" });
  const slots = element("div", { class: "slots", role: "group", "aria-labelledby": "compare-title" });
  find("compare").append(
    element("div", { class: "row" }, element("h2", { id: "compare-title" }, said.title), told, keys.element, blind), slots);

  let revealed = "";
  const turn = () => {
    if (!compare.order) {
      revealed = "";
      return compare.blind();
    }
    const { order } = compare;
    revealed = said.revealed(order.map((n, at) => [at + 1, LETTERS[n], compare.slots[n].texture.name]));
    announce(revealed);
    compare.reveal();
  };

  const open = (entry, n) => {
    const label = entry ? said.slot(LETTERS[n], describe(entry)) : said.empty(LETTERS[n]);
    const choose = element("button", { type: "button", class: "slot", title: label,
      "aria-pressed": String(Boolean(entry) && compare.heard === n), disabled: !entry && !session.current,
      onclick: () => compare.choose(n) },
    element("span", { class: "letter" }, LETTERS[n]),
    ...(entry ? [portrait(server, entry.texture), named(entry.texture.name, changeOf(entry))]
      : [named(said.put)]));
    const put = element("button", { type: "button", class: "quiet put", "aria-label": said.replace(LETTERS[n]), title: said.replace(LETTERS[n]),
      disabled: !session.current || session.current === entry, onclick: () => compare.put(n) }, said.put_sign);
    return element("div", { class: "slot-place" }, choose, ...(entry ? [put] : []));
  };
  const hidden = (n, at) => element("div", { class: "slot-place" }, element("button", { type: "button", class: "slot unknown",
    "aria-pressed": String(compare.heard === n), onclick: () => compare.choose(at) },
  element("span", { class: "letter" }, "?"), named(String(at + 1))));

  const show = () => {
    const { order, filled } = compare;
    const focused = [...slots.children].findIndex((slot) => slot.contains(document.activeElement));
    slots.replaceChildren(...(order ? order.map(hidden) : compare.slots.map(open)));
    if (focused >= 0) slots.children[focused]?.firstElementChild.focus();
    blind.textContent = order ? said.reveal : said.blind;
    blind.disabled = !order && filled.length < 2;
    told.textContent = order ? "" : revealed;
  };
  compare.on("change", show);
  show();
  return () => keys.input.checked;
}
