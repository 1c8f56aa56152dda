// Steering: sliders, words, seed, mixtures, undo, and comparison.

import { announce, element, find, writes } from "../dom.js";
import { texts } from "../texts.js";
import { Compare } from "./compare.js";
import { Feel, stepped } from "./feel.js";
import { Mix } from "./mix.js";
import { Session } from "./session.js";
import { startSlots } from "./slots.js";
import { startTimeline } from "./timeline.js";
import { Words } from "./words.js";

/** Another piece of the same material: its prompt with the next seed, and the sliders as they are. */
function startPiece({ server, session, loader }) {
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
  session.on("change", show);
  show();
}

// While textures are compared blindly, the page hides whatever could tell them apart.
/** What stays: the stage, the sound, the hand, and the comparison itself. */
const STAYS = "data-blind";

function startBlind({ state }, compare) {
  const veil = element("div", { class: "veil", "aria-hidden": "true", hidden: true });
  document.querySelector(".frame").append(veil);
  const name = element("h2", { class: "name", hidden: true }, texts.steer.compare.title_blind);
  find("surface-title").after(name);

  state.on(["blind"], ({ blind = false }) => {
    document.body.classList.toggle("blind", blind);
    veil.hidden = !blind;
    name.hidden = !blind;
    for (const part of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(`.prompt, main .panel:not([${STAYS}]), #timeline`))) part.inert = blind;
    const shown = blind ? texts.steer.compare.title_blind : state.get("texture")?.name;
    if (shown) document.title = texts.titled(shown);
    // In place of what was said last, which may be a name.
    if (blind) announce(texts.steer.compare.title_blind);
  });
  compare.on("change", () => {
    const { order, heard } = compare;
    veil.textContent = order ? `? ${order.indexOf(heard) + 1}` : "";
  });
}

// Keys that work wherever no text is written: undo, redo, and the slots.
/** `slot(n)` takes 0 to 3, while `slotKeys()` holds. */
function followShortcuts({ undo, redo, slot, slotKeys }) {
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.isComposing || event.altKey || writes(event)) return;
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      const run = key === "z" ? (event.shiftKey ? redo : undo) : key === "y" && !event.shiftKey ? redo : null;
      if (!run) return;
      event.preventDefault();
      return run();
    }
    const digit = /^(?:Digit|Numpad)([1-4])$/.exec(event.code)?.[1];
    if (digit && !event.shiftKey && !event.repeat && slotKeys()) slot(Number(digit) - 1);
  });
}

export function startSteering({ server, state, loader, sound }) {
  const session = new Session(loader, server);
  const parts = { server, state, loader, sound, session };
  const compare = new Compare(parts);
  const feel = new Feel(parts);
  new Words(parts);
  startPiece(parts);
  new Mix(parts, compare);
  startTimeline(parts);
  const slotKeys = startSlots(parts, compare);
  startBlind(parts, compare);

  // A draft ends with whatever is shown or refused.
  session.on("change", () => state.set({ draft: false }));
  loader.on("refused", () => state.set({ draft: false }));
  state.on(["draft"], ({ draft }) => {
    find("draft").textContent = draft ? texts.steer.draft : "";
  });

  const steps = (run) => () => {
    if (state.get("blind")) return;
    feel.release();
    run();
  };
  followShortcuts({ undo: steps(() => session.undo()), redo: steps(() => session.redo()),
    slot: (n) => compare.choose(n), slotKeys });
  return { session, compare };
}
