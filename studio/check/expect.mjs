// What checks of the studio's modules share: they end at the first claim that does not hold.

export function fail(text) {
  console.error(text);
  process.exit(1);
}

/** Fails unless `found` is within `tolerance` of `wanted`; NaN is within nothing. */
export function near(what, found, wanted, tolerance) {
  if (!(Math.abs(found - wanted) <= tolerance)) fail(`${what}: ${found}, not ${wanted} ± ${tolerance}`);
  return Math.abs(found - wanted);
}

export function same(what, found, wanted) {
  if (!Object.is(found, wanted)) fail(`${what}: ${found}, not ${wanted}`);
}

/** Numbers from 0 to 1 that are the same in every run (mulberry32). */
export function numbers(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}
