// The AudioWorkletProcessor `shift`: raises every component of a sound by the same number of hertz (single sideband).
// Envelopes stay as they are; ratios of frequencies do not.
//
// Two chains of all-passes of the first order give two copies a quarter of a period apart, 90° ± 0.3° from 15 Hz to 6 kHz;
// turned by the shift and added, their lower sidebands cancel, to −51 dB.

/** Corners of the all-passes, Hz: an elliptic design, sc((4n + 1) K / 10), at 48 kHz. */
const CORNERS_HZ = [
  [5.702456, 46.90132, 212.2719, 943.223, 4516.263],
  [20.40397, 100.5158, 447.0568, 2012.33, 12654.51],
];

class AllPasses {
  constructor(corners_hz) {
    this.gains = corners_hz.map((hz) => Math.tan((Math.PI * hz) / sampleRate)).map((t) => (t - 1) / (t + 1));
    this.states = new Float64Array(corners_hz.length);
  }

  frame(x) {
    const { gains, states } = this;
    for (let n = 0; n < gains.length; n++) {
      const y = gains[n] * x + states[n];
      states[n] = x - gains[n] * y;
      x = y;
    }
    return x;
  }
}

class Shift extends AudioWorkletProcessor {
  constructor({ processorOptions: { shift_hz } }) {
    super();
    this.copies = CORNERS_HZ.map((corners_hz) => new AllPasses(corners_hz));
    this.step = (2 * Math.PI * shift_hz) / sampleRate;
    this.phase = 0;
  }

  process([[input]], [[output]]) {
    if (!input) return true;
    const [real, imaginary] = this.copies;
    for (let n = 0; n < output.length; n++) {
      const x = Number.isFinite(input[n]) ? input[n] : 0;
      output[n] = real.frame(x) * Math.cos(this.phase) + imaginary.frame(x) * Math.sin(this.phase);
      this.phase = (this.phase + this.step) % (2 * Math.PI);
    }
    return true;
  }
}

registerProcessor("shift", Shift);
