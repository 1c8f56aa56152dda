// What is not needed at every stroke: drawers below the surface, which stay as they were left, and the list of keys.

import { find, recall, remember, writes } from "./dom.js";

export function startDrawers() {
  const drawers = /** @type {HTMLDetailsElement[]} */ ([...document.querySelectorAll(".drawers > details")]);
  const recalled = recall("drawers", {});
  for (const drawer of drawers) {
    drawer.open = recalled?.[drawer.id] ?? drawer.open;
    drawer.addEventListener("toggle", () =>
      remember("drawers", Object.fromEntries(drawers.map(({ id, open }) => [id, open]))));
  }

  const keys = find("keys");
  addEventListener("keydown", (event) => {
    if (event.key === "?" && !event.ctrlKey && !event.metaKey && !event.altKey && !writes(event)) keys.togglePopover();
  });
}
