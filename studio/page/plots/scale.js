// Scales of axes: round steps, and ranges that follow a signal without restlessness.

/** Steps of axes, and their ends, which may be finer. */
const STEPS = [1, 2, 5, 10];
const ENDS = [1, 1.5, 2, 3, 4, 5, 6, 8, 10];

/** The round number at or above `x`: one of `steps` times a power of ten. */
export function roundUp(x, steps = STEPS) {
  const exponent = Math.floor(Math.log10(x));
  // A hair less, so that 0.3/0.1 is no more than 3.
  const step = steps.find((step) => step * 10 ** exponent >= x * (1 - 1e-9));
  // Dividing by a power gives the decimal number exactly as it is written.
  return exponent < 0 ? step / 10 ** -exponent : step * 10 ** exponent;
}

/** Round numbers from `low` to `high`, at most `count` of them. */
export function roundSteps(low, high, count) {
  const step = roundUp((high - low) / Math.max(count, 1));
  const steps = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; n++) steps.push(n * step);
  return { step, steps };
}

/** Decimals that a step needs. */
export const decimalsOf = (step) => Math.max(0, -Math.floor(Math.log10(step) + 1e-9));

/** 1, 2 and 5 times powers of ten from `low` to `high`. */
export function logSteps(low, high) {
  const steps = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
    for (const step of [1, 2, 5]) {
      const x = step * 10 ** power;
      if (x >= low * (1 - 1e-9) && x <= high * (1 + 1e-9)) steps.push(x);
    }
  }
  return steps;
}

/** A linear scale from values to pixels. */
export const linear = (low, high, from, to) => (x) => from + ((x - low) / (high - low)) * (to - from);

/** A logarithmic scale from values to pixels. */
export function logarithmic(low, high, from, to) {
  const scale = linear(Math.log(low), Math.log(high), from, to);
  return (x) => scale(Math.log(x));
}

/** Room for a positive number: the round number above it. */
const roomFor = (x) => (x > 0 ? roundUp(1.05 * x, ENDS) : 0);

/** The end of an axis: grows at once to hold what is shown, shrinks once it was too large for long. */
export class Span {
  least; round; patience_s; end; needed; since_s;
  /** `round` gives the end that holds a number. */
  constructor(least, round = roomFor, patience_s = 3) {
    Object.assign(this, { least, round, patience_s, end: least, needed: least });
  }

  /** The end at `now_s` that holds `x`. */
  follow(x, now_s) {
    const wanted = Number.isFinite(x) ? Math.max(this.least, this.round(x)) : this.least;
    if (wanted >= this.end) {
      [this.end, this.needed, this.since_s] = [wanted, this.least, undefined];
    } else {
      this.since_s ??= now_s;
      this.needed = Math.max(this.needed, wanted);
      if (now_s - this.since_s > this.patience_s)
        [this.end, this.needed, this.since_s] = [this.needed, this.least, undefined];
    }
    return this.end;
  }
}
