// How the texture feels as three bars, and the command that writes it.

import { announce, element, find } from "./dom.js";
import { texts } from "./texts.js";

/** The attributes at 0 and at 100 of the embedded model, where the server's `about` has no `sliders`. */
const ENDS = { rough: [-12.5, 12.8], slippery: [0.893, 0.192], hard: [121, 1149] };
const ATTRIBUTE = { rough: "rough_db", slippery: "mu", hard: "hard_hz" };

/** Places of the attributes between 0 and 100 and beyond; `null` where a texture does not define one. */
export function places(attributes, ends = ENDS) {
  return Object.fromEntries(Object.entries(ATTRIBUTE).map(([name, key]) => {
    const [low, high] = ends[name];
    const value = attributes[key];
    return [name, Number.isFinite(value) ? (100 * (value - low)) / (high - low) : null];
  }));
}

export function showFeel(texture, ends) {
  if (!texture) return find("feel").replaceChildren(element("p", { class: "none" }, texts.feel.none));
  const { attributes } = texture.inspect;
  const bars = Object.entries(places(attributes, ends)).map(([name, place]) => {
    const title = texts.feel.axes[name];
    const physical = place === null ? texts.feel.undefined : texts.feel[name](attributes[ATTRIBUTE[name]]);
    const fill = element("span", { class: `fill ${name}` });
    fill.style.setProperty("--share", Math.min(Math.max((place ?? 0) / 100, 0), 1));
    const label = place === null ? `${title}: ${physical}` : texts.feel.place(title, place, physical);
    return element("li", {}, element("span", {}, title),
      element("span", { class: "track", role: "img", "aria-label": label }, fill),
      element("span", { class: "place" }, place === null ? texts.readout.none : texts.feel.of_100(place)),
      element("span", { class: "physical" }, physical));
  });
  find("feel").replaceChildren(element("ul", { class: "bars" }, ...bars), element("p", { class: "small" }, texts.feel.about));
}

export function showCommand(texture) {
  const panel = find("command");
  panel.hidden = !texture?.command;
  if (panel.hidden) return panel.replaceChildren();
  const code = element("code", { tabindex: "0", "aria-label": texts.command.label }, texture.command);
  const copy = element("button", { type: "button", class: "quiet" }, texts.command.copy);
  copy.addEventListener("click", async () => {
    let said = texts.command.copied;
    try {
      await navigator.clipboard.writeText(texture.command);
    } catch {
      getSelection().selectAllChildren(code);
      said = texts.command.selected;
    }
    copy.textContent = said;
    announce(said);
    setTimeout(() => (copy.textContent = texts.command.copy), 2000);
  });
  panel.replaceChildren(element("span", { class: "small" }, texts.command.label), code, copy);
}
