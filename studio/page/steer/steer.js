// Steering: sliders, words, seed, mixtures, undo, and comparison.

import { find } from "../dom.js";
import { texts } from "../texts.js";
import { startBlind } from "./blind.js";
import { Compare } from "./compare.js";
import { Feel } from "./feel.js";
import { Mix } from "./mix.js";
import { startPiece } from "./piece.js";
import { Session } from "./session.js";
import { followShortcuts } from "./shortcuts.js";
import { startSlots } from "./slots.js";
import { startTimeline } from "./timeline.js";
import { Words } from "./words.js";

export function startSteering({ server, state, loader, sound }) {
  const session = new Session(loader);
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
  session.onchange.push(() => state.set({ draft: false }));
  loader.onrefused.push(() => state.set({ draft: false }));
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
}
