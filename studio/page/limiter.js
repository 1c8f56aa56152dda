// The AudioWorkletProcessor `limiter`: no output exceeds the ceiling, and below it nothing changes but
// the time, by 47 frames.
//
// Each sample asks for the gain min(1, ceiling/|x|). The least of the last 48 gains falls at once and
// rises slowly; the mean of 48 such values is the gain of the oldest sample. All 48 were at most what
// that sample asked for, hence so is their mean.
//
// Message from the port: { reduction_db }, at most ten a second, while it limits.

const WINDOW = 48;
const RELEASE_S = 0.08;
const REPORT_FRAMES = 4800;
/** A gain this near to 1 is 1. */
const NEAR = 1e-5;

class Limiter extends AudioWorkletProcessor {
  constructor({ processorOptions: { ceiling } }) {
    super();
    this.ceiling = ceiling;
    this.release = 1 - Math.exp(-1 / (RELEASE_S * sampleRate));
    this.delayed = new Float32Array(WINDOW);
    this.asked = new Float64Array(WINDOW).fill(1);
    this.gains = new Float64Array(WINDOW).fill(1);
    this.sum = WINDOW;
    this.gain = 1;
    this.at = 0;
    this.least = 1;
    this.frames = 0;
  }

  frame(x) {
    const { asked, gains, delayed, at, ceiling } = this;
    const finite = Number.isFinite(x) ? x : 0;
    delayed[at] = finite;
    asked[at] = Math.abs(finite) > ceiling ? ceiling / Math.abs(finite) : 1;
    let least = 1;
    for (let n = 0; n < WINDOW; n++) least = Math.min(least, asked[n]);
    if (least < this.gain) this.gain = least;
    else if (least - this.gain < NEAR) this.gain = least;
    else this.gain += this.release * (least - this.gain);
    this.sum += this.gain - gains[at];
    gains[at] = this.gain;
    this.at = (at + 1) % WINDOW;
    this.least = Math.min(this.least, this.gain);
    // Rounding of the sum is far below that of a sample.
    return (delayed[this.at] * this.sum) / WINDOW;
  }

  process([[input]], [[output]]) {
    for (let n = 0; n < output.length; n++) output[n] = this.frame(input ? input[n] : 0);
    this.frames += output.length;
    if (this.frames >= REPORT_FRAMES) {
      if (this.least < 1) this.port.postMessage({ reduction_db: 20 * Math.log10(this.least) });
      this.least = 1;
      this.frames = 0;
    }
    return true;
  }
}

registerProcessor("limiter", Limiter);
