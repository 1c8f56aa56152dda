// Axes with units: the frame of a figure, and the scales into it.

import { decimalsOf, linear, logarithmic, logSteps, roundSteps } from "./scale.js";

const ROW_PX = 18;
const GAP_PX = 6;
/** Room for one number on an axis. */
const ACROSS_PX = 48;
const DOWN_PX = 30;

/** Marks of an axis over so many pixels, with their texts. */
function marksOf({ low, high, log, every, ends }, pixels, room) {
  if (ends) return [...new Set([low, 0, high])].map((value) => ({ value, text: value === 0 && low < 0 ? "" : `${value}`.replace("-", "−") }));
  const most = Math.max(3, Math.floor(pixels / room));
  if (log) {
    let steps = logSteps(low, high);
    if (steps.length > 1.5 * most) steps = steps.filter((x) => /^1/.test(x.toExponential()));
    return steps.map((value) => ({ value, text: value >= 1000 ? `${value / 1000}k` : `${value}` }));
  }
  let { step, steps } = roundSteps(low, high, most);
  if (every && step < every) ({ step, steps } = { step: every, steps: multiples(low, high, every) });
  const decimals = decimalsOf(step);
  return steps.map((value) => ({ value, text: signed(value, decimals) }));
}

/** An axis of another length around the same middle. */
function widened(axis, length) {
  const middle = (axis.low + axis.high) / 2;
  return { ...axis, low: middle - length / 2, high: middle + length / 2 };
}

function multiples(low, high, every) {
  const steps = [];
  for (let n = Math.ceil(low / every); n * every <= high; n++) steps.push(n * every);
  return steps;
}

/** A number with a true minus sign, and none before zero. */
export function signed(value, decimals) {
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? `−${text}` : text;
}

/**
 * Draws two axes into `area` (default: the whole figure) and returns { box, x, y }: where the data goes, and its scales.
 * An axis is { low, high, title, log?, every?, ends?, bare? }; the title of y stands above it. One with `ends` has numbers
 * there alone, a `bare` x has none. With `equal`, a unit is as long on both,
 * and one of the axes shows more than was asked for.
 */
export function axes(ctx, figure, x, y, { area = undefined, left = undefined, right = GAP_PX + 4, grid = true, frame = true, equal = false } = {}) {
  const { palette } = figure.stage;
  const within = area ?? { left: 0, top: 0, right: figure.width, bottom: figure.height };
  const top = within.top + (y.title ? ROW_PX : GAP_PX);
  const bottom = within.bottom - (x.bare ? 4 : ROW_PX) - (x.title ? ROW_PX : 0);
  const widest = () => Math.max(...marksOf(y, bottom - top, DOWN_PX).map(({ text }) => ctx.measureText(text).width));
  const box = { left: Math.ceil(within.left + (left ?? widest()) + GAP_PX + 2), top, right: within.right - right, bottom };
  if (equal) {
    const per_px = Math.max((x.high - x.low) / (box.right - box.left), (y.high - y.low) / (bottom - top));
    x = widened(x, per_px * (box.right - box.left));
    y = widened(y, per_px * (bottom - top));
  }
  const down = marksOf(y, bottom - top, DOWN_PX);
  const across = marksOf(x, box.right - box.left, ACROSS_PX);
  const scale = (axis, from, to) => (axis.log ? logarithmic : linear)(axis.low, axis.high, from, to);
  const placed = { box, x: scale(x, box.left, box.right), y: scale(y, box.bottom, box.top) };

  ctx.strokeStyle = palette.grid;
  ctx.fillStyle = palette.muted;
  ctx.beginPath();
  ctx.textAlign = "center";
  for (const { value, text } of across) {
    const at = Math.round(placed.x(value)) + 0.5;
    if (grid) {
      ctx.moveTo(at, box.top);
      ctx.lineTo(at, box.bottom);
    }
    if (x.bare) continue;
    const half = ctx.measureText(text).width / 2;
    ctx.fillText(text, Math.min(Math.max(at, within.left + half), within.right - half), box.bottom + ROW_PX / 2 + 1);
  }
  ctx.textAlign = "right";
  for (const { value, text } of down) {
    const at = Math.round(placed.y(value)) + 0.5;
    if (grid) {
      ctx.moveTo(box.left, at);
      ctx.lineTo(box.right, at);
    }
    // The number at the top keeps clear of the title.
    ctx.fillText(text, box.left - GAP_PX, Math.max(at, box.top + GAP_PX));
  }
  ctx.stroke();
  if (frame) {
    ctx.strokeStyle = palette.muted;
    const [width, height] = [box.right - box.left, box.bottom - box.top].map(Math.round);
    ctx.strokeRect(box.left + 0.5, Math.round(box.top) + 0.5, width - 1, height - 1);
  }
  ctx.fillStyle = palette.ink;
  if (x.title) {
    ctx.textAlign = "center";
    ctx.fillText(x.title, (box.left + box.right) / 2, box.bottom + 1.5 * ROW_PX + 1);
  }
  if (y.title) {
    ctx.textAlign = "left";
    ctx.fillText(y.title, within.left, within.top + ROW_PX / 2 - 1);
  }
  return placed;
}

/** Runs `draw` with everything outside `box` cut away. */
export function clipped(ctx, box, draw) {
  ctx.save();
  ctx.beginPath();
  ctx.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  ctx.clip();
  draw();
  ctx.restore();
}
