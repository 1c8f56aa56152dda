// What a person asks of the server, and its textures to surface and sound; the latest request wins. While the server does
// not answer, that is said and tried again.

import { notify, withdraw } from "./dom.js";
import { Events } from "./events.js";
import { Refusal, Silence } from "./server.js";
import { texts } from "./texts.js";

const RETRY_MS = 3000;

/** Emits "shown" and "refused", with { texture, how } and { refusal, how }; `how` is what `take` was given. */
export class Loader extends Events {
  #parts;
  #abort = new AbortController();
  #timer = null;

  constructor(parts) {
    super();
    this.#parts = parts;
  }

  /** Asks what the server has. */
  begin() {
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
    this.#abort.abort();
    this.#abort = new AbortController();
    const { signal } = this.#abort;
    return this.#attempt(async () => {
      state.set({ busy: how });
      const texture = await make(signal);
      await this.#show(texture, signal);
      this.emit("shown", { texture, how });
      state.set({ busy: false });
    }, how);
  }

  /**
   * Plays the texture that `make()` gives, as a draft: nothing else shows it, and what is shown next takes its place.
   * Its texture, or `null` where it comes too late or the server is silent.
   */
  async draft(make) {
    const { server, sound } = this.#parts;
    const { signal } = this.#abort;
    try {
      const texture = await make();
      const asset = await server.asset(texture, signal);
      if (signal.aborted) return null;
      sound.play(asset);
      return texture;
    } catch (error) {
      if (error.name === "AbortError" || error instanceof Silence) return null;
      throw error;
    }
  }

  /** Sound first: the picture may have to be drawn. */
  async #show(texture, signal) {
    const { server, state, surface, sound } = this.#parts;
    const asset = await server.asset(texture, signal);
    sound.play(asset);
    state.set({ texture, asset });
    Promise.all(["png", "normal.png"].map((ending) => server.download(texture, ending, signal)))
      .then(([picture, normals]) => !signal.aborted && surface.show(picture, normals, texture.preview.width_mm))
      .then(() => withdraw("picture"))
      .catch(({ name, help, message }) => {
        if (name !== "AbortError") notify("picture", { text: texts.surface.no_picture, help: help ?? message });
      });
  }

  async #attempt(action, how) {
    clearTimeout(this.#timer);
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

  #wait(action, how, { message, help }) {
    const again = () => this.#attempt(action, how);
    const button = { label: texts.server.retry, run: again };
    notify("server", { text: message, help, action: button });
    this.#timer = setTimeout(again, RETRY_MS);
  }
}
