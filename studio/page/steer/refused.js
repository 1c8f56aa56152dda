// What the server said against a request, at the panel that asked.

import { element } from "../dom.js";

/** Shows a refusal with its help, or none. */
export function showRefusal(panel, refusal) {
  if (!refusal) return panel.replaceChildren();
  const { message, help } = refusal;
  panel.replaceChildren(element("p", {}, element("strong", {}, message)), ...(help ? [element("p", {}, help)] : []));
}
