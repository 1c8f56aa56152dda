// Where textures come from. The page uses these methods only, so that a static export can give an
// object with the same ones instead.

import { texts } from "./texts.js";

/** The server refused; `message` and `help` are the texts of the command. */
export class Refusal extends Error {
  constructor(message, help) {
    super(message);
    this.help = help;
  }
}

/** The server did not answer. */
export class Silence extends Error {}

export class Server {
  #base;

  constructor(base = document.baseURI) {
    this.#base = base;
  }

  about(signal) {
    return this.#json("api/about", { signal });
  }

  compile(prompt, signal) {
    const body = JSON.stringify({ prompt, seed: 0 });
    return this.#json("api/compile", { method: "POST", headers: { "Content-Type": "application/json" }, body, signal });
  }

  /** The asset for the worklet, an ArrayBuffer. */
  async asset(texture, signal) {
    return (await this.#answer(`api/texture/${texture.id}.worklet.asp`, { signal })).arrayBuffer();
  }

  async picture(texture, signal) {
    return (await this.#answer(`api/texture/${texture.id}.png`, { signal })).blob();
  }

  async normals(texture, signal) {
    return (await this.#answer(`api/texture/${texture.id}.normal.png`, { signal })).blob();
  }

  /** A file of the page itself. */
  async file(name) {
    return (await this.#answer(name, {})).arrayBuffer();
  }

  async #json(path, options) {
    const response = await this.#answer(path, options);
    try {
      return await response.json();
    } catch (error) {
      if (error.name === "AbortError") throw error;
      throw new Refusal(texts.server.unreadable, texts.server.unreadable_help);
    }
  }

  async #answer(path, options) {
    let response;
    try {
      response = await fetch(new URL(path, this.#base), options);
    } catch (error) {
      if (error.name === "AbortError") throw error;
      throw new Silence(texts.server.gone);
    }
    if (response.ok) return response;
    const { error, help } = await response.json().catch(() => ({}));
    if (error) throw new Refusal(error, help);
    // Without the token there is no text.
    if (response.status === 404) throw new Refusal(texts.server.other_run, texts.server.other_run_help);
    throw new Refusal(texts.server.unreadable, texts.server.unreadable_help);
  }
}
