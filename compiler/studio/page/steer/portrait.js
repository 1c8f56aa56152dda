// The picture of a texture, small.

import { element } from "../dom.js";

/** An image without a text of its own; where the server has it no longer, nothing is shown in its place. */
export function portrait(server, texture) {
  const hide = ({ target }) => (target.style.visibility = "hidden");
  return element("img", { src: server.portrait(texture), alt: "", width: 40, height: 40, draggable: "false", onerror: hide });
}
