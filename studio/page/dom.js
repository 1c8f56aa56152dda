// Building the document, and what it says. Everything that comes from outside becomes text, never markup.

import { texts } from "./texts.js";

/** @type {(id: string) => any} The page has it, and who asks knows what it is. */
export const find = (id) => document.getElementById(id);

/** An element; children that are strings become text. @param {Record<string, any>} [attributes] @param {(Node | string)[]} children @returns {any} */
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

/** Whether an event belongs to a field in which a person writes. */
const NO_TEXT = ["range", "checkbox", "radio", "button", "submit", "file", "color"];
export const writes = ({ target }) => target.isContentEditable || target.matches?.("textarea, select")
  || (target.matches?.("input") && !NO_TEXT.includes(target.type));

/** Runs what a button does, which is busy meanwhile and does it once; it is not disabled, which would take the focus away. */
export async function busily(button, run) {
  if (button.getAttribute("aria-busy") === "true") return;
  button.setAttribute("aria-busy", "true");
  try {
    await run();
  } finally {
    button.removeAttribute("aria-busy");
  }
}

/** Copies a text, or selects `shown`, which holds it, where the browser does not let it; the button says which for a while. */
export async function copy(button, text, shown) {
  const label = button.textContent;
  let said = texts.copy.copied;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    getSelection().selectAllChildren(shown);
    said = texts.copy.selected;
  }
  button.textContent = said;
  announce(said);
  setTimeout(() => (button.textContent = label), 2000);
}

/** A file for the person: a Blob under a name, without leaving the page. */
export function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // Some browsers read it later than the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** Shows a refusal with its help, or none. */
export function showRefusal(panel, refusal) {
  if (!refusal) return panel.replaceChildren();
  const { message, help } = refusal;
  panel.replaceChildren(element("p", {}, element("strong", {}, message)), ...(help ? [element("p", {}, help)] : []));
}

// What went wrong outside the prompt, each with its remedy. A key shows once.
const shown = new Map();

/** @type {(key: string, notice: { text: string, help?: string, done?: boolean, action?: { label: string, run: () => void } }) => void} `action` is a button; `done` is no fault. */
export const notify = (key, { text, help, done, action }) => {
  withdraw(key);
  const notice = element("div", { class: done ? "notice done" : "notice", "data-key": key },
    element("p", {}, element("strong", {}, text), ...(help ? [" ", help] : [])));
  if (action) notice.append(element("button", { type: "button", onclick: action.run }, action.label));
  notice.append(element("button", { type: "button", class: "quiet", onclick: () => withdraw(key) }, texts.notices.dismiss));
  shown.set(key, notice);
  find("notices").append(notice);
};

export const isNotified = (key) => shown.has(key);

export function withdraw(key) {
  shown.get(key)?.remove();
  shown.delete(key);
}
