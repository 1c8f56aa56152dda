// The command lines that write the bytes of what is shown.

import { announce, element, find } from "./dom.js";
import { texts } from "./texts.js";

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
