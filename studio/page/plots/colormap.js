// Viridis (van der Walt and Smith, CC0): perceptually uniform, readable by the colour-blind.

const STOPS = [
  0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b, 0x22a884, 0x35b779,
  0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725,
].map((rgb) => [rgb >> 16, (rgb >> 8) & 255, rgb & 255]);

/** Red, green and blue, 0..=255, for 0..=1; beyond, those of the end. */
export function viridis(t) {
  const place = Math.min(Math.max(t, 0), 1) * (STOPS.length - 1);
  const n = Math.min(Math.floor(place), STOPS.length - 2);
  return [0, 1, 2].map((k) => Math.round(STOPS[n][k] + (place - n) * (STOPS[n + 1][k] - STOPS[n][k])));
}
