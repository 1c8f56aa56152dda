// What stands beside the surface: the prompt, or the gallery.

import { element, find } from "../dom.js";
import { texts } from "../texts.js";

/** The page's two views: the prompt, or the gallery in its place. Surface and controls stay. */
const VIEWS = ["prompt", "gallery"];

/** `changed()` hears of every change; gives { show(view) }. */
export function startViews(changed) {
  const inputs = VIEWS.map((view) => element("input", { type: "radio", name: "view", value: view, onchange: () => show(view) }));
  const show = (view) => {
    inputs[VIEWS.indexOf(view)].checked = true;
    find("desk").classList.toggle("browsing", view === "gallery");
    find("gallery").hidden = view !== "gallery";
    changed();
  };
  find("views").replaceChildren(...inputs.map((input, n) =>
    element("label", {}, input, element("span", {}, texts.gallery.view[VIEWS[n]]))));
  show("prompt");
  return { show };
}
