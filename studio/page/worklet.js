// The AudioWorkletProcessor `asperity`: hand, runtime and upsampler in a WebAssembly module.
//
// The page gives the bytes of `asperity.wasm`, since Safari cannot clone a compiled module, and may
// give an asset to begin with:
//
//   new AudioWorkletNode(context, "asperity", {
//     numberOfInputs: 0, outputChannelCount: [1],
//     processorOptions: { module: ArrayBuffer, asset?: ArrayBuffer, seed?: 1n, delay_s?: 0.02 } });
//
// The context runs at 48 kHz. The output is an acceleration in m/s², not in full scales: what
// `asperity render --rate 16000` has as vib_m_s2 + tap_n / effective_mass_kg, 11 ticks late.
//
// Messages to the port:
//   { type: "load", asset, seed?, id? }  a session from its first tick on; answered by a status
//   { type: "swap", asset, id? }         a cross-fade to another texture; answered when it begins
//   { type: "hand", events }             Float64Array, five numbers an event: time, s, on any clock
//                                        of the page; x, y, z, mm; stroke. z < 0 presses with
//                                        stiffness_n_m · (−z / 1000) N; what gives way is followed down. Another number of the stroke
//                                        means that the pointer was put down elsewhere.
//   { type: "path", path, t_s }          a hand that moves by itself (`path.js`) from the page's time t_s on; null lifts
//                                        it, and events of the hand take its place
//   { type: "record", on }               whether ticks are posted; those from a load to a swap have the
//                                        bits of the command
//   { type: "end" }                      the node is not needed any more
// Messages from the port:
//   { type: "status", about, id, status, name, … }  about: "module", "context", "load", "swap", "hand";
//       status 0 of "module" has latency_s; of "load" and "swap", session, tick, stiffness_n_m,
//       effective_mass_kg, model_rate_hz of the asset; "rate" has model_rate_hz of the refused asset
//   { type: "path", phase }  where the hand that moves by itself is, sixty times a second; null when it lost its place
//   { type: "ticks", session, first, positions_mm, columns, flags }  three, nine numbers and one a tick
//
// An AudioWorklet has no TextDecoder, atob or performance, and `process` may come before the module.

import { Walk } from "./path.js";
import { Recorder } from "./recorder.js";

/** What the module returns, by number (`worklet/src/status.rs`); the last ones are this file's. */
const STATUS = ["ok", "rate", "format", "capacity", "conditioning", "busy", "empty", "length", "event", "runtime",
  "module", "context", "replaced"];
const [OK, RATE, BUSY] = ["ok", "rate", "busy"].map((name) => STATUS.indexOf(name));
const FRAME_HZ = 48000;
const EVENT_NUMBERS = 5;
/** Frames between two messages of where the hand is. */
const PATH_FRAMES = 800;

class AsperityProcessor extends AudioWorkletProcessor {
  constructor(options) {
    super();
    const { module, asset, seed, delay_s } = options.processorOptions;
    this.recorder = new Recorder(this.port);
    this.session = 0;
    this.tick = 0;
    this.ended = false;
    this.walk = new Walk();
    this.unsaid = 0;
    /** Messages that came before the module. */
    this.early = asset === undefined ? [] : [{ type: "load", asset, seed }];
    /** A swap that waits for a spare slot of the runtime, and those that the runtime has. */
    this.waiting = null;
    this.sent = [];
    this.port.onmessage = ({ data }) => (this.module ? this.take(data) : this.early.push(data));
    if (sampleRate !== FRAME_HZ) {
      this.fail("context", { sample_rate_hz: sampleRate });
      return;
    }
    WebAssembly.instantiate(module).then(
      ({ instance }) => this.begin(instance.exports, delay_s),
      (error) => this.fail("module", { text: String(error) }),
    );
  }

  /** Ends what cannot begin. */
  fail(about, more) {
    this.ended = true;
    this.port.onmessage = null;
    this.report(about, undefined, STATUS.indexOf(about), more);
  }

  begin(module, delay_s) {
    // The memory of the module never grows, so that its views stay valid.
    const { buffer } = module.memory;
    const ticks = Math.floor(module.frames_capacity() / 3) + 1;
    this.asset = new Uint8Array(buffer, module.buffer_asset(), module.asset_capacity());
    this.events = new Float64Array(buffer, module.buffer_events(), EVENT_NUMBERS * module.events_capacity());
    this.frames = new Float32Array(buffer, module.buffer_frames(), module.frames_capacity());
    this.positions_mm = new Float32Array(buffer, module.buffer_positions(), 3 * ticks);
    this.columns = new Float32Array(buffer, module.buffer_columns(), 9 * ticks);
    this.flags = new Uint32Array(buffer, module.buffer_flags(), ticks);
    this.module = module;
    const status = delay_s === undefined ? OK : module.set_delay(delay_s);
    this.report("module", undefined, status, { latency_s: module.latency_s() });
    this.early.splice(0).forEach((message) => this.take(message));
  }

  take(message) {
    switch (message.type) {
      case "load":
        return this.load(message);
      case "swap":
        return this.swap(message);
      case "hand":
        if (this.walk.on) this.port.postMessage({ type: "path", phase: null });
        this.walk.leave();
        return this.hand(message.events);
      case "path":
        if (!message.path) return this.hand(Float64Array.from(this.walk.lift(currentTime)));
        return this.walk.follow(message.path, message.t_s, currentTime);
      case "record":
        this.recorder.on = message.on;
        return this.recorder.flush();
      case "end":
        this.ended = true;
    }
  }

  load({ asset, seed = 0, id }) {
    const bits = BigInt.asUintN(64, BigInt(seed));
    const status = this.module.load(this.write(asset), Number(bits >> 32n), Number(bits & 0xffffffffn));
    if (status === OK) {
      this.replace(...this.sent.splice(0));
      this.recorder.flush();
      this.session++;
      this.tick = 0;
    }
    this.answer("load", id, status);
  }

  swap(message) {
    this.replace();
    const status = this.module.swap(this.write(message.asset));
    if (status === OK) this.sent.push(message);
    else if (status === BUSY) this.waiting = message;
    else this.answer("swap", message.id, status);
  }

  /** Gives up the swap that waits, and others: something later is wanted. */
  replace(...others) {
    const { waiting } = this;
    this.waiting = null;
    for (const swap of waiting ? [...others, waiting] : others) {
      this.report("swap", swap.id, STATUS.indexOf("replaced"));
    }
  }

  /** Copies what fits of an asset; the runtime needs no preview. Returns the bytes. */
  write(asset) {
    const bytes = new Uint8Array(asset).subarray(0, this.asset.length);
    this.asset.set(bytes);
    return bytes.length;
  }

  hand(events) {
    // More than the module takes at once come after a page that was busy for long.
    for (let from = 0; from < events.length; from += this.events.length) {
      const some = events.subarray(from, from + this.events.length);
      this.events.set(some);
      const status = this.module.post(Math.floor(some.length / EVENT_NUMBERS), currentTime);
      if (status !== OK) this.report("hand", undefined, status);
    }
  }

  /** Moves the hand on its path by some frames. */
  step(frames) {
    const stiffness_n_m = this.module.stiffness_n_m();
    if (!this.walk.on || !(stiffness_n_m > 0)) return;
    this.hand(Float64Array.from(this.walk.advance(currentTime, frames / FRAME_HZ, stiffness_n_m)));
    this.unsaid += frames;
    if (this.unsaid < PATH_FRAMES) return;
    this.unsaid = 0;
    this.port.postMessage({ type: "path", phase: this.walk.phase });
  }

  answer(about, id, status) {
    const { module, session, tick } = this;
    if (status === RATE) return this.report(about, id, status, { model_rate_hz: module.refused_rate_hz() });
    if (status !== OK) return this.report(about, id, status);
    this.report(about, id, status, { session, tick, stiffness_n_m: module.stiffness_n_m(),
      effective_mass_kg: module.effective_mass_kg(), model_rate_hz: module.model_rate_hz() });
  }

  report(about, id, status, more) {
    this.port.postMessage({ type: "status", about, id, status, name: STATUS[status], ...more });
  }

  process(_inputs, [[first, ...others]]) {
    if (this.ended) {
      this.recorder.flush();
      return false;
    }
    // A buffer of the browser begins silent.
    if (!this.module) return true;
    if (this.waiting) this.retry();
    this.step(first.length);
    const swaps = this.module.swaps();
    for (let from = 0; from < first.length; from += this.frames.length) {
      const count = Math.min(this.frames.length, first.length - from);
      const ticks = this.module.process(count, currentTime + from / FRAME_HZ);
      first.set(this.frames.subarray(0, count), from);
      if (this.recorder.on) {
        this.recorder.add(this.session, this.tick, ticks, this.positions_mm, this.columns, this.flags);
      }
      this.tick += ticks;
    }
    for (let count = this.module.swaps() - swaps; count > 0; count--) {
      this.answer("swap", this.sent.shift()?.id, OK);
    }
    for (const other of others) other.set(first);
    return true;
  }

  retry() {
    const message = this.waiting;
    this.waiting = null;
    this.swap(message);
  }
}

registerProcessor("asperity", AsperityProcessor);
