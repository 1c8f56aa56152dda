// A texture as a link: behind the # of an address, its recipe, which makes the same bytes in any studio, or its name in the
// library of an exported page.

import { notify, withdraw } from "./dom.js";
import { Refusal } from "./server.js";
import { texts } from "./texts.js";

const RECIPE = /#recipe=([\w-]+)/;
const TEXTURE = /#texture=([^&\s]+)/;

export class Links {
  #parts;

  /** `from(texture)` says where it was picked. */
  constructor(parts) {
    this.#parts = parts;
    const { server, loader } = parts;
    loader.on("refused", ({ refusal: { message, help }, how }) => {
      if (how?.kind === "link") notify("link", { text: texts.link.not_opened(message), help });
    });
    loader.on("shown", ({ texture }) => {
      // The address of an exported page says what it shows. That of a studio holds a secret, and its project says it.
      if (server.exported) history.replaceState(null, "", this.of(texture) ?? location.pathname);
      else if (location.hash) history.replaceState(null, "", location.pathname);
    });
    addEventListener("hashchange", () => this.open(location.hash));
    addEventListener("paste", (event) => this.open(event.clipboardData?.getData("text") ?? "") && event.preventDefault());
  }

  /** What stands behind the address for a texture; `null` where it comes from a file that others need not have. */
  of(texture) {
    if (texture.link) return `#recipe=${texture.link}`;
    const [library, name] = this.#parts.from(texture)?.split("\n") ?? [];
    return library !== undefined && library === this.#library?.name ? `#texture=${encodeURIComponent(name)}` : null;
  }

  /** What is copied: of an exported page the whole address. */
  address(texture) {
    const link = this.of(texture);
    return link && this.#parts.server.exported ? new URL(link, location.href).href : link;
  }

  /** Shows what a text links to; whether it holds a link at all. */
  open(text) {
    const { loader, state } = this.#parts;
    const [, recipe] = RECIPE.exec(text) ?? [];
    const [, name] = TEXTURE.exec(text) ?? [];
    if (recipe === undefined && name === undefined) return false;
    withdraw("link");
    if (recipe !== undefined && !state.get("about")?.prompts) {
      notify("link", { text: texts.link.no_compiler, help: texts.link.no_compiler_help });
      return false;
    }
    const how = { kind: "link" };
    loader.take((signal) => (recipe === undefined ? this.#named(decodeURIComponent(name), signal) : this.#made(recipe, how, signal)), how);
    return true;
  }

  get #library() {
    return this.#parts.state.get("about")?.library;
  }

  async #made(recipe, how, signal) {
    const { texture, base, steps, same } = await this.#parts.server.link(recipe, signal);
    if (base) Object.assign(how, { kind: "steps", base, steps });
    else if (texture.compiled) Object.assign(how, { kind: "prompt", prompt: texture.compiled.prompt, seed: texture.seed });
    if (!same) notify("link", { text: texts.link.other(texture.name), help: texts.link.other_help });
    return texture;
  }

  async #named(name, signal) {
    const { server } = this.#parts;
    const columns = this.#library && await server.library(this.#library.id, signal);
    const place = columns?.names.indexOf(name) ?? -1;
    if (place < 0) throw new Refusal(texts.link.unknown(name), texts.link.unknown_help);
    return server.pick(columns, place, signal);
  }
}
