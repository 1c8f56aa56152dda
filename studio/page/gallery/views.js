// What stands beside the surface: the prompt, or the gallery, which has a button of the hand of its own.

import { element, find } from "../dom.js";
import { texts } from "../texts.js";

/** The button of the hand that moves by itself, once more, beside what is picked. */
export function handButton() {
  const original = find("auto");
  const button = element("button", { type: "button", class: "hand", onclick: () => original.click() });
  const follow = () => {
    button.textContent = original.textContent;
    button.disabled = original.disabled;
    button.setAttribute("aria-pressed", original.getAttribute("aria-pressed"));
  };
  new MutationObserver(follow).observe(original, { attributes: true, childList: true, characterData: true, subtree: true });
  follow();
  return button;
}

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
