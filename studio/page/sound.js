// From the hand to the loudspeaker: the sound's state, its texture, its level, its device. `output/chain.js` has the nodes.

import { Events } from "./events.js";
import { now_s } from "./hand.js";
import { buildChain, FADE_S } from "./output/chain.js";
import { openContext, SoundFailure } from "./output/context.js";
import { Loudness } from "./output/loudness.js";
import { MODES } from "./output/modes.js";
import { Renderer } from "./output/renderer.js";

/** How long a browser may take to start, ms, until that is said. */
const PATIENCE_MS = 3000;

/** Until the runtime's cross-fade to a texture has ended, s. */
const CROSS_FADE_S = 0.05;

/** When a fade has ended. */
const silence = () => new Promise((done) => setTimeout(done, 4000 * FADE_S));

/**
 * Emits "state"; "failure" with a `SoundFailure`; "loaded" and "refused" with the renderer's status of a texture; "louder"
 * with what the level has to go down by for a texture, dB; its "ticks"; "limit" with what the limiter takes off, dB; "path"
 * with the phase of the hand that moves by itself, or null when another took its place.
 */
export class Sound extends Events {
  /** "off", "starting", "on" or "suspended". */
  state = "off";
  /** What the sound is for, of `MODES`, and the level, dB of full scale. */
  mode = "plain";
  level_db = MODES.plain.start_db;
  /** Whether the browser lets the page sound before anybody has touched it. */
  allowed = false;
  /** Stopped by a person, so that only a person starts it again. */
  stopped = false;
  /** Sink that was chosen; empty is the system's default. */
  sink = "";
  /** The nodes, while there are some; others look at them. */
  chain = null;
  #context = null;
  #gains_db = null;
  #loudness = new Loudness();
  /** While the nodes are built. */
  #building = null;
  #path = null;
  /** The last events of the hand. */
  #touch = null;
  #renderer = new Renderer();
  #file;

  /** `file` gives the bytes of a file of the page. */
  constructor(file) {
    super();
    this.#file = file;
    const renderer = this.#renderer;
    for (const event of ["ticks", "path", "loaded", "refused"]) renderer.on(event, (detail) => this.emit(event, detail));
    renderer.on("ready", () => this.emit("state", this.state));
    renderer.on("plays", () => this.chain.trim(this.trim_db, CROSS_FADE_S));
    renderer.on("failure", (detail) => this.#fail(new SoundFailure("failed", detail)));
  }

  /** From the hand to the sound as far as the browser knows, s. */
  get total_latency_s() {
    const { baseLatency = 0, outputLatency = 0 } = this.#context ?? {};
    return this.#renderer.latency_s + (outputLatency || baseLatency);
  }

  /** Builds the nodes, silent, so that the first stroke is heard. */
  async prepare() {
    // What fails now is said when somebody wants the sound.
    await this.#built().catch(() => this.#drop());
    if (this.state !== "off") return;
    this.allowed = this.#context?.state === "running";
    this.#context?.suspend();
  }

  /** Starts or resumes; call it from a click, a key or a touch. */
  async start() {
    if (this.state === "on") return;
    // A finger is a gesture when it is lifted only, by a second call.
    this.#context?.resume().catch(() => {});
    if (this.state === "starting") return;
    this.#enter("starting");
    try {
      await this.#built();
      // Browsers hold back sound without a gesture, and then this promise too.
      await Promise.race([this.#context.resume(), new Promise((done) => setTimeout(done, PATIENCE_MS))]);
      if (this.#context.state === "running") this.#running();
      else this.#enter("suspended");
    } catch (error) {
      // The device or the renderer failed meanwhile, which is known already.
      if (this.state !== "starting") return;
      this.#fail(error instanceof SoundFailure ? error : new SoundFailure("failed", String(error)));
    }
  }

  async stop() {
    if (this.state === "off") return;
    this.#enter("off");
    this.#turn(0);
    await silence();
    if (this.state === "off") await this.#context?.suspend();
  }

  set level(level_db) {
    this.level_db = level_db;
    if (this.state === "on") this.#turn(1);
  }

  /** Changes the mode in silence, and to the level that the other begins with. */
  async use(mode) {
    this.mode = mode;
    this.level_db = MODES[mode].start_db;
    const chain = this.chain;
    this.#turn(0);
    await silence();
    // Another one may have been chosen meanwhile.
    if (!chain || this.mode !== mode || chain !== this.chain) return;
    chain.mode = mode;
    if (this.state === "on") this.#turn(1);
    this.emit("state", this.state);
  }

  /** Plays all textures equally loud, or each as strong as it is. */
  balance(equal) {
    this.#loudness.balance(equal);
    this.chain?.trim(this.trim_db);
  }

  /** What plays is turned up or down by this, dB. */
  get trim_db() {
    return this.#loudness.trim_db;
  }

  /** Gains of the equaliser, dB. */
  equalise(gains_db) {
    this.#gains_db = gains_db;
    if (this.chain) this.chain.equaliser.gains_db = gains_db;
  }

  /** Plays another texture: from its first tick on, or by a cross-fade where one plays; `base` is what its sliders began at. */
  play(asset, texture, base = texture) {
    const { rises, louder_db } = this.#loudness.play(texture, base);
    if (louder_db > 0) this.emit("louder", louder_db);
    // What gets quieter does so before the cross-fade, and what gets louder after it.
    if (!rises) this.chain?.trim(this.trim_db);
    this.#renderer.play(asset, this.state === "on");
  }

  /** Events of the hand; nobody hears them while the sound is off. The touch that starts it is felt when it is on. */
  hand(events) {
    if (this.state === "on") this.#renderer.post({ type: "hand", events });
    this.#touch = events;
  }

  /** The path of the hand that moves by itself (`path.js`), as soon as the sound is on; null lifts it. */
  follow(path) {
    this.#path = path;
    if (this.state === "on") this.#renderer.post({ type: "path", path, t_s: now_s() });
  }

  /** Plays on another device; false where that fails. */
  async choose(sink) {
    this.sink = sink;
    try {
      await this.#context?.setSinkId?.(sink);
      return true;
    } catch {
      this.sink = "";
      await this.#context?.setSinkId?.("").catch(() => {});
      return false;
    } finally {
      // Another device may have other channels.
      this.chain?.route();
      if (this.state === "on") this.#turn(1);
      this.emit("state", this.state);
    }
  }

  /** Peak and RMS of the last 40 ms of the output, in full scales. */
  measure() {
    return this.state === "on" ? this.chain.measure() : { peak: 0, rms: 0 };
  }

  #built = () => (this.#building ??= this.#build());

  async #build() {
    const context = openContext((opened) => (this.#context = opened));
    // Within the gesture, before anything is awaited.
    if (this.state === "starting") context.resume().catch(() => {});
    context.onerror = () => this.#fail(new SoundFailure("no_device"));
    const chain = await buildChain(context, this.#file("asperity.wasm"), this.mode);
    if (this.sink) await context.setSinkId(this.sink).catch(() => (this.sink = ""));

    // Another mode may have been chosen meanwhile, and another device have other channels.
    this.chain = chain;
    chain.mode = this.mode;
    chain.trim(this.trim_db);
    if (this.#gains_db) chain.equaliser.gains_db = this.#gains_db;
    chain.limiter.port.onmessage = ({ data }) => this.emit("limit", data.reduction_db);
    for (const node of chain.worklets) node.onprocessorerror = () => this.#fail(new SoundFailure("failed", "processor"));
    context.onstatechange = () => this.#changed(context);
    this.#renderer.connect(chain.renderer.port);
  }

  #changed(context) {
    if (context !== this.#context || this.state === "off") return;
    if (context.state === "running") this.#running();
    // "interrupted" is Safari's, for a call that comes in.
    else if (this.state === "on") this.#enter("suspended");
  }

  #running() {
    if (this.state === "off" || !this.chain) return;
    this.#turn(1);
    this.#enter("on");
    if (this.#path) this.follow(this.#path);
    else if (this.#touch) this.hand(this.#touch);
  }

  #fail(failure) {
    this.#drop();
    this.#enter("off");
    this.emit("failure", failure);
  }

  /** Gives up the context; the next start builds another. */
  #drop() {
    const context = this.#context;
    this.#context = null;
    this.#building = null;
    this.chain = null;
    this.#renderer.disconnect();
    if (!context) return;
    context.onstatechange = null;
    context.close().catch(() => {});
  }

  /** Fades to the level, or to silence where `on` is 0 and until the mode is the one chosen. */
  #turn(on) {
    this.chain?.turn(this.level_db, on && this.chain.mode === this.mode);
  }

  #enter(state) {
    if (this.state === state) return;
    this.state = state;
    this.emit("state", this.state);
  }
}
