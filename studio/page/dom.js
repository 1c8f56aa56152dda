// Building the document. Everything that comes from outside becomes text, never markup.

import { texts } from "./texts.js";

export const find = (id) => document.getElementById(id);

/** An element; children that are strings become text. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== undefined && value !== null) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

const text = (key) => key.split(".").reduce((at, part) => at[part], texts);

/** Fills in the texts that `index.html` names. */
export function fillTexts() {
  for (const made of document.querySelectorAll("[data-text]")) made.textContent = text(made.dataset.text);
  for (const made of document.querySelectorAll("[data-label]")) made.setAttribute("aria-label", text(made.dataset.label));
  for (const made of document.querySelectorAll("[data-placeholder]")) made.placeholder = text(made.dataset.placeholder);
}

/** Has a screen reader say something that the eye sees anyway. */
export const announce = (said) => (find("announcement").textContent = said);

const PREFIX = "asperity-studio.";

/** A setting of this browser; without storage it lasts as long as the page. */
export function recall(name, otherwise) {
  try {
    return JSON.parse(localStorage.getItem(PREFIX + name)) ?? otherwise;
  } catch {
    return otherwise;
  }
}

export function remember(name, value) {
  try {
    localStorage.setItem(PREFIX + name, JSON.stringify(value));
  } catch {
    // Private windows and full disks: the page works without.
  }
}
