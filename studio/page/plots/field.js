// The picture of the level over the plane, its lines of equal level, and the bar that explains its colours.

import { signed } from "./axes.js";
import { decibels } from "./models.js";

// Viridis (van der Walt and Smith, CC0): perceptually uniform, readable by the colour-blind.
const STOPS = [
  0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b, 0x22a884, 0x35b779,
  0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725,
].map((rgb) => [rgb >> 16, (rgb >> 8) & 255, rgb & 255]);

/** Red, green and blue, 0..=255, for 0..=1; beyond, those of the end. */
function viridis(t) {
  const place = Math.min(Math.max(t, 0), 1) * (STOPS.length - 1);
  const n = Math.min(Math.floor(place), STOPS.length - 2);
  return [0, 1, 2].map((k) => Math.round(STOPS[n][k] + (place - n) * (STOPS[n + 1][k] - STOPS[n][k])));
}

/** Colours of a picture: more than the eye tells apart. */
const SHADES = 256;
const table = Uint32Array.from({ length: SHADES }, (_, n) => {
  const [r, g, b] = viridis(n / (SHADES - 1));
  const bytes = new Uint8Array([r, g, b, 255]);
  return new Uint32Array(bytes.buffer)[0];
});

/** A canvas with the levels in colours, the quiet corner at the bottom left. */
export function fieldPicture(models, width, height) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height];
  const ctx = canvas.getContext("2d");
  const picture = ctx.createImageData(width, height);
  const pixels = new Uint32Array(picture.data.buffer);
  const { low_db, high_db } = models;
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      const rms = models.between((column + 0.5) / width, 1 - (row + 0.5) / height);
      const share = (decibels(rms * rms) - low_db) / (high_db - low_db);
      pixels[row * width + column] = table[Math.round(Math.min(Math.max(share, 0), 1) * (SHADES - 1))];
    }
  }
  ctx.putImageData(picture, 0, 0);
  return canvas;
}

// Lines of equal value over a lattice (marching squares), in units of the lattice.
/** Segments [x0, y0, x1, y1] where `values`, in rows of `columns`, pass `level`. */
export function contour(values, columns, level) {
  const segments = [];
  const rows = values.length / columns;
  for (let y = 0; y + 1 < rows; y++) {
    for (let x = 0; x + 1 < columns; x++) {
      const at = y * columns + x;
      const corners = [values[at], values[at + 1], values[at + columns + 1], values[at + columns]];
      if (!corners.every(Number.isFinite)) continue;
      const crossings = [];
      for (let side = 0; side < 4; side++) {
        const [a, b] = [corners[side], corners[(side + 1) % 4]];
        if (a < level === b < level) continue;
        const t = (level - a) / (b - a);
        crossings.push([[x + t, y], [x + 1, y + t], [x + 1 - t, y + 1], [x, y + 1 - t]][side]);
      }
      if (crossings.length === 4) {
        // A saddle: the middle says which corners belong together.
        const middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
        if (middle < level !== corners[0] < level) crossings.push(crossings.shift());
      }
      for (let n = 0; n + 1 < crossings.length; n += 2) segments.push([...crossings[n], ...crossings[n + 1]]);
    }
  }
  return segments;
}

/** The colours with their levels, right of `box`. */
export function colourBar(ctx, palette, { low_db, high_db }, box, every_db) {
  const [left, width, height] = [box.right + 18, 10, box.bottom - box.top];
  const shades = ctx.createLinearGradient(0, box.bottom, 0, box.top);
  for (let n = 0; n <= 16; n++) shades.addColorStop(n / 16, `rgb(${viridis(n / 16).join(" ")})`);
  ctx.fillStyle = shades;
  ctx.fillRect(left, box.top, width, height);
  ctx.fillStyle = palette.muted;
  ctx.textAlign = "left";
  const fits = Math.max(1, Math.ceil((16 * (high_db - low_db)) / every_db / height));
  for (let db = low_db; db <= high_db; db += every_db * fits) {
    const at = box.bottom - ((db - low_db) / (high_db - low_db)) * height;
    ctx.fillRect(left + width, Math.round(at), 3, 1);
    // Below the lowest level, colours are all the same.
    const text = db === low_db ? `≤${signed(db, 0)}` : signed(db, 0);
    ctx.fillText(text, left + width + 5, Math.min(Math.max(at, box.top + 4), box.bottom - 4));
  }
}
