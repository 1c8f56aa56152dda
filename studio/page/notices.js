// What went wrong outside the prompt, each with its remedy. A key shows once.

import { element, find } from "./dom.js";
import { texts } from "./texts.js";

const shown = new Map();

/** `action`: a button, { label, run }. */
export function notify(key, { text, help, action }) {
  withdraw(key);
  const notice = element("div", { class: "notice", "data-key": key },
    element("p", {}, element("strong", {}, text), ...(help ? [" ", help] : [])));
  if (action) notice.append(element("button", { type: "button", onclick: action.run }, action.label));
  notice.append(element("button", { type: "button", class: "quiet", onclick: () => withdraw(key) }, texts.notices.dismiss));
  shown.set(key, notice);
  find("notices").append(notice);
}

export function withdraw(key) {
  shown.get(key)?.remove();
  shown.delete(key);
}
