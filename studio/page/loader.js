// What a person asks of the server, and its textures to surface and sound; the latest request wins. While the server does
// not answer, that is said and tried again.

import { notify, withdraw } from "./dom.js";
import { Events } from "./events.js";
import { Refusal, Silence } from "./server.js";
import { texts } from "./texts.js";

const RETRY_MS = 3000;
/** How often a server is asked whether it is there, and how long it may take to answer. */
const WATCH_MS = 3000;
const PATIENCE_MS = 5000;

/** Emits "shown" and "refused", with { texture, how } and { refusal, how }; `how` is what `take` was given. */
export class Loader extends Events {
  #parts;
  #abort = new AbortController();
  /** Of the next attempt; `null` where none is to come. */
  #timer = null;
  #watch = null;
  #looking = false;

  constructor(parts) {
    super();
    this.#parts = parts;
  }

  /** Asks what the server has, and from then on whether it is there. */
  begin() {
    this.#watch ??= setInterval(() => this.#look(), WATCH_MS);
    return this.#attempt(async () => {
      const { server, state } = this.#parts;
      state.set({ about: await server.about() });
    });
  }

  compile(prompt, seed = 0) {
    return this.take((signal) => this.#parts.server.compile({ prompt, seed }, signal), { kind: "prompt", prompt, seed });
  }

  /**
   * Shows the texture that `make(signal)` gives; a later call takes its place. `how` says what a person did:
   * its `kind`, and what belongs to that.
   */
  take(make, how) {
    const { state } = this.#parts;
    return this.#attempt(async () => {
      this.#abort.abort();
      this.#abort = new AbortController();
      const { signal } = this.#abort;
      state.set({ busy: how });
      const texture = await make(signal);
      await this.#show(texture, how.entry?.base ?? how.base ?? texture, signal);
      this.emit("shown", { texture, how });
      state.set({ busy: false });
    }, how);
  }

  /** Gives up what is asked for. */
  cancel() {
    this.#abort.abort();
    this.#rest();
    this.#parts.state.set({ busy: false });
  }

  /**
   * Plays the texture that `make()` gives, as a draft: nothing else shows it, and what is shown next takes its place.
   * `from.base` is what its sliders began at. Its texture, or `null` where it comes too late or the server is silent.
   */
  async draft(make, from = {}) {
    const { server, sound } = this.#parts;
    const { signal } = this.#abort;
    try {
      const texture = await make();
      const asset = await server.asset(texture, signal);
      if (signal.aborted) return null;
      sound.play(asset, texture, from.base);
      return texture;
    } catch (error) {
      if (error.name === "AbortError" || error instanceof Silence) return null;
      throw error;
    }
  }

  /** Sound first: the picture may have to be drawn. */
  async #show(texture, base, signal) {
    const { server, state, surface, sound } = this.#parts;
    const asset = await server.asset(texture, signal);
    sound.play(asset, texture, base);
    state.set({ texture, asset });
    Promise.all(["unlit.png", "normal.png"].map((ending) => server.download(texture, ending, signal)))
      .then(([picture, normals]) => !signal.aborted && surface.show(picture, normals, texture.preview.width_mm))
      .then(() => withdraw("picture"))
      .catch(({ name, help, message }) => {
        if (name !== "AbortError") notify("picture", { text: texts.surface.no_picture, help: help ?? message });
      });
  }

  async #attempt(action, how) {
    this.#rest();
    try {
      await action();
      withdraw("server");
      // What failed before the server was back.
      if (!this.#parts.state.get("about")) this.begin();
    } catch (error) {
      if (error.name === "AbortError") return;
      if (error instanceof Silence) return this.#wait(action, how, error);
      this.#parts.state.set({ busy: false });
      withdraw("server");
      if (!(error instanceof Refusal)) throw error;
      this.emit("refused", { refusal: error, how });
    }
  }

  /** Notices a server that has ended, and one that hangs. */
  async #look() {
    const { server, state } = this.#parts;
    if (document.hidden || this.#looking || this.#timer !== null || !state.get("about")) return;
    this.#looking = true;
    const alive = () => server.alive(AbortSignal.timeout(PATIENCE_MS));
    try {
      await alive();
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      if (!(error instanceof Silence)) {
        // Another run of the studio stays another one.
        clearInterval(this.#watch);
        return notify("server", { text: error.message, help: error.help });
      }
      // Whatever waits for it is tried again when it is back.
      if (state.get("busy")) this.#abort.abort(error);
      else this.#wait(alive, undefined, error);
    } finally {
      this.#looking = false;
    }
  }

  #rest() {
    clearTimeout(this.#timer);
    this.#timer = null;
  }

  #wait(action, how, { message, help }) {
    const again = () => this.#attempt(action, how);
    const button = { label: texts.server.retry, run: again };
    notify("server", { text: message, help, action: button });
    this.#timer = setTimeout(again, RETRY_MS);
  }
}
