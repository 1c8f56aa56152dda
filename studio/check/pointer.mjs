// The events of a pointer, as the page posts them to its renderer.

/** The page's clock where the audio clock is 0, s. */
export const PAGE_S = 1234.5;

/** A pointer: hover, tap, strokes of growing speed, lift, another stroke elsewhere, a loss, a jump. */
export function pointer() {
  const events = [];
  for (let n = 0, t = 0; t < 2.3; n++) {
    // 120 Hz, later 1000 Hz; the times jitter by some tenths of a millisecond.
    t += (t < 1.2 ? 1 / 120 : 0.001) * (1 + 0.03 * Math.sin(7 * n));
    if (t > 1.6 && t < 1.8) continue;
    const second = t > 1.3;
    const sweep = 30 * Math.sin(2 * Math.PI * (0.5 + t) * t);
    const x = second ? 200 + 80 * (t - 1.3) + (t > 2.1 ? 50 : 0) : sweep;
    const presses = (t > 0.2 && t < 1.1) || t > 1.35;
    const z = presses ? -1.2 - 0.8 * Math.sin(5 * t) : 1;
    events.push([PAGE_S + t, x, 10 * Math.cos(3 * t), z, second ? 2 : 1]);
  }
  return events;
}
