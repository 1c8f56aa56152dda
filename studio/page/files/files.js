// Files into the page and out of it.

import { In } from "./in.js";
import { Out } from "./out.js";

/** `gallery.add(library)` takes a library that was opened. */
export function startFiles({ server, state, loader, gallery }) {
  new Out({ server, state, loader });
  new In({ server, state, loader, gallery });
}
