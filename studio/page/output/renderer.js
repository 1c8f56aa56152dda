// What the renderer in its worklet is sent, and what it says.

import { Events } from "../events.js";

/**
 * Emits "ready"; "loaded" and "refused" with its status of a texture, "plays" when that is the one sent last; "failure" with
 * why; its "ticks"; "path" with the phase of the hand that moves by itself, or null when another took its place.
 */
export class Renderer extends Events {
  /** From the hand to what it gives, s. */
  latency_s = 0;
  #port = null;
  #asset = null;
  #loaded = false;
  /** Textures that were sent. */
  #sent = 0;

  /** Speaks to a new worklet, which gets the texture that plays. */
  connect(port) {
    this.#port = port;
    this.#loaded = false;
    port.onmessage = ({ data }) => this.#heard(data);
    this.post({ type: "record", on: true });
    if (this.#asset) this.play(this.#asset);
  }

  disconnect() {
    this.#port = null;
  }

  /** Plays a texture, as soon as there is a worklet: by a cross-fade where that is wished and another one plays. */
  play(asset, fades = false) {
    this.#asset = asset;
    if (!this.#port) return;
    this.post({ type: this.#loaded && fades ? "swap" : "load", asset, id: ++this.#sent });
    this.#loaded = true;
  }

  post(message) {
    this.#port.postMessage(message);
  }

  #heard(message) {
    const { type, about, name } = message;
    if (type === "ticks") this.emit("ticks", message);
    else if (type === "path") this.emit("path", message.phase);
    else if (about === "load" || about === "swap") {
      if (name === "ok" && message.id === this.#sent) this.emit("plays");
      if (name === "ok") this.emit("loaded", message);
      // A later texture took its place.
      else if (name !== "replaced") this.emit("refused", message);
    } else if (name !== "ok") this.emit("failure", `${about}: ${name}`);
    else if (about === "module") {
      this.latency_s = message.latency_s;
      this.emit("ready");
    }
  }
}
