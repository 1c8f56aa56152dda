// The picture of a texture, small.

import { element } from "../dom.js";

/** An image without a text of its own; where the server has it no longer, nothing is shown in its place. */
export function portrait(server, texture) {
  const hide = () => (image.style.visibility = "hidden");
  const done = () => image.src.startsWith("blob:") && URL.revokeObjectURL(image.src);
  const image = element("img", { alt: "", width: 40, height: 40, draggable: "false", onerror: hide, onload: done });
  server.portrait(texture).then((address) => (image.src = address), hide);
  return image;
}
