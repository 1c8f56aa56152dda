// How the texture feels, as sliders: heard while they move, one edit of the base once they are released.

import { announce, element, find, showRefusal } from "../dom.js";
import { texts } from "../texts.js";
import { Axis } from "./axis.js";
import { Live } from "./live.js";

/** Axes that are shown first; the others are finer ones. */
const FIRST = ["rough", "slippery", "hard"];
const KINDS = ["steps", "encode"];
/** Without the model's scale, attributes are shown alone. */
const UNSCALED = Object.entries({ rough: "rough_db", slippery: "mu", hard: "hard_hz", sharp: "sharp_hz" })
  .map(([axis, attribute]) => ({ axis, attribute }));

const none = (steps) => Object.keys(steps).length === 0;

/** Makes the texture that lies `steps` from `base`. */
export const stepped = (server, base, steps, signal) =>
  none(steps) ? Promise.resolve(base) : server.edit(base, { steps }, signal);

/** The same without a picture, which takes longest. */
const drafted = (server, base, steps) => (none(steps) ? Promise.resolve(base) : server.edit(base, { steps, draft: true }));

export class Feel {
  #parts;
  #axes = [];
  #sliders = element("div", { class: "axes" });
  #finer = element("details", { class: "finer" }, element("summary", {}, texts.steer.finer));
  #note = element("p", { class: "small note" });
  #error = element("div", { class: "error", role: "alert" });
  #encode = element("button", { type: "button", hidden: true, onclick: () => this.#encoded() }, texts.steer.encode);
  #live;
  /** Steps from the base where the hand has brought the sliders. */
  #steps = {};

  constructor(parts) {
    this.#parts = parts;
    const { state, loader, session } = parts;
    this.#live = new Live(loader, (texture) => this.#heard(texture), (refusal) => showRefusal(this.#error, refusal));
    this.#sliders.title = texts.steer.scale;
    find("feel").append(this.#sliders, this.#finer, this.#note, this.#encode, this.#error);
    state.on(["about"], ({ about }) => about && this.#build(about.sliders?.length ? about.sliders : UNSCALED));
    session.on("change", () => {
      showRefusal(this.#error, null);
      this.#live.forget();
      this.#show();
    });
    loader.on("refused", ({ refusal, how }) => KINDS.includes(how?.kind) && this.#refused(refusal));
    this.#show();
  }

  /** Lets go of what a person holds, before something else happens. */
  release() {
    for (const axis of this.#axes) axis.held.release();
  }

  #build(sliders) {
    const hear = { moved: (axis, position) => this.#moved(axis, position), released: () => this.#released() };
    const places = (axis) => (FIRST.includes(axis) ? FIRST.indexOf(axis) : FIRST.length);
    const sorted = [...sliders].sort((a, b) => places(a.axis) - places(b.axis));
    this.#axes = sorted.map((about) => new Axis(about, hear));
    const [first, finer] = [true, false].map((wanted) => this.#axes.filter(({ name }) => FIRST.includes(name) === wanted));
    this.#sliders.replaceChildren(...first.map((axis) => axis.element));
    this.#finer.replaceChildren(this.#finer.firstElementChild, ...finer.map((axis) => axis.element));
    this.#finer.hidden = finer.length === 0;
    this.#show();
  }

  get #editable() {
    const { state, session } = this.#parts;
    return state.get("about")?.prompts !== false && session.current?.texture.editable === true;
  }

  #show(texture = this.#parts.session.current?.texture) {
    const { state, session } = this.#parts;
    const about = state.get("about");
    const entry = session.current;
    if (!this.#axes.some((axis) => axis.held.on)) this.#steps = entry?.steps ?? {};
    for (const axis of this.#axes) axis.show(texture, entry?.base, this.#editable);
    const offered = Boolean(entry) && !entry.texture.editable && about?.prompts !== false;
    this.#encode.hidden = !offered;
    const warnings = texture?.made?.warnings ?? [];
    this.#note.classList.toggle("warning", warnings.length > 0);
    this.#note.textContent = offered ? texts.steer.no_latent
      : entry && about?.prompts === false ? texts.steer.no_prompts
      : warnings.join("; ");
  }

  #moved(axis, position) {
    const { server, session, state } = this.#parts;
    const { base } = session.current;
    const steps = { ...this.#steps, [axis.up]: axis.steps(position) };
    this.#steps = Object.fromEntries(this.#axes.map(({ up }) => [up, steps[up]]).filter(([, by]) => by));
    const wanted = this.#steps;
    state.set({ draft: true });
    this.#live.hear(`draft ${this.#key(base)}`, () => drafted(server, base, wanted), base);
  }

  #released() {
    const { server, session, state } = this.#parts;
    const { base, steps } = session.current;
    const wanted = this.#steps;
    if (JSON.stringify(wanted) === JSON.stringify(steps)) {
      this.#live.forget();
      state.set({ draft: false });
      this.#show();
      return session.sound();
    }
    return this.#live.settle(this.#key(base), () => stepped(server, base, wanted), { kind: "steps", base, steps: wanted });
  }

  #key(base) {
    return `${base.id} ${JSON.stringify(this.#steps)}`;
  }

  #heard(texture) {
    if (this.#axes.some((axis) => axis.held.on)) this.#show(texture);
  }

  /** The sliders, and what is heard, go back to what is shown. */
  #refused(refusal) {
    showRefusal(this.#error, refusal);
    this.#live.forget();
    this.#show();
    this.#parts.session.sound();
  }

  #encoded() {
    const { server, session, loader } = this.#parts;
    const { texture } = session.current;
    announce(texts.steer.encoding);
    loader.take((signal) => server.encode(texture, signal), { kind: "encode", from: texture });
  }
}
