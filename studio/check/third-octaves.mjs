// Two sounds compared by their spectra.

/** Mean power in third octaves from 25 Hz to 450 Hz of windows of 256 ms. */
function thirdOctaves({ signal, rate_hz }) {
  const size = Math.round(0.256 * rate_hz);
  const [cos, window] = [new Float64Array(size), new Float64Array(size)];
  for (let n = 0; n < size; n++) {
    cos[n] = Math.cos((2 * Math.PI * n) / size);
    window[n] = 0.5 - 0.5 * cos[n];
  }
  const powers = new Map();
  for (let at = 0; at + size <= signal.length; at += size / 2) {
    for (let bin = 6; (bin * rate_hz) / size < 450; bin++) {
      let [re, im] = [0, 0];
      for (let n = 0; n < size; n++) {
        const sample = window[n] * signal[at + n];
        re += sample * cos[(n * bin) % size];
        im += sample * cos[(n * bin + 0.75 * size) % size];
      }
      const band = Math.round(3 * Math.log2((bin * rate_hz) / size / 1000));
      powers.set(band, (powers.get(band) ?? 0) + re * re + im * im);
    }
  }
  return new Map([...powers].map(([band, power]) => [band, 10 * Math.log10(power / size ** 2)]));
}

/** The largest difference of two sounds in a third octave from 25 Hz to 450 Hz, dB; they begin together. */
export function apart_db(wanted, heard) {
  const [those, these] = [thirdOctaves(wanted), thirdOctaves(heard)];
  if (those.size < 13) throw new Error(`${those.size} third octaves`);
  return Math.max(...[...those].map(([band, level_db]) => Math.abs(these.get(band) - level_db)));
}
