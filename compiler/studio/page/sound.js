// From the hand to the loudspeaker: the renderer's worklet, trim, drive, limiter, volume, meter.
//
// A level above 0 dB drives the limiter, one below turns down what leaves it. So no output exceeds the
// level, whatever the texture does. Connection order is that of `chain`; what prepares the signal for
// an ear or an actuator belongs between the renderer and the drive.

const fromDb = (db) => 10 ** (db / 20);

const RATE_HZ = 48000;
/** Acceleration of full scale at a level of 0 dB, m/s²: nearly twice the usual peaks of taps, 22 m/s². */
const FULL_SCALE_M_S2 = 40;
/** Level to begin with, hence the loudest peak at first, dB of full scale. */
export const START_LEVEL_DB = -20;
/** What the limiter lets through, −1 dB of full scale. */
const CEILING = fromDb(-1);
const FADE_S = 0.03;
/** How long a browser may take to start, ms, until that is said. */
const PATIENCE_MS = 3000;

/** Why the sound does not start or has stopped. */
export class SoundFailure extends Error {
  /** `kind`: "no_worklet", "wrong_rate", "no_device" or "failed". */
  constructor(kind, detail) {
    super(kind);
    Object.assign(this, { kind, detail });
  }
}

export class Sound {
  /** "off", "starting", "on" or "suspended". */
  state = "off";
  level_db = START_LEVEL_DB;
  /** What this texture is turned down by so that others are as loud, dB. */
  #trim_db = 0;
  latency_s = 0;
  /** Stopped by a person, so that only a person starts it again. */
  stopped = false;
  /** Sink that was chosen; empty is the system's default. */
  sink = "";
  #context = null;
  #renderer = null;
  #trim;
  #drive;
  #volume;
  #analyser;
  #samples;
  #asset = null;
  #loaded = false;
  #file;

  /** `file` gives the bytes of a file of the page. */
  constructor(file) {
    this.#file = file;
  }

  // What others hear of. `onloaded` has the renderer's status of a texture that plays now.
  onstate = () => {};
  onfailure = () => {};
  onloaded = () => {};
  onrefused = () => {};
  onticks = [];
  onlimit = () => {};

  /** From the hand to the sound as far as the browser knows, s. */
  get total_latency_s() {
    const { baseLatency = 0, outputLatency = 0 } = this.#context ?? {};
    return this.latency_s + (outputLatency || baseLatency);
  }

  /** Starts or resumes; call it from a click, a key or a touch. */
  async start() {
    if (this.state === "on") return;
    // A finger is a gesture when it is lifted only, by a second call.
    this.#context?.resume().catch(() => {});
    if (this.state === "starting") return;
    this.#enter("starting");
    try {
      if (!this.#context) await this.#build();
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
    await new Promise((done) => setTimeout(done, 4000 * FADE_S));
    if (this.state === "off") await this.#context?.suspend();
  }

  set level(level_db) {
    this.level_db = level_db;
    if (this.state === "on") this.#turn(1);
  }

  set trim(trim_db) {
    this.#trim_db = trim_db;
    this.#trim?.gain.setTargetAtTime(fromDb(trim_db), this.#context.currentTime, FADE_S);
  }

  /** Plays another texture: from its first tick on, or by a cross-fade where one plays. */
  play(asset) {
    this.#asset = asset;
    if (this.#renderer) this.#send();
  }

  /** Events of the hand; nobody hears them while the sound is off. */
  hand(events) {
    if (this.state === "on") this.#renderer.port.postMessage({ type: "hand", events });
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
    }
  }

  /** Peak and RMS of the last 40 ms of the output, in full scales. */
  measure() {
    if (this.state !== "on") return { peak: 0, rms: 0 };
    this.#analyser.getFloatTimeDomainData(this.#samples);
    let [peak, sum] = [0, 0];
    for (const x of this.#samples) {
      peak = Math.max(peak, Math.abs(x));
      sum += x * x;
    }
    return { peak, rms: Math.sqrt(sum / this.#samples.length) };
  }

  async #build() {
    if (!globalThis.AudioContext || !globalThis.AudioWorkletNode) throw new SoundFailure("no_worklet");
    const context = new AudioContext({ sampleRate: RATE_HZ, latencyHint: "interactive" });
    this.#context = context;
    if (context.sampleRate !== RATE_HZ) throw new SoundFailure("wrong_rate", context.sampleRate);
    // Within the gesture, before anything is awaited.
    context.resume().catch(() => {});
    context.onerror = () => this.#fail(new SoundFailure("no_device"));
    const modules = ["worklet.js", "limiter.js"].map((name) => context.audioWorklet.addModule(new URL(name, document.baseURI)));
    const [module] = await Promise.all([this.#file("asperity.wasm"), ...modules]);
    if (this.sink) await context.setSinkId(this.sink).catch(() => (this.sink = ""));

    const renderer = new AudioWorkletNode(context, "asperity",
      { numberOfInputs: 0, outputChannelCount: [1], processorOptions: { module } });
    const [trim, drive, volume] = [fromDb(this.#trim_db), 1 / FULL_SCALE_M_S2, 0].map((gain) => new GainNode(context, { gain }));
    const limiter = new AudioWorkletNode(context, "limiter",
      { outputChannelCount: [1], processorOptions: { ceiling: CEILING } });
    const analyser = new AnalyserNode(context, { fftSize: 2048 });
    const chain = [renderer, trim, drive, limiter, volume, analyser, context.destination];
    chain.slice(1).forEach((node, n) => chain[n].connect(node));

    this.#renderer = renderer;
    this.#trim = trim;
    this.#drive = drive;
    this.#volume = volume;
    this.#analyser = analyser;
    this.#samples = new Float32Array(analyser.fftSize);
    this.#loaded = false;
    renderer.port.onmessage = ({ data }) => this.#heard(data);
    limiter.port.onmessage = ({ data }) => this.onlimit(data.reduction_db);
    for (const node of [renderer, limiter]) node.onprocessorerror = () => this.#fail(new SoundFailure("failed", "processor"));
    context.onstatechange = () => this.#changed(context);
    renderer.port.postMessage({ type: "record", on: true });
    if (this.#asset) this.#send();
  }

  #send() {
    const type = this.#loaded ? "swap" : "load";
    this.#loaded = true;
    this.#renderer.port.postMessage({ type, asset: this.#asset });
  }

  #heard(message) {
    if (message.type === "ticks") return this.onticks.forEach((hear) => hear(message));
    const { about, name, latency_s } = message;
    if (about === "module" && name === "ok") this.latency_s = latency_s;
    else if (about === "load" || about === "swap") {
      if (name === "ok") this.onloaded(message);
      // A later texture took its place.
      else if (name !== "replaced") this.onrefused(message);
    } else if (name !== "ok") this.#fail(new SoundFailure("failed", `${about}: ${name}`));
    if (about === "module") this.onstate(this.state);
  }

  #changed(context) {
    if (context !== this.#context || this.state === "off") return;
    if (context.state === "running") this.#running();
    // "interrupted" is Safari's, for a call that comes in.
    else if (this.state === "on") this.#enter("suspended");
  }

  #running() {
    if (this.state === "off" || !this.#renderer) return;
    this.#turn(1);
    this.#enter("on");
  }

  /** Gives up the context; the next start builds another. */
  #fail(failure) {
    const context = this.#context;
    this.#context = null;
    this.#renderer = null;
    this.#trim = null;
    this.#enter("off");
    if (context) {
      context.onstatechange = null;
      context.close().catch(() => {});
    }
    this.onfailure(failure);
  }

  /** Fades to the level, or to silence where `on` is 0. */
  #turn(on) {
    if (!this.#renderer) return;
    const now_s = this.#context.currentTime;
    const [drive, volume] = [fromDb(Math.max(this.level_db, 0)) / FULL_SCALE_M_S2, on * fromDb(Math.min(this.level_db, 0))];
    this.#drive.gain.setTargetAtTime(drive, now_s, FADE_S);
    this.#volume.gain.setTargetAtTime(volume, now_s, FADE_S);
  }

  #enter(state) {
    if (this.state === state) return;
    this.state = state;
    this.onstate(state);
  }
}
