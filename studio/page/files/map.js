// What a picture of heights or normals does not say of its surface: its size, and its material.

import { element } from "../dom.js";
import { texts } from "../texts.js";

/** Endings of pictures. */
export const isPicture = ({ name }) => /\.(png|tiff?|jpe?g)$/i.test(name);

const own = texts.files.map;

/** Asks for it; { width_mm, … } as texts, without what was left out, or `null` where the person does not go on. */
export function askMap({ name }) {
  const number = (key, attributes) => element("input", { type: "number", id: `map-${key}`, name: key, step: "any", ...attributes });
  const row = (key, input) => [element("label", { for: `map-${key}` }, own[key]), input];
  const form = element("form", { method: "dialog", class: "map" },
    element("h2", {}, own.title(name)), element("p", { class: "small" }, own.about),
    ...row("width_mm", number("width_mm", { min: "0.1", max: "10000", required: true, autofocus: true })),
    ...row("depth_mm", number("depth_mm", { min: "-100", max: "100" })),
    ...row("like", element("input", { type: "text", id: "map-like", name: "like", maxlength: "2000", spellcheck: "false" })),
    element("div", { class: "row" }, element("button", { type: "button", class: "quiet", onclick: () => dialog.close() }, own.cancel),
      element("button", { type: "submit", class: "strong", value: "import" }, own.import)));
  const dialog = element("dialog", { "aria-label": own.title(name) }, form);
  document.body.append(dialog);
  dialog.showModal();
  return new Promise((done) => dialog.addEventListener("close", () => {
    dialog.remove();
    const stated = Object.fromEntries([...new FormData(form)].filter(([, value]) => String(value).trim() !== ""));
    done(dialog.returnValue === "import" ? stated : null);
  }));
}
