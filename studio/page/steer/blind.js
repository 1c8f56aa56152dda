// While textures are compared blindly, the page hides whatever could tell them apart.

import { announce, element, find } from "../dom.js";
import { texts } from "../texts.js";

/** What stays: the stage, the sound, the hand, and the comparison itself. */
const STAYS = "data-blind";

export function startBlind({ state }, compare) {
  const veil = element("div", { class: "veil", "aria-hidden": "true", hidden: true });
  document.querySelector(".frame").append(veil);
  const name = element("h2", { class: "name", hidden: true }, texts.steer.compare.title_blind);
  find("surface-title").after(name);

  state.on(["blind"], ({ blind = false }) => {
    document.body.classList.toggle("blind", blind);
    veil.hidden = !blind;
    name.hidden = !blind;
    for (const part of document.querySelectorAll(`main .panel:not([${STAYS}]), #timeline`)) part.inert = blind;
    const shown = blind ? texts.steer.compare.title_blind : state.get("texture")?.name;
    if (shown) document.title = texts.titled(shown);
    // In place of what was said last, which may be a name.
    if (blind) announce(texts.steer.compare.title_blind);
  });
  compare.onchange.push(() => {
    const { order, heard } = compare;
    veil.textContent = order ? `? ${order.indexOf(heard) + 1}` : "";
  });
}
