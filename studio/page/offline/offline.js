// Who answers on an exported page with a compiler: its files as far as they go, else the module. What the module needs
// of the files it is given first.

import { find } from "../dom.js";
import { texts } from "../texts.js";
import { Module } from "./module.js";

/** What names a texture. */
const ID = /\b[0-9a-f]{32}\b/g;
/** Files of each texture that are there beside those that are offered. */
const LOADED = ["worklet.asp", "unlit.png"];

export class Offline {
  #module;
  #fetch;
  #files;
  #library;
  /** The names of assets' files, by what names the textures of this page; `null` until one was picked. */
  #exported = new Map();
  /** Textures that the module knows. */
  #known = new Set();

  /** `fetched(path)` gives the Response of the web server; `about` is what the page is. */
  constructor(about, base, fetched) {
    this.#module = new Module(new URL(about.compiler.file, base).href, about.version);
    this.#fetch = fetched;
    this.#files = [...about.files, ...LOADED];
    this.#library = about.library?.id;
    const total = about.compiler.bytes;
    this.#module.on("load", (bytes) => {
      find("opening").textContent = bytes === null ? "" : texts.offline.loading(bytes / 1e6, total / 1e6);
    });
    this.#module.on("fail", () => this.#known.clear());
  }

  /** Hears of what was answered: textures that files describe are given to the module once it needs them. */
  met(path, { id, file, textures, texture }) {
    const isOfFiles = path.startsWith("api/library/") && !this.#isAsked(path);
    if (isOfFiles && textures) for (const each of textures) this.#exported.set(each, null);
    else if (isOfFiles) this.#exported.set(id, file);
    else if (texture ?? file) this.#known.add(texture?.id ?? id);
  }

  /** Whether the module answers this path, and not a file. */
  asks(path, method = "GET") {
    return path.startsWith("api/") && (method !== "GET" || this.#isAsked(path));
  }

  /** The Response to a request that `asks` holds for. */
  async ask(path, { body = undefined } = {}) {
    const bytes = body === undefined ? undefined : await new Response(body).arrayBuffer();
    const said = typeof body === "string" ? body : path;
    for (const [id] of said.matchAll(ID)) await this.#give(id);
    return this.#module.ask(path, bytes);
  }

  #isAsked(path) {
    const [, kind, name, ending] = /^api\/(library|texture)\/([^/.]+)[/.](.*)$/.exec(path) ?? [];
    if (kind === "library") return name !== this.#library;
    if (kind === "texture") return !(this.#exported.has(name) && this.#files.includes(ending));
    return path !== "api/about.json";
  }

  /** Has the module open an asset of this page. */
  async #give(id) {
    const file = this.#exported.get(id);
    if (!file || this.#known.has(id)) return;
    const asset = await this.#fetch(`api/texture/${id}.asp`);
    const opened = await this.#module.ask(`api/open?name=${encodeURIComponent(file)}`, await asset.arrayBuffer());
    if (opened.ok) this.#known.add(id);
  }
}
