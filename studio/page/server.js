// Where textures come from: the studio's server, or the files that its export wrote, which have the same addresses,
// and the compiler's module beside those.

import { ModuleFailure } from "./offline/module.js";
import { Offline } from "./offline/offline.js";
import { texts } from "./texts.js";

/** The server refused; `message` and `help` are the texts of the command, `status` that of HTTP. */
export class Refusal extends Error {
  help; status;

  constructor(message, help = undefined, status = undefined) {
    super(message);
    Object.assign(this, { help, status });
  }
}

/** The server did not answer. */
export class Silence extends Refusal {}

export class Server {
  #base;
  /** Static files, which any web server may give. */
  #exported = false;
  /** Who answers where files do not, or `null`. */
  #offline = null;
  #project = `api/project.json?page=${Math.random().toString(36).slice(2)}`;

  constructor(base = document.baseURI) {
    this.#base = base;
  }

  /** @returns {Promise<About>} */
  async about(signal = undefined) {
    const about = await this.#json("api/about.json", { signal });
    this.#exported = about.exported;
    if (about.compiler) this.#offline ??= new Offline(about, this.#base, (path) => this.#answer(path, {}));
    return about;
  }

  /** Whether static files take the place of a server. */
  get exported() {
    return this.#exported;
  }

  /** Whether the server is there; static files need none. */
  async alive(signal) {
    if (!this.#exported) await this.#answer("icon.svg", { method: "HEAD", cache: "no-store", signal });
  }

  /** @returns {Promise<Texture>} */
  compile({ prompt, seed = 0 }, signal = undefined) {
    return this.#post("api/compile", { prompt, seed }, signal);
  }

  /**
   * Another texture of one: `change` is { steps } or { words }, as of `asperity edit`; with { draft: true } it has no picture.
   * @param {Named} texture @returns {Promise<Texture>}
   */
  edit(texture, change, signal = undefined) {
    return this.#post("api/edit", { texture: texture.id, ...change }, signal);
  }

  /** Between two textures: `a` at 0, `b` at 1; a draft has no picture. @param {Named} a @param {Named} b @returns {Promise<Texture>} */
  blend(a, b, t, draft, signal = undefined) {
    return this.#post("api/blend", { a: a.id, b: b.id, t, draft }, signal);
  }

  /** Taps of one texture, vibration of another, friction of a third. @returns {Promise<Texture>} */
  compose({ tap, slide, friction }, signal = undefined) {
    return this.#post("api/compose", { tap: tap.id, slide: slide.id, friction: friction.id }, signal);
  }

  /** The latent of a texture that has none, as of `asperity encode`, so that it can be edited. @param {Named} texture @returns {Promise<Texture>} */
  encode(texture, signal = undefined) {
    return this.#post("api/encode", { texture: texture.id }, signal);
  }

  /**
   * What a recipe's link leads to: { texture, base, steps, same }.
   * @returns {Promise<{ texture: Texture, base: Texture | null, steps: Record<string, number> | null, same: boolean }>}
   */
  link(link, signal = undefined) {
    return this.#post("api/link", { link }, signal);
  }

  /**
   * A dropped file, with what is stated of a picture: { texture }, or { library } for one with several textures.
   * @returns {Promise<{ texture?: Texture, library?: About["library"] }>}
   */
  open(file, stated = {}, signal = undefined) {
    const options = { method: "POST", headers: { "Content-Type": "application/octet-stream" }, body: file, signal };
    return this.#json(`api/open?${new URLSearchParams({ name: file.name, ...stated })}`, options);
  }

  /** A dropped folder, the files of a recording, or of a material with what is stated of it: { texture }. @param {{ name: string, files: File[] }} folder @returns {Promise<{ texture: Texture }>} */
  openFolder({ name, files }, stated = {}, signal = undefined) {
    const list = files.map((file) => ({ name: file.name, bytes: file.size }));
    const body = new Blob([`${JSON.stringify(list)}\n`, ...files]);
    const options = { method: "POST", headers: { "Content-Type": "application/octet-stream" }, body, signal };
    return this.#json(`api/folder?${new URLSearchParams({ name, ...stated })}`, options);
  }

  /** How far the list is that is compiled: { done, total }, of 0 where none is. @returns {Promise<{ done: number, total: number }>} */
  batch() {
    return this.#json("api/batch.json", {});
  }

  stopBatch() {
    return this.#post("api/batch.json", {});
  }

  /** One library of a library's description in `about`, with the columns of its textures. @returns {Promise<Columns>} */
  library(id, signal = undefined) {
    return this.#json(`api/library/${id}.json`, { signal });
  }

  /** The texture at a place in a library. @returns {Promise<Texture>} */
  pick(library, index, signal = undefined) {
    return this.#json(`api/library/${library.id}/${index}.json`, { signal });
  }

  /** Its picture for an image: an address, to be revoked if it is a blob's. */
  thumbnail(library, index) {
    const { id, textures } = library;
    return this.#picture(textures ? `api/texture/${textures[index]}.png` : `api/library/${id}/${index}.png`);
  }

  /** What `asperity diff --json` prints of two libraries. */
  difference(old, now, signal) {
    return this.#json(`api/difference/${old.id}/${now.id}.json`, { signal });
  }

  /** A library of textures, each with its name there: [{ texture, name }]; a Blob. */
  async pack(named, signal) {
    const textures = named.map(({ texture, name }) => ({ texture: texture.id, name }));
    return (await this.#posted("api/pack", { textures }, signal)).blob();
  }

  /** What the servo loop behind the server did from the number `after` on. */
  deviceTicks(after) {
    return this.#json(`api/device/ticks${after === undefined ? "" : `?after=${after}`}`, {});
  }

  /** Has the device play a texture. */
  playOnDevice(texture) {
    return this.#post("api/device/play", { texture: texture.id });
  }

  /** What the server knows of a texture. @param {Named} texture @returns {Promise<Texture>} */
  shown(texture, signal = undefined) {
    return this.#json(`api/texture/${texture.id}.page.json`, { signal });
  }

  /** What the project keeps of the page; without anything, an empty object. From then on this page alone writes it. */
  project() {
    return this.#json(this.#project, {});
  }

  keepProject(kept) {
    return this.#post(this.#project, kept);
  }

  /** A file of a texture by its ending, such as "asp" or "export.wav": a Blob. */
  async download(texture, ending, signal) {
    return (await this.#answer(`api/texture/${texture.id}.${ending}`, { signal })).blob();
  }

  /** Its picture for an image, as `thumbnail`. */
  portrait(texture) {
    return this.#picture(`api/texture/${texture.id}.png`);
  }

  /** The asset for the worklet, an ArrayBuffer. */
  async asset(texture, signal) {
    return (await this.#answer(`api/texture/${texture.id}.worklet.asp`, { signal })).arrayBuffer();
  }

  /** A file of the page itself. */
  async file(name) {
    return (await this.#answer(name, {})).arrayBuffer();
  }

  async #picture(path) {
    return this.#offline?.asks(path) ? URL.createObjectURL(await (await this.#answer(path, {})).blob())
      : new URL(path, this.#base).href;
  }

  #posted(path, value, signal) {
    return this.#answer(path,
      { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(value), signal });
  }

  async #post(path, value, signal) {
    return this.#read(path, await this.#posted(path, value, signal));
  }

  async #json(path, options) {
    return this.#read(path, await this.#answer(path, options));
  }

  async #read(path, response) {
    try {
      const value = await response.json();
      this.#offline?.met(path, value);
      return value;
    } catch (error) {
      if (error.name === "AbortError") throw error;
      throw new Refusal(texts.server.unreadable, texts.server.unreadable_help);
    }
  }

  async #answer(path, options) {
    let response;
    try {
      response = await (this.#offline?.asks(path, options.method) ? this.#offline.ask(path, options)
        : fetch(new URL(path, this.#base), options));
      options.signal?.throwIfAborted();
    } catch (error) {
      if (error.name === "AbortError" || error instanceof Refusal) throw error;
      if (error instanceof ModuleFailure) throw new Refusal(texts.offline.failed(error.message), texts.offline.failed_help);
      const { gone, gone_help } = this.#exported ? texts.exported : texts.server;
      throw new Silence(gone, gone_help);
    }
    if (response.ok) return response;
    const { error, help } = await response.json().catch(() => ({}));
    if (error) throw new Refusal(error, help, response.status);
    if (this.#exported) throw new Refusal(texts.exported.missing(path), texts.exported.missing_help);
    // Without the token there is no text.
    if (response.status === 404) throw new Refusal(texts.server.other_run, texts.server.other_run_help);
    throw new Refusal(texts.server.unreadable, texts.server.unreadable_help);
  }
}
