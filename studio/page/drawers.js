// What is not needed at every stroke: drawers below the surface, which stay as they were left, and the list of keys.

import { element, find, recall, remember, writes } from "./dom.js";
import { texts } from "./texts.js";

export function startDrawers() {
  const drawers = [...document.querySelectorAll(".drawers > details")];
  const recalled = recall("drawers", {});
  for (const drawer of drawers) {
    drawer.open = recalled?.[drawer.id] ?? drawer.open;
    drawer.addEventListener("toggle", () =>
      remember("drawers", Object.fromEntries(drawers.map(({ id, open }) => [id, open]))));
  }

  const keys = find("keys");
  keys.append(
    element("div", { class: "row" }, element("h2", { id: "keys-title" }, texts.keys.title),
      element("button", { type: "button", class: "quiet", popovertarget: "keys", popovertargetaction: "hide" }, texts.keys.close)),
    element("dl", { class: "rows" }, ...texts.keys.all.flatMap(([key, does]) => [element("dt", {}, key), element("dd", {}, does)])));
  addEventListener("keydown", (event) => {
    if (event.key === "?" && !event.ctrlKey && !event.metaKey && !event.altKey && !writes(event)) keys.togglePopover();
  });
}
