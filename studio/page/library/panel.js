// The star at the surface, and the drawer of what is kept: names, notes, tags, and the file of a library.

import { announce, busily, element, find, isNotified, notify, showRefusal, withdraw, writes } from "../dom.js";
import { Refusal } from "../server.js";
import { portrait } from "../steer/timeline.js";
import { texts } from "../texts.js";
import { tagsOf } from "./own.js";

/** Rows of the drawer, the newest first: the gallery shows all. */
const MOST = 50;

/** What was removed since the offer to undo that came up: { items, back }. */
let removed = [];

/** Removes textures, and offers to undo it. */
export function remove(own, items) {
  if (!isNotified("gone-own")) removed = [];
  removed.push({ items, back: own.remove(new Set(items.map(({ id }) => id))) });
  const run = () => {
    withdraw("gone-own");
    for (const { back } of removed.splice(0).reverse()) back();
  };
  notify("gone-own", { text: texts.own.removed(removed.flatMap((each) => each.items)), done: true, action: { label: texts.own.back, run } });
}

/** Saves items as a library's file, or says why it cannot. */
export async function saveLibrary(own, server, items) {
  withdraw("pack");
  try {
    await own.pack(server, items);
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    notify("pack", { text: texts.own.not_packed(error.message), help: error.help });
  }
}

/** The button that keeps what is on the surface, or removes it; `K` does the same. */
function startStar({ state, own, from }) {
  const button = find("keep");
  const show = () => {
    const { id } = state.get("texture") ?? {};
    const kept = own.of(id) !== undefined;
    button.setAttribute("aria-pressed", String(kept));
    button.textContent = texts.own.star[kept];
    button.title = texts.own.star_title[kept];
  };
  const toggle = () => {
    const texture = state.get("texture");
    if (!texture || state.get("blind")) return;
    const item = own.of(texture.id);
    if (item) return remove(own, [item]);
    own.keep([{ texture, from: from(texture) }]);
    announce(texts.own.kept(own.of(texture.id).name));
  };
  button.addEventListener("click", toggle);
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.isComposing || event.repeat || event.ctrlKey || event.metaKey || event.altKey || writes(event)) return;
    if (event.key.toLowerCase() === "k") toggle();
  });
  state.on(["texture"], show);
  own.on("change", show);
}

/** The row of an item: its picture, and its fields. */
function rowOf(item, { server, loader, own, error }) {
  const field = (name, attributes, read) => {
    const input = element("input", { type: "text", spellcheck: "false",
      placeholder: texts.own.placeholders[name], class: `kept-${name}`, ...attributes, onchange: () => read(input) });
    return input;
  };
  const name = field("name", { maxlength: 64 }, (input) => {
    const given = input.value.trim();
    const message = own.fault(item, given);
    input.setAttribute("aria-invalid", String(message !== null));
    if (message) showRefusal(error, { message, help: texts.own.name_help });
    else own.change(item, { name: given });
  });
  const note = field("note", { maxlength: 500 }, (input) => own.change(item, { note: input.value.trim() }));
  const tags = field("tags", { maxlength: 200 }, (input) => own.change(item, { tags: tagsOf(input.value) }));
  const show = element("button", { type: "button", class: "tile", "aria-label": texts.own.show(item.name),
    onclick: () => loader.take((signal) => server.shown(item, signal), { kind: "pick", name: item.name }) }, portrait(server, item));
  const drop = element("button", { type: "button", class: "quiet", "aria-label": texts.own.remove(item.name), title: texts.own.remove(item.name),
    onclick: () => {
      const next = row.nextElementSibling ?? row.previousElementSibling;
      remove(own, [item]);
      next?.querySelector("button:last-child").focus();
    } }, "×");
  const row = element("li", {}, show, name, note, tags, drop);
  return { row, follow: () => {
    // What a person is writing stays.
    for (const [key, input, value] of [["name", name, item.name], ["note", note, item.note], ["tags", tags, item.tags.join(", ")]]) {
      if (input !== document.activeElement && input.ariaInvalid !== "true") input.value = value;
      input.setAttribute("aria-label", texts.own.fields[key](item.name));
    }
  } };
}

/** `from(texture)` says where it was picked. */
export function startOwnLibrary({ server, state, loader, own, from, browse }) {
  startStar({ state, own, from });
  const told = element("p", { class: "small told" });
  const gallery = element("button", { type: "button", class: "quiet", onclick: browse }, texts.own.browse);
  const pack = element("button", { type: "button", class: "strong", id: "pack", onclick: () => {
    const wrong = list.querySelector("[aria-invalid=true]");
    return wrong ? wrong.focus() : busily(pack, () => saveLibrary(own, server, own.items));
  } });
  const list = element("ol", { class: "kept" });
  const error = element("div", { class: "error", role: "alert" });
  find("own").append(element("div", { class: "row" }, told, gallery, pack), error, list);

  const rows = new Map();
  const show = () => {
    const { items } = own;
    for (const item of rows.keys()) if (!items.includes(item)) rows.delete(item);
    const seen = items.slice(-MOST).reverse();
    for (const item of seen) if (!rows.has(item)) rows.set(item, rowOf(item, { server, loader, own, error }));
    const made = seen.map((item) => rows.get(item).row);
    // Fields that stay keep the focus.
    made.forEach((row, n) => list.children[n] !== row && list.insertBefore(row, list.children[n] ?? null));
    while (list.children.length > made.length) list.lastElementChild.remove();
    for (const item of seen) rows.get(item).follow();
    if (!list.querySelector("[aria-invalid=true]")) showRefusal(error, null);
    told.textContent = items.length === 0 ? texts.own.none : texts.own.count(items.length, MOST);
    pack.textContent = texts.own.pack(items.length);
    pack.disabled = items.length === 0;
    gallery.hidden = items.length === 0;
  };
  own.on("change", show);
  show();
}
