// The equaliser for an actuator: five bands between 20 and 500 Hz. Without gains it changes nothing.

/** @type {BiquadFilterOptions[]} */
export const BANDS = [
  { type: "lowshelf", frequency: 35 },
  { type: "peaking", frequency: 60, Q: 1 },
  { type: "peaking", frequency: 110, Q: 1 },
  { type: "peaking", frequency: 200, Q: 1 },
  { type: "highshelf", frequency: 350 },
];
/** Largest gain of a band, dB. */
export const MOST_DB = 12;
const FADE_S = 0.03;

export class Equaliser {
  #context;

  constructor(context) {
    this.#context = context;
    this.filters = BANDS.map((band) => new BiquadFilterNode(context, band));
    this.filters.slice(1).forEach((filter, n) => this.filters[n].connect(filter));
  }

  get input() {
    return this.filters[0];
  }

  get output() {
    return this.filters.at(-1);
  }

  set gains_db(gains_db) {
    const now_s = this.#context.currentTime;
    this.filters.forEach(({ gain }, n) => gain.setTargetAtTime(gains_db[n], now_s, FADE_S));
  }
}

/** The response of gains at frequencies, dB. Needs no sound device. */
export function responseOf(gains_db, frequencies_hz) {
  const context = new OfflineAudioContext(1, 1, 48000);
  const asked = Float32Array.from(frequencies_hz);
  const [sum, magnitudes, phases] = [0, 1, 2].map(() => new Float32Array(asked.length));
  BANDS.forEach((band, n) => {
    const filter = new BiquadFilterNode(context, { ...band, gain: gains_db[n] });
    filter.getFrequencyResponse(asked, magnitudes, phases);
    magnitudes.forEach((magnitude, k) => (sum[k] += 20 * Math.log10(magnitude)));
  });
  return sum;
}
