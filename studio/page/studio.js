// The page's entry: builds the parts and lets them hear of each other.

import { startBeginning } from "./begin.js";
import { startDevicePanel } from "./device/panel.js";
import { startDrawers } from "./drawers.js";
import { find, notify, recall, remember } from "./dom.js";
import { Events } from "./events.js";
import { In } from "./files/in.js";
import { Out } from "./files/out.js";
import { startGallery } from "./gallery/gallery.js";
import { startHandPanel } from "./hand-panel.js";
import { OwnLibrary } from "./library/own.js";
import { startOwnLibrary } from "./library/panel.js";
import { Links } from "./links.js";
import { Loader } from "./loader.js";
import { mountPlots } from "./plots/plots.js";
import { startProject } from "./project.js";
import { Server } from "./server.js";
import { Sound } from "./sound.js";
import { startSoundPanel } from "./sound-panel.js";
import { startSteering } from "./steer/steer.js";
import { Surface } from "./surface.js";
import { texts } from "./texts.js";
import { startTexturePanels } from "./texture-panels.js";

/** What the parts share. A part sets values; others hear of those that changed. */
class State extends Events {
  #values = { about: null, texture: null, busy: false, draft: false };

  get(name) {
    return this.#values[name];
  }

  set(values) {
    const changed = Object.keys(values).filter((name) => this.#values[name] !== values[name]);
    Object.assign(this.#values, values);
    for (const name of changed) this.emit(name, this.#values);
  }

  /** Calls `hear` with all values now, and when one of the named ones changed. */
  on(names, hear) {
    for (const name of names) super.on(name, hear);
    hear(this.#values);
  }
}

/** Light, dark, or what the system says. Colours are `light-dark()` pairs, so that the scheme alone decides. */
function startTheme() {
  const choices = ["auto", "light", "dark"];
  const button = find("theme");
  const apply = (choice) => {
    document.documentElement.dataset.theme = choice;
    button.textContent = texts.theme[choice];
    remember("theme", choice);
  };
  const recalled = recall("theme", "auto");
  apply(choices.includes(recalled) ? recalled : "auto");
  button.addEventListener("click", () => {
    const now = choices.indexOf(document.documentElement.dataset.theme);
    apply(choices[(now + 1) % choices.length]);
  });
}

find("unstarted").remove();
const server = new Server();
const state = new State();
const broken = () => notify("broken", { text: texts.broken, help: texts.broken_help });
addEventListener("error", broken);
addEventListener("unhandledrejection", broken);

startTheme();
startDrawers();
const surface = new Surface();
const sound = new Sound((name) => server.file(name));
const { hand, move } = startHandPanel({ surface, sound, state });
startSoundPanel({ sound, hand });
const loader = new Loader({ server, state, surface, sound });
startTexturePanels({ state, loader });
const { session, compare } = startSteering({ server, state, loader, sound });
const own = new OwnLibrary();
const { restore, flush } = startProject({ server, state, session, compare, own });
const gallery = startGallery({ server, state, loader, own, flush });
const from = (texture) => gallery.from(texture);
const links = new Links({ server, state, loader, from });
startOwnLibrary({ server, state, loader, own, from, browse: () => gallery.browse() });
new Out({ server, state, links });
new In({ server, state, loader, gallery });
// Static files show textures and make none.
state.on(["about"], ({ about }) => {
  if (about) document.documentElement.dataset.served = about.opens ? "server" : "files";
});
// The plots ask the module that also renders the sound.
const runtime = server.file("asperity.wasm").then((bytes) => WebAssembly.instantiate(bytes)).then(({ instance }) => instance.exports);
const plots = mountPlots(find("plots"), runtime, texts.plots);
// Beside a device they show its ticks instead of the page's own.
sound.on("ticks", (ticks) => state.get("about")?.device || plots.addTicks(ticks));
state.on(["texture"], ({ texture, asset }) => plots.setTexture(texture && texture.inspect, asset));
startDevicePanel({ server, state, surface, plots });
find("prompt").focus({ preventScroll: true });
startBeginning({ state, server, loader, sound, move, restore, links });
loader.begin();
