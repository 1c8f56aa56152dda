// The picture of the level over the plane, and the bar that explains its colours.

import { signed } from "./axes.js";
import { viridis } from "./colormap.js";
import { decibels } from "./models.js";

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
