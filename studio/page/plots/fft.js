// Power density of a real signal: Hann window, radix-2 Fourier transform.

/** Transforms of one length, a power of two; n real samples as n/2 complex ones. */
export class Fft {
  constructor(size) {
    if (size < 4 || (size & (size - 1)) !== 0) throw new RangeError(`${size} is not a power of two from 4 on`);
    this.size = size;
    const half = size / 2;
    this.re = new Float64Array(half);
    this.im = new Float64Array(half);
    const angle = (2 * Math.PI) / size;
    this.cos = Float64Array.from({ length: half + 1 }, (_, n) => Math.cos(angle * n));
    this.sin = Float64Array.from({ length: half + 1 }, (_, n) => Math.sin(angle * n));
    this.window = Float64Array.from({ length: size }, (_, n) => 0.5 - 0.5 * Math.cos(angle * n));
    this.window_power = this.window.reduce((sum, w) => sum + w * w, 0);
    const bits = Math.log2(half);
    this.reversed = Uint32Array.from({ length: half }, (_, n) => {
      let place = 0;
      for (let bit = 0; bit < bits; bit++) place |= ((n >> bit) & 1) << (bits - 1 - bit);
      return place;
    });
  }

  /** |X_k|² for k = 0..=size/2 of `signal`, times the window if `windowed`, into `powers`. */
  powers(signal, windowed, powers = new Float64Array(this.size / 2 + 1)) {
    const { re, im, cos, sin, window, reversed } = this;
    const half = this.size / 2;
    for (let n = 0; n < half; n++) {
      const place = reversed[n];
      re[place] = signal[2 * n] * (windowed ? window[2 * n] : 1);
      im[place] = signal[2 * n + 1] * (windowed ? window[2 * n + 1] : 1);
    }
    this.#butterflies(half);
    // The even and the odd samples apart, which the symmetry of real signals allows.
    for (let k = 0; k <= half; k++) {
      const [a, b] = [k % half, (half - k) % half];
      const [even_re, even_im] = [0.5 * (re[a] + re[b]), 0.5 * (im[a] - im[b])];
      const [odd_re, odd_im] = [0.5 * (im[a] + im[b]), 0.5 * (re[b] - re[a])];
      const x = even_re + cos[k] * odd_re + sin[k] * odd_im;
      const y = even_im + cos[k] * odd_im - sin[k] * odd_re;
      powers[k] = x * x + y * y;
    }
    return powers;
  }

  #butterflies(half) {
    const { re, im, cos, sin } = this;
    for (let span = 1; span < half; span *= 2) {
      const step = half / span;
      for (let k = 0; k < span; k++) {
        const [c, s] = [cos[k * step], -sin[k * step]];
        for (let n = k; n < half; n += 2 * span) {
          const m = n + span;
          const x = c * re[m] - s * im[m];
          const y = c * im[m] + s * re[m];
          re[m] = re[n] - x;
          im[m] = im[n] - y;
          re[n] += x;
          im[n] += y;
        }
      }
    }
  }

  /** One-sided power density of `signal` at k·rate/size, in its unit squared per Hz. */
  density(signal, rate_hz, powers) {
    const density = this.powers(signal, true, powers);
    const scale = 2 / (rate_hz * this.window_power);
    for (let k = 0; k < density.length; k++) density[k] *= scale;
    density[0] *= 0.5;
    density[density.length - 1] *= 0.5;
    return density;
  }
}
