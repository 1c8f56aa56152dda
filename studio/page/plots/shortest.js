// The shortest text that reads back to the same 32-bit float, without an exponent, as `asperity
// render` prints it. JavaScript prints the shortest one for 64 bits, which has twice as many digits.

const DIGITS = 9;
const POWERS = Array.from({ length: 19 }, (_, n) => 10 ** n);

const number = new Float32Array(1);
const bits = new Uint32Array(number.buffer);
/** Half the distance to the next float towards zero and away from it, of a positive normal float. */
const halfStep = (exponent) => 2 ** (exponent - 127 - 24);

/** The text of a number that fits a 32-bit float. */
export function shortest(x) {
  if (x === 0) return Object.is(x, -0) ? "-0" : "0";
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "NaN" : x < 0 ? "-inf" : "inf";
  return x < 0 ? `-${ofPositive(-x)}` : ofPositive(x);
}

function ofPositive(x) {
  if (x < 2 ** 24 && Number.isInteger(x)) return String(x | 0);
  number[0] = x;
  const exponent = bits[0] >> 23;
  // Where powers of ten are exact, and the next float is as far in both directions.
  if (x < 1e-6 || x >= 1e6 || (bits[0] & 0x7fffff) === 0) return bySearch(x);
  let places = DIGITS - 1;
  for (let bound = 10; places > 2 && x >= bound; bound *= 10) places--;
  for (let bound = 1; x < bound; bound /= 10) places++;
  const scale = POWERS[places];
  const half = halfStep(exponent) * scale;
  const whole = x * scale;
  // Far above the rounding of doubles: a text so near to the middle of two floats is tried out.
  const doubt = 1e-12 * whole;
  for (let unit = POWERS[DIGITS - 1], drop = DIGITS - 1; ; unit /= 10, drop--) {
    const digits = Math.round(whole / unit);
    const away = Math.abs(digits * unit - whole);
    if (Math.abs(away - half) < doubt) return bySearch(x);
    if (away < half || drop === 0) return placed(String(digits | 0), places - drop);
  }
}

/** Digits with the point before the last `places` of them. */
function placed(digits, places) {
  let end = digits.length;
  if (places <= 0) return digits + "0".repeat(-places);
  // Rounding up may end in zeros.
  while (places > 0 && digits.charCodeAt(end - 1) === 48) {
    end--;
    places--;
  }
  const kept = digits.slice(0, end);
  if (places === 0) return kept;
  if (kept.length > places) return `${kept.slice(0, -places)}.${kept.slice(-places)}`;
  return `0.${"0".repeat(places - kept.length)}${kept}`;
}

function bySearch(x) {
  for (let digits = 1; ; digits++) {
    const text = x.toExponential(digits - 1);
    if (Math.fround(Number(text)) !== x) continue;
    const [mantissa, exponent] = text.split("e");
    const whole = mantissa.replace(".", "");
    return placed(whole, whole.length - 1 - Number(exponent));
  }
}
