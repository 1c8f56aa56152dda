// Blend two textures, or compose one of the taps, the vibration and the friction of three.

import { element, find, showRefusal } from "../dom.js";
import { texts } from "../texts.js";
import { Choice } from "./choice.js";
import { Held, Live } from "./live.js";
import { describe } from "./timeline.js";

const PARTS = ["tap", "slide", "friction"];

export class Mix {
  #parts;
  #compare;
  #live;
  #drawer = find("change-drawer");
  #words = element("datalist", { id: "mix-words" });
  #error = element("div", { class: "error", role: "alert" });
  #t = element("input", { type: "range", id: "mix-t", min: 0, max: 1, step: 0.01, value: 0.5 });
  #t_text = element("output", { for: "mix-t" });
  #blended;
  #composed;
  #compose = element("button", { type: "button", onclick: () => this.#composes() }, texts.steer.mix.compose_now);

  constructor(parts, compare) {
    this.#parts = parts;
    this.#compare = compare;
    const { server, loader, session } = parts;
    this.#live = new Live(loader, () => {}, (refusal) => showRefusal(this.#error, refusal));
    const choice = (name, label) => new Choice({ server, name, label, words: "mix-words", changed: () => this.#enable() });
    this.#blended = ["a", "b"].map((name) => choice(name, texts.steer.mix.blend_of[name]));
    this.#composed = Object.fromEntries(PARTS.map((name) => [name, choice(name, texts.steer.mix.compose_of[name])]));
    const [a, b] = this.#blended;
    const group = (title, ...children) => element("fieldset", {}, element("legend", {}, title), ...children);
    find("mix").append(
      group(texts.steer.mix.blend, a.element, b.element,
        element("div", { class: "slider" }, element("label", { for: "mix-t" }, texts.steer.mix.t), this.#t_text, this.#t)),
      group(texts.steer.mix.compose, ...PARTS.map((name) => this.#composed[name].element), this.#compose), this.#error, this.#words);
    new Held(this.#t, { moved: () => this.#moves(), released: () => this.#settles() });
    this.#drawer.addEventListener("toggle", () => this.#offer());
    session.on("change", () => {
      showRefusal(this.#error, null);
      this.#offer();
    });
    compare.on("change", () => this.#offer());
    loader.on("refused", ({ refusal, how }) => {
      if (!["blend", "compose"].includes(how?.kind)) return;
      showRefusal(this.#error, refusal);
      session.sound();
    });
    this.#offer();
    this.#say();
  }

  #offer() {
    // Thousands of words, and every texture of the session five times: as long as nobody sees them, they are not there.
    if (!this.#drawer.open) return;
    const { session, state } = this.#parts;
    if (!this.#words.firstChild) this.#words.append(...(state.get("about")?.words ?? []).map((word) => element("option", { value: word })));
    const slots = this.#compare.filled.map(({ letter, entry }) => ({ label: `${letter}: ${describe(entry)}`, texture: entry.texture }));
    const { entries, at } = session;
    const [now, before] = [entries[at]?.texture, entries[at - 1]?.texture];
    const { kind, a, b, t } = session.current?.how ?? {};
    const blended = kind === "blend" && a && b;
    this.#blended[0].offer({ slots, entries }, before ?? now, blended && a);
    this.#blended[1].offer({ slots, entries }, before ? now : undefined, blended && b);
    if (blended) {
      this.#t.value = t;
      this.#say();
    }
    for (const name of PARTS) this.#composed[name].offer({ slots, entries }, now);
    this.#enable();
  }

  #enable() {
    const usable = this.#parts.state.get("about")?.prompts !== false;
    this.#t.disabled = !usable || this.#blended.some(({ key }) => !key);
    this.#compose.disabled = !usable || PARTS.some((name) => !this.#composed[name].key);
  }

  #say() {
    const text = texts.steer.mix.t_text(Number(this.#t.value));
    this.#t_text.textContent = text;
    this.#t.setAttribute("aria-valuetext", text);
  }

  get #key() {
    return [...this.#blended.map(({ key }) => key), this.#t.value].join("\n");
  }

  /** The blend as the controls are now, and the two that it lies between. */
  #blend(draft) {
    const t = Number(this.#t.value);
    const sources = Promise.all(this.#blended.map((choice) => choice.texture()));
    return { t, sources, make: async () => this.#parts.server.blend(...(await sources), t, draft) };
  }

  #moves() {
    this.#say();
    this.#parts.state.set({ draft: true });
    this.#live.hear(`draft ${this.#key}`, this.#blend(true).make);
  }

  #settles() {
    const { t, sources, make } = this.#blend(false);
    const how = { kind: "blend", t };
    sources.then(([a, b]) => Object.assign(how, { a, b }), () => {});
    return this.#live.settle(this.#key, make, how);
  }

  #composes() {
    const { server, loader } = this.#parts;
    const how = { kind: "compose" };
    return loader.take(async (signal) => {
      for (const name of PARTS) how[name] = await this.#composed[name].texture();
      return server.compose(how, signal);
    }, how);
  }
}
