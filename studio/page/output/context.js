// The browser's sound at the rate of the renderer, and why there may be none.

const RATE_HZ = 48000;

/** Why the sound does not start or has stopped. */
export class SoundFailure extends Error {
  /** `kind`: "no_worklet", "wrong_rate", "no_device" or "failed". */
  constructor(kind, detail) {
    super(kind);
    Object.assign(this, { kind, detail });
  }
}

/** An AudioContext, which `opened` hears of before it is known to be fit; else a `SoundFailure`. */
export function openContext(opened) {
  if (!globalThis.AudioContext || !globalThis.AudioWorkletNode) throw new SoundFailure("no_worklet");
  const context = new AudioContext({ sampleRate: RATE_HZ, latencyHint: "interactive" });
  opened(context);
  if (context.sampleRate !== RATE_HZ) throw new SoundFailure("wrong_rate", context.sampleRate);
  return context;
}
