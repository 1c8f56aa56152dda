// The textures of this session as a strip of pictures, with undo and redo.

import { element, find, notify, withdraw } from "../dom.js";
import { texts } from "../texts.js";

/** What led to an entry, in a few words; empty for a prompt. */
export const changeOf = ({ how, steps }) =>
  how.kind === "steps" ? texts.steer.steps(steps) : how.kind === "words" ? how.words : texts.steer.kinds[how.kind]?.(how) ?? "";

export function describe(entry) {
  const by = changeOf(entry);
  return by ? `${entry.texture.name}: ${by}` : entry.texture.name;
}

/** An image without a text of its own; where the server has it no longer, nothing is shown in its place. */
export function portrait(server, texture) {
  const hide = () => (image.style.visibility = "hidden");
  const done = () => image.src.startsWith("blob:") && URL.revokeObjectURL(image.src);
  const image = element("img", { alt: "", width: 40, height: 40, draggable: "false", onerror: hide, onload: done });
  server.portrait(texture).then((address) => (image.src = address), hide);
  return image;
}

export function startTimeline({ server, state, session, loader }) {
  const list = element("ol", { class: "strip", "aria-label": texts.steer.timeline.label });
  const button = (label, onclick, title) => element("button", { type: "button", class: "quiet", onclick, title }, label);
  const undo = button(texts.steer.timeline.undo, () => session.undo(), "Ctrl+Z");
  const redo = button(texts.steer.timeline.redo, () => session.redo(), "Ctrl+Shift+Z");
  const told = element("p", { class: "small told" });
  find("timeline").append(element("div", { class: "row" }, element("h2", { id: "session-title" }, texts.steer.timeline.title), told, undo, redo), list);

  const shown = new Map();
  const item = (entry) => {
    if (!shown.has(entry)) {
      const choose = element("button", { type: "button", class: "tile", "data-texture": entry.texture.id, onclick: () => session.show(entry) }, portrait(server, entry.texture));
      shown.set(entry, element("li", {}, choose));
    }
    return shown.get(entry);
  };
  const show = () => {
    const { entries, at } = session;
    // Not `disabled`, which would lose the focus at the ends.
    undo.setAttribute("aria-disabled", String(at <= 0));
    redo.setAttribute("aria-disabled", String(at >= entries.length - 1));
    told.textContent = session.current ? texts.steer.timeline.at(at + 1, entries.length, describe(session.current)) : texts.steer.timeline.none;
    for (const entry of shown.keys()) if (!entries.includes(entry)) shown.delete(entry);
    const items = entries.map(item);
    // Buttons that stay keep the focus.
    items.forEach((made, n) => list.children[n] !== made && list.insertBefore(made, list.children[n] ?? null));
    while (list.children.length > items.length) list.lastElementChild.remove();
    items.forEach((made, n) => {
      const tile = made.firstElementChild;
      const label = texts.steer.timeline.entry(n + 1, describe(entries[n]));
      tile.title = label;
      tile.setAttribute("aria-label", label);
      if (n === at) tile.setAttribute("aria-current", "true");
      else tile.removeAttribute("aria-current");
    });
    const current = list.children[at];
    if (current) list.scrollLeft = current.offsetLeft - (list.clientWidth - current.offsetWidth) / 2;
  };
  session.on("change", () => {
    withdraw("gone");
    show();
  });
  state.on(["blind"], show);

  loader.on("refused", ({ refusal: { message }, how }) => {
    if (how?.kind !== "undo") return;
    const { entry } = how;
    notify("gone", { text: texts.steer.gone(entry.texture.name, message), help: texts.steer.gone_help,
      action: { label: texts.server.retry, run: () => session.show(entry) } });
  });
}
