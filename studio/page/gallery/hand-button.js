// The button of the hand that moves by itself, once more, beside what is picked.

import { element, find } from "../dom.js";

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
