// What the live plots compute by themselves, against plainer ways to the same numbers.
import { Fft } from "../page/plots/fft.js";
import { contour } from "../page/plots/field.js";
import { coefficients } from "../page/plots/friction.js";
import { BLOCK, COLUMN, Ring, WIDTH } from "../page/plots/ring.js";
import { roundSteps, roundUp, Span } from "../page/plots/scale.js";
import { Playhead } from "../page/plots/scope.js";
import { fail, near, numbers, same } from "./expect.mjs";

const TICK_HZ = 16000;

export function checkFft() {
  const random = numbers(2);
  let worst = 0;
  for (const size of [4, 8, 64, 512]) {
    const fft = new Fft(size);
    const signal = Float64Array.from({ length: size }, () => random() - 0.5);
    const found = fft.powers(signal, false);
    const total = found.reduce((sum, x) => sum + x, 0);
    for (let k = 0; k <= size / 2; k++) {
      let [re, im] = [0, 0];
      for (let n = 0; n < size; n++) {
        re += signal[n] * Math.cos((2 * Math.PI * ((k * n) % size)) / size);
        im -= signal[n] * Math.sin((2 * Math.PI * ((k * n) % size)) / size);
      }
      worst = Math.max(worst, near(`bin ${k} of ${size}`, found[k] / total, (re * re + im * im) / total, 1e-14));
    }
  }
  // A density summed over all frequencies is the mean square: of a sine 1/2.
  const fft = new Fft(4096);
  const density = fft.density(
    Float64Array.from({ length: 4096 }, (_, n) => Math.sin(0.37 * n)),
    TICK_HZ,
  );
  const strongest = density.indexOf(Math.max(...density));
  near("the sine's bin", strongest, (0.37 * 4096) / (2 * Math.PI), 0.5);
  near("the sine's power", (density.reduce((sum, x) => sum + x, 0) * TICK_HZ) / 4096, 0.5, 1e-3);
  for (const size of [0, 2, 12, 100]) {
    let refused = false;
    try {
      new Fft(size);
    } catch {
      refused = true;
    }
    if (!refused) fail(`a transform of ${size}`);
  }
  return `transforms within ${worst.toExponential(0)} of the direct sum`;
}

export function checkScales() {
  for (const [x, wanted] of [
    [0.3, 0.5],
    [1, 1],
    [1.01, 2],
    [4.2, 5],
    [7, 10],
    [0.1 * 3, 0.5],
    [200, 200],
  ])
    near("roundUp", roundUp(x), wanted, 1e-9 * wanted);
  const { steps } = roundSteps(-0.25, 1, 5);
  // The first one may be a negative zero.
  same("steps", steps.map((x) => x + 0).join(), "0,0.5,1");
  const span = new Span(1);
  same("span at least", span.follow(0.1, 0), 1);
  same("span grows", span.follow(9, 1), 10);
  same("span waits", span.follow(1.5, 2), 10);
  same("span still waits", span.follow(0.1, 4.9), 10);
  same("span shrinks to what was needed meanwhile", span.follow(0.1, 5.1), 2);
  same("an end is a decimal number", new Span(0.01).follow(0.28, 0), 0.3);
  same("span of a number that is none", new Span(2).follow(NaN, 0), 2);
  // The circle x² + y² = 16 around a corner, and a saddle, whose two lines must not cross.
  const size = 9;
  const circle = Float64Array.from({ length: size * size }, (_, n) => (n % size) ** 2 + Math.floor(n / size) ** 2);
  const segments = contour(circle, size, 16);
  let length = 0;
  for (const [x0, y0, x1, y1] of segments) {
    near("contour", Math.hypot(x0, y0), 4, 0.08);
    near("contour", Math.hypot(x1, y1), 4, 0.08);
    length += Math.hypot(x1 - x0, y1 - y0);
  }
  near("length of the contour", length, 2 * Math.PI, 0.05);
  for (const [values, middle] of [
    [[1, 0, 0, 1], 0.9],
    [[1, 0, 0, 1], 0.2],
    [[0, 1, 1, 0], 0.2],
    [[0, 1, 1, 0], 0.9],
  ]) {
    for (const [x0, y0, x1, y1] of contour(values, 2, middle)) {
      // On either side of a segment's middle the bilinear surface is above and below.
      const at = (x, y) =>
        values[0] * (1 - x) * (1 - y) + values[1] * x * (1 - y) + values[2] * (1 - x) * y + values[3] * x * y;
      const [mx, my] = [(x0 + x1) / 2, (y0 + y1) / 2];
      const [nx, ny] = [0.02 * Math.sign(y1 - y0), -0.02 * Math.sign(x1 - x0)];
      near("middle of a saddle's line", at(mx, my), middle, 0.2);
      if (at(mx + nx, my + ny) < middle === at(mx - nx, my - ny) < middle && Math.abs(at(mx, my) - middle) < 0.01)
        fail("saddle");
    }
  }
  same("μ of a law", coefficients({ mu: 2, law: { points: [{ factor: 0.5 }, { factor: 1.5 }] } }).join(), "1,3");
  return "scales and contours";
}

/** A ring that wraps, messages of odd lengths, gaps and sessions, against plain arrays. */
export function checkRing() {
  const random = numbers(4);
  const ring = new Ring(1000);
  let kept = [];
  let [session, next] = [1, 70];
  for (let n = 0; n < 400; n++) {
    const count = Math.floor(random() * (n % 50 === 49 ? 3000 : 200));
    const gap = n % 97 === 96 ? 5 : 0;
    if (n % 131 === 130) session++;
    if (gap > 0 || n % 131 === 130) kept = [];
    next += gap;
    const columns = Float32Array.from({ length: WIDTH * count }, () => random() - 0.5);
    const message = {
      session,
      first: next,
      columns,
      positions_mm: Float32Array.from({ length: 3 * count }, random),
      flags: Uint32Array.from({ length: count }, (_, k) => k),
    };
    if (ring.add(message) !== (kept.length === 0) && n > 0 && count > 0) fail(`message ${n}: a run begins, or not`);
    for (let k = 0; k < count; k++)
      kept.push({
        tick: next + k,
        row: columns.subarray(WIDTH * k, WIDTH * (k + 1)),
        x: message.positions_mm[3 * k],
        flags: k,
      });
    next += count;
    same("end", ring.end, next);
    kept = kept.filter(({ tick }) => tick >= ring.first);
    same("ticks kept", kept.length, ring.end - ring.first);
    if (ring.end - ring.first > ring.capacity) fail("more than fits");
    for (const { tick, row, x, flags } of kept) {
      same("column", ring.at(tick, COLUMN.vib_m_s2), row[COLUMN.vib_m_s2]);
      same("position", ring.position(tick, 0), x);
      same("flags", ring.flagsAt(tick), flags);
    }
    for (let from = BLOCK * Math.ceil(ring.first / BLOCK); from + 2 * BLOCK <= ring.end; from += BLOCK) {
      const rows = kept.filter(({ tick }) => tick >= from && tick < from + 2 * BLOCK);
      for (const column of [0, WIDTH - 1]) {
        const values = rows.map(({ row }) => row[column]);
        const [low, high] = ring.extremes(column, from, from + 2 * BLOCK);
        same("least", low, Math.min(...values));
        same("greatest", high, Math.max(...values));
      }
    }
  }
  if (ring.end - ring.first < ring.capacity - 2 * BLOCK) fail("much less is kept than fits");

  // Messages of 0.1 s: the playhead never stands still or jumps, and ends at the last tick.
  const head = new Playhead(TICK_HZ);
  let [end, before, slowest, fastest] = [0, 0, Infinity, 0];
  for (let frame = 0; frame < 600; frame++) {
    const now_s = frame / 60;
    end = Math.floor(now_s * 10) * 1600;
    const tick = head.advance(now_s, 0, end);
    if (frame > 60) [slowest, fastest] = [Math.min(slowest, tick - before), Math.max(fastest, tick - before)];
    before = tick;
  }
  if (slowest < 0.6 * (TICK_HZ / 60) || fastest > 1.4 * (TICK_HZ / 60))
    fail(`the playhead moves ${slowest} to ${fastest} ticks a frame`);
  for (let frame = 600; frame < 660; frame++) before = head.advance(frame / 60, 0, end);
  same("the playhead's end", before, end);
  return "ring and playhead";
}
