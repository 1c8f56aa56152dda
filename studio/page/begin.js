// How the page begins: with a surface, a hand in motion on it, and its sound as soon as the browser lets a page sound.

import { texts } from "./texts.js";

const reduced = matchMedia("(prefers-reduced-motion: reduce)");

/** Shows what the address links to, what the project had last, the first texture of the studio's library, or the first example. */
function showFirst({ state, server, loader, restore, links }) {
  let begun = false;
  state.on(["about"], async ({ about, texture, busy }) => {
    if (!about || texture || busy || begun) return;
    begun = true;
    const isRestored = await restore();
    if (links.open(location.hash) || isRestored) return;
    const { library, prompts, opens } = about;
    if (library?.id) {
      return loader.take(async (signal) => server.pick(await server.library(library.id, signal), 0, signal), { kind: "pick", name: library.name });
    }
    const prompt = texts.prompt.examples[0];
    if (prompts && opens) loader.take((signal) => server.compile({ prompt }, signal), { kind: "prompt", prompt, seed: 0, begins: true });
  });
}

/** `move()` starts the hand that moves by itself, `restore()` brings back a project, if there is one, `links` what is linked to. */
export function startBeginning({ state, server, loader, sound, move, restore, links }) {
  showFirst({ state, server, loader, restore, links });
  const prepared = sound.prepare();
  if (reduced.matches) return;
  let begun = false;
  loader.on("shown", () => {
    if (begun || state.get("about").device) return;
    begun = true;
    move();
    prepared.then(() => sound.allowed && sound.start());
  });
  // The first gesture of any kind starts the sound, but that of the switch itself.
  /** @param {any} event */
  const wake = ({ type, key, target }) => {
    if ((type === "keydown" && key !== "Enter") || target.closest?.("#sound-switch, #auto")) return;
    for (const name of ["pointerdown", "keydown"]) removeEventListener(name, wake, true);
    if (!sound.stopped) sound.start();
  };
  for (const name of ["pointerdown", "keydown"]) addEventListener(name, wake, true);
}
