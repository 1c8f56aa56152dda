// Line spectral frequencies to the power response of their polynomial.
//
// A(z) = (P + Q)/2, where the zeros of the sum polynomial Q and the difference polynomial P lie on
// the unit circle in turn, the first on Q. At z = e^(iω), Q and P are perpendicular, so that
//
//   |A|² = (|Q|² + |P|²)/4,  each a product of 4·(cos ω − cos ω_k)² over its zeros,
//
// times 4·cos²(ω/2) for Q and 4·sin²(ω/2) for P of an even order, or 4·sin²ω for P of an odd one.
// Coefficients, which would lose digits, are not needed.

/** The cosines of frequencies in radians, which is what the runtime mixes. */
export const cosines = (lsf_rad) => Float64Array.from(lsf_rad, Math.cos);

/** |A|² at angles whose cosines are `cs`; `result` takes it. */
export function squaredMagnitudes(line_cosines, cs, result = new Float64Array(cs.length)) {
  const order = line_cosines.length;
  const even = order % 2 === 0;
  for (let n = 0; n < cs.length; n++) {
    const c = cs[n];
    // Plain loops of one frequency: nothing is allocated, and the products stay in registers.
    let q = even ? 2 * (1 + c) : 1;
    let p = even ? 2 * (1 - c) : 4 * (1 - c * c);
    for (let k = 0; k < order; k += 2) {
      const away = c - line_cosines[k];
      q *= 4 * away * away;
    }
    for (let k = 1; k < order; k += 2) {
      const away = c - line_cosines[k];
      p *= 4 * away * away;
    }
    result[n] = 0.25 * (q + p);
  }
  return result;
}
