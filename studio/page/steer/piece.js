// Another piece of the same material: its prompt with the next seed, and the sliders as they are.

import { element, find } from "../dom.js";
import { texts } from "../texts.js";
import { stepped } from "./feel.js";

export function startPiece({ server, session, loader }) {
  const button = element("button", { type: "button", class: "quiet" }, texts.steer.piece.another);
  const seed = element("span", { class: "small" });
  find("piece").append(seed, button);

  const show = () => {
    const base = session.current?.base;
    find("piece").hidden = !base?.compiled;
    if (base?.compiled) seed.textContent = texts.steer.piece.seed(base.seed);
  };
  button.addEventListener("click", () => {
    const { base, steps } = session.current;
    const { prompt } = base.compiled;
    const next = base.seed + 1;
    if (Object.keys(steps).length === 0) return loader.compile(prompt, next);
    const how = { kind: "steps", base: null, steps };
    return loader.take(async (signal) => {
      how.base = await server.compile({ prompt, seed: next }, signal);
      return stepped(server, how.base, steps, signal);
    }, how);
  });
  session.onchange.push(show);
  show();
}
