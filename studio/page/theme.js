// Light, dark, or what the system says. Colours are `light-dark()` pairs, so that the scheme alone decides.

import { find, recall, remember } from "./dom.js";
import { texts } from "./texts.js";

const CHOICES = ["auto", "light", "dark"];

export function startTheme() {
  const button = find("theme");
  const apply = (choice) => {
    document.documentElement.dataset.theme = choice;
    button.textContent = texts.theme[choice];
    remember("theme", choice);
  };
  const recalled = recall("theme", "auto");
  apply(CHOICES.includes(recalled) ? recalled : "auto");
  button.addEventListener("click", () => {
    const now = CHOICES.indexOf(document.documentElement.dataset.theme);
    apply(CHOICES[(now + 1) % CHOICES.length]);
  });
}
