// The surface that is explored: its picture, its sound, and whose hand is on it, pointer, keys or a device.

import { Feed } from "../page/device/feed.js";
import { find, notify, withdraw } from "../page/dom.js";
import { Force } from "../page/force.js";
import { Hand } from "../page/hand.js";
import { followKeys } from "../page/keys.js";
import { followPointer } from "../page/pointer.js";
import { Sound } from "../page/sound.js";
import { Surface } from "../page/surface.js";
import { texts } from "./texts.js";

const KEYS_MM_S = 100;
/** Force that every surface begins with, N. */
const USUAL_N = 1;
/** After so many seconds without a contact the sound rests, and with it the log. */
const IDLE_S = 60;
const PAGE_HZ = 16_000;
const DEVICE_HZ = 1000;

/** Everybody sees a surface at the same size. */
class Still extends Surface {
  zoom() {}
}

/** A picture of one colour, a Blob. @returns {Promise<Blob>} */
function plain(colour) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 4;
  const context = canvas.getContext("2d");
  context.fillStyle = colour;
  context.fillRect(0, 0, 4, 4);
  return new Promise((done) => canvas.toBlob(done));
}

export class Touch {
  /** Ticks a second. */
  rate_hz = PAGE_HZ;
  #server;
  #sound;
  #surface = new Still();
  #hand = new Hand((events) => this.#sound.hand(events));
  #force = new Force();
  /** `begun()` hears of a session's first tick, `ticks(message)` of all. */
  #listener = null;
  #session = null;
  #device = null;
  #woken = false;
  #idle_s = 0;
  #loaded = (/** @type {any} */ _message) => {};

  constructor(server) {
    this.#server = server;
    this.#sound = new Sound((name) => server.file(name));
    // Textures differ by how strong they are, too.
    this.#sound.balance(false);
    this.#sound.on("loaded", (message) => {
      this.#session = message.session;
      this.#hand.stiffness_n_m = message.stiffness_n_m;
      this.#listener?.begun();
      this.#loaded(message);
    });
    this.#sound.on("ticks", (ticks) => this.#ticks(ticks));
    this.#sound.on("state", (state) => this.#said(state));
    this.#sound.on("failure", ({ kind }) => this.#failed(kind));
    this.#sound.on("refused", () => notify("sound", { text: texts.sound.refused, help: texts.sound.refused_help }));
  }

  /** Prepares for the page's own sound, or for a device by its name. */
  begin({ device, device_rate_hz = DEVICE_HZ }) {
    if (this.#device !== null) return;
    this.#device = device ?? false;
    find("press").hidden = Boolean(device);
    find("stage-hint").prepend(device ? texts.stage.device(device) : texts.stage.hint);
    if (!device) return this.#followHand();
    this.#surface.stage.setAttribute("role", "img");
    this.rate_hz = device_rate_hz;
    const feed = new Feed(this.#server);
    feed.on("ticks", (ticks) => this.#listener?.ticks(ticks));
    feed.run();
  }

  /** Whether a person has to click before anything sounds. */
  get asleep() {
    return !this.#device && !this.#woken;
  }

  /** Lets the page sound; call it from a click or a key. */
  wake() {
    if (!this.asleep) return;
    this.#woken = true;
    this.#sound.start();
  }

  /**
   * Shows and plays a texture by its path from its first tick on, and tells `listener` of its ticks. The sound is stopped first,
   * since a texture that comes while another one sounds would be a cross-fade, which is no session of its own.
   */
  async play({ texture, width_mm, picture, volume_db }, listener) {
    const pictures = picture ? ["unlit.png", "normal.png"].map((ending) => this.#server.picture(`${texture}.${ending}`))
      : [plain("#8a8f8d"), plain("#8080ff")];
    const [asset, ...shown] = await Promise.all([this.#device ? null : this.#server.file(`${texture}.worklet.asp`), ...pictures]);
    await this.#surface.show(...shown, width_mm);
    this.#surface.reset();
    this.#setForce(USUAL_N);
    if (this.#device) {
      this.#listener = listener;
      return listener.begun();
    }
    await this.#sound.stop();
    this.#session = null;
    this.#listener = listener;
    this.#idle_s = 0;
    this.#sound.level = volume_db;
    const loaded = new Promise((done) => (this.#loaded = done));
    this.#sound.play(asset, null);
    await this.#sound.start();
    await loaded;
  }

  /** Silence; whoever touches the surface ends it. */
  rest() {
    return this.#sound.stop();
  }

  /** Nobody explores any more. */
  leave() {
    this.#listener = null;
    withdraw("sound");
    return this.rest();
  }

  #followHand() {
    const { stage } = this.#surface;
    stage.tabIndex = 0;
    stage.setAttribute("role", "application");
    this.#sound.prepare();
    const [surface, hand, force, sound] = [this.#surface, this.#hand, this.#force, this.#sound];
    const begun = () => this.#listener && sound.start();
    // The page scrolls over the surface, unless somebody presses it.
    stage.addEventListener("wheel", (event) => hand.owner === null && event.stopImmediatePropagation(), { capture: true, passive: true });
    followPointer({ surface, hand, force, begun, turn: (by_n) => this.#setForce(force.slider_n + by_n) });
    followKeys({ surface, hand, force, begun, speed_mm_s: () => KEYS_MM_S });
    hand.on("move", () => surface.touch(hand.last));
    find("force").addEventListener("input", ({ target }) => this.#setForce(Number(target.value)));
    document.addEventListener("visibilitychange", () => (document.hidden ? this.rest() : begun()));
  }

  #setForce(newtons) {
    const input = find("force");
    input.value = newtons;
    this.#force.slider_n = Number(input.value);
    const text = texts.stage.force_text(this.#force.slider_n);
    find("force-text").textContent = text;
    input.setAttribute("aria-valuetext", text);
  }

  #ticks(ticks) {
    if (ticks.session !== this.#session) return;
    this.#listener?.ticks(ticks);
    this.#idle_s = this.#hand.owner === null ? this.#idle_s + ticks.flags.length / PAGE_HZ : 0;
    if (this.#idle_s < IDLE_S) return;
    this.#idle_s = 0;
    this.rest();
  }

  #said(state) {
    if (state === "on") withdraw("sound");
    if (state !== "suspended" || !this.#listener) return;
    notify("sound", { text: texts.sound.suspended, help: texts.sound.suspended_help, action: this.#start });
  }

  #failed(kind) {
    const { no_worklet, no_worklet_help, failed, failed_help } = texts.sound;
    notify("sound", ["no_worklet", "wrong_rate"].includes(kind) ? { text: no_worklet, help: no_worklet_help }
      : { text: failed, help: failed_help, action: this.#start });
  }

  get #start() {
    return { label: texts.sound.start, run: () => this.#sound.start() };
  }
}
