// The nodes from the renderer to the device, alike in a page's context and in one that renders offline:
//
//   renderer → input → trim → stages of the mode → drive → equaliser → limiter → volume → meter → device
//                                            tones ↗
//
// A level above 0 dB drives the limiter, one below turns down what leaves it. So no output exceeds the level, whatever
// texture, mode, equaliser or tone do.

import { Equaliser } from "./equaliser.js";
import { CHANNELS, MODES, stagesOf } from "./modes.js";

const fromDb = (db) => 10 ** (db / 20);

/** Acceleration of full scale at a level of 0 dB, m/s²: nearly twice the usual peaks of taps, 22 m/s². */
export const FULL_SCALE_M_S2 = 40;
/** What the limiter lets through, −1 dB of full scale. */
const CEILING = fromDb(-1);
/** Time constant of every change of the level, s. */
export const FADE_S = 0.03;
/** Between what a gamepad's weak and its strong motor play, Hz. */
const CROSSOVER_HZ = 100;

/** Modules of its worklets, relative to the page. */
export const MODULES = ["worklet.js", "limiter.js", "output/shift.js"];

export class Chain {
  #samples;
  #renders;
  #stages = {};
  #mode;
  #bands;

  /** `module` has the bytes of `asperity.wasm`. It begins silent. */
  constructor(context, module, mode = "plain") {
    this.context = context;
    this.renderer = new AudioWorkletNode(context, "asperity",
      { numberOfInputs: 0, outputChannelCount: [1], processorOptions: { module } });
    this.input = new GainNode(context);
    this.loudness = new GainNode(context);
    this.renderer.connect(this.input).connect(this.loudness);
    this.drive = new GainNode(context, { gain: 1 / FULL_SCALE_M_S2 });
    this.volume = new GainNode(context, { gain: 0 });
    this.equaliser = new Equaliser(context);
    this.limiter = new AudioWorkletNode(context, "limiter", { outputChannelCount: [1], processorOptions: { ceiling: CEILING } });
    this.meter = new AnalyserNode(context, { fftSize: 2048 });
    this.#samples = new Float32Array(this.meter.fftSize);
    /** One a channel, where a mode names channels. */
    this.gates = Array.from({ length: CHANNELS }, () => new GainNode(context, { gain: 0 }));
    this.merger = new ChannelMergerNode(context, { numberOfInputs: CHANNELS });
    this.gates.forEach((gate, n) => gate.connect(this.merger, 0, n));
    this.#bands = ["lowpass", "highpass"].map((/** @type {BiquadFilterType} */ type) => {
      const meter = new AnalyserNode(context, { fftSize: 2048 });
      this.input.connect(new BiquadFilterNode(context, { type, frequency: CROSSOVER_HZ, Q: -3 })).connect(meter);
      return meter;
    });
    for (const name of Object.keys(MODES)) this.#stages[name] = stagesOf(name, context);
    for (const stages of Object.values(this.#stages)) stages.slice(1).forEach((node, n) => stages[n].connect(node));
    this.renders = true;
    this.equaliser.output.connect(this.limiter).connect(this.volume).connect(this.meter);
    this.mode = mode;
  }

  get worklets() {
    const all = [this.renderer, this.limiter, ...Object.values(this.#stages).flat()];
    return all.filter((node) => node instanceof AudioWorkletNode);
  }

  get mode() {
    return this.#mode;
  }

  /** Not while anything is heard: what filters keep would click. */
  set mode(name) {
    if (this.#mode) {
      const { first, last } = this.#ends();
      this.loudness.disconnect(first);
      last?.disconnect();
    }
    this.#mode = name;
    const { first, last } = this.#ends();
    this.loudness.connect(first);
    last?.connect(this.drive);
    this.route();
  }

  /** Whether the device has the channels that the mode needs. */
  get fits() {
    return !MODES[this.#mode].channels || this.context.destination.maxChannelCount >= CHANNELS;
  }

  /** Connects the device, again where it is another one. */
  route() {
    const { destination } = this.context;
    const { channels } = MODES[this.#mode];
    this.meter.disconnect();
    this.merger.disconnect();
    if (!this.fits) return;
    if (!channels) {
      Object.assign(destination, { channelCount: Math.min(2, destination.maxChannelCount), channelInterpretation: "speakers" });
      this.meter.connect(destination);
      return;
    }
    Object.assign(destination, { channelCount: CHANNELS, channelInterpretation: "discrete" });
    for (const gate of this.gates) this.meter.connect(gate);
    this.merger.connect(destination);
    this.open(channels, this.context.currentTime);
  }

  /** Lets some of the channels alone play from a time on. */
  open(channels, at_s) {
    this.gates.forEach(({ gain }, n) => gain.setTargetAtTime(channels.includes(n) ? 1 : 0, at_s, FADE_S / 10));
  }

  /** Turns what the renderer gives up or down for ears: at once, or after some seconds. */
  trim(trim_db, after_s = 0) {
    const { gain } = this.loudness;
    const at_s = this.context.currentTime + after_s;
    gain.cancelScheduledValues(at_s);
    gain.setTargetAtTime(fromDb(trim_db), at_s, after_s > 0 ? FADE_S : FADE_S / 10);
  }

  /** Fades to a level, or to silence where `on` is 0. */
  turn(level_db, on, fade_s = FADE_S) {
    const now_s = this.context.currentTime;
    const volume = on && this.fits ? fromDb(Math.min(level_db, 0)) : 0;
    this.drive.gain.setTargetAtTime(fromDb(Math.max(level_db, 0)) / FULL_SCALE_M_S2, now_s, fade_s);
    this.volume.gain.setTargetAtTime(volume, now_s, fade_s);
  }

  /** Whether what is rendered is heard; test tones are heard alone. */
  get renders() {
    return this.#renders;
  }

  set renders(on) {
    this.#renders = on;
    if (on) this.drive.connect(this.equaliser.input);
    else this.drive.disconnect();
  }

  /** Peak and RMS of the last 40 ms of the output, in full scales. */
  measure() {
    return this.#measured(this.meter);
  }

  /** RMS of the acceleration rendered in the last 40 ms, m/s²: below and above the crossover. */
  felt() {
    return this.#bands.map((meter) => this.#measured(meter).rms);
  }

  #measured(meter) {
    meter.getFloatTimeDomainData(this.#samples);
    let [peak, sum] = [0, 0];
    for (const x of this.#samples) {
      peak = Math.max(peak, Math.abs(x));
      sum += x * x;
    }
    return { peak, rms: Math.sqrt(sum / this.#samples.length) };
  }

  /** Where the renderer goes, and what then goes to the drive. */
  #ends() {
    const stages = this.#stages[this.#mode];
    return { first: stages[0] ?? this.drive, last: stages.at(-1) };
  }
}

/** Builds a chain whose modules a context does not have yet. */
export async function buildChain(context, module, mode) {
  await Promise.all(MODULES.map((name) => context.audioWorklet.addModule(new URL(name, document.baseURI))));
  return new Chain(context, await module, mode);
}
