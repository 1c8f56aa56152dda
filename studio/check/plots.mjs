// Checks what the live plots compute, most of it against the command:
//
//   node plots.mjs ASPERITY FOLDER TEXTURE.asp…
//
// FOLDER takes tables. Textures whose numerator is of LSFs, and rates other than 1 kHz, are welcome.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { renderedCsv, trajectoryCsv, RENDERED } from "../page/plots/csv.js";
import { Fft } from "../page/plots/fft.js";
import { Grid } from "../page/plots/grid.js";
import { Band, decibels, densities, FLOOR_HZ } from "../page/plots/level.js";
import { Levels } from "../page/plots/levels.js";
import { COLUMN, COLUMNS, Ring, WIDTH } from "../page/plots/ring.js";
import { fail, near, numbers, same } from "./expect.mjs";
import { checkFft, checkLsf, checkRing, checkScales, checkShortest } from "./plots-maths.mjs";

const TICK_HZ = 16000;
const [asperity, folder, ...textures] = process.argv.slice(2);
if (textures.length === 0) fail("node plots.mjs ASPERITY FOLDER TEXTURE.asp…");

const run = (...args) =>
  execFileSync(asperity, args, { encoding: "utf8", maxBuffer: 2 ** 30, stdio: ["ignore", "pipe", "inherit"] });

/** Every point of the grid's borders, edges and vertices has a convex mixture that is its own place. */
function checkLookup(name, grid) {
  const random = numbers(5);
  const { vertices, max_speed_mm_s, max_force_n } = grid;
  const expect = (speed, force, [wanted_speed, wanted_force] = [speed, force]) => {
    const { vertices: corners, weights } = grid.locate(speed, force);
    if (!weights.every((weight) => weight >= 0 && weight <= 1))
      fail(`${name}: weights ${weights} at ${speed}, ${force}`);
    near(`${name}: sum of weights`, weights[0] + weights[1] + weights[2], 1, 1e-12);
    const mixed = (axis) => corners.reduce((sum, vertex, n) => sum + weights[n] * vertices[vertex][axis], 0);
    // Vertices are 32-bit floats, and so is the corner of the grid.
    near(`${name}: speed at ${speed}, ${force}`, mixed("speed_mm_s"), wanted_speed, 1e-4 * max_speed_mm_s);
    near(`${name}: force at ${speed}, ${force}`, mixed("force_n"), wanted_force, 1e-4 * max_force_n);
    return { corners, weights };
  };
  vertices.forEach(({ speed_mm_s, force_n }, vertex) => {
    const { corners, weights } = expect(speed_mm_s, force_n);
    const own = corners.findIndex(
      (corner) => vertices[corner].speed_mm_s === speed_mm_s && vertices[corner].force_n === force_n,
    );
    near(`${name}: weight of vertex ${vertex} at itself`, weights[own], 1, 1e-6);
  });
  for (const triangle of grid.triangles) {
    triangle.forEach((from, n) => {
      const [a, b] = [vertices[from], vertices[triangle[(n + 1) % 3]]];
      for (const t of [0.5, random()])
        expect(a.speed_mm_s + t * (b.speed_mm_s - a.speed_mm_s), a.force_n + t * (b.force_n - a.force_n));
    });
  }
  for (let n = 0; n < 200; n++) {
    const [v, f] = [random() * max_speed_mm_s, random() * max_force_n];
    expect(v, f);
    // Beyond the border, the nearest point of it.
    expect(max_speed_mm_s * (1 + random()), f, [max_speed_mm_s, f]);
    expect(v, max_force_n * (1 + random()), [v, max_force_n]);
    expect(-v, f, [0, f]);
  }
  expect(Infinity, Infinity, [max_speed_mm_s, max_force_n]);
  expect(NaN, NaN, [0, 0]);
  for (const [speed, force, outside] of [
    [0, 0, false],
    [max_speed_mm_s, max_force_n, false],
    [1.001 * max_speed_mm_s, 0, true],
    [0, 1.001 * max_force_n, true],
    [NaN, 0, true],
  ]) {
    same(`${name}: outside at ${speed}, ${force}`, grid.isOutside(speed, force), outside);
  }
}

/** Level above the floor of what the runtime renders in a steady stroke, and its spectrum against the model's. */
function checkRendered(name, texture, grid, stiffness_n_m, speed_mm_s, force_n) {
  const rate_hz = grid.rate_hz;
  const [begin, size] = [Math.round(rate_hz), 4096];
  const rows = begin + 128 * 1024;
  const input = join(folder, "steady.csv");
  const lines = ["t_s,x_mm,y_mm,z_mm"];
  for (let n = 0; n < rows; n++)
    lines.push(`${n / rate_hz},${(speed_mm_s * n) / rate_hz},0,${(-1000 * force_n) / stiffness_n_m}`);
  writeFileSync(input, lines.join("\n"));
  const table = run("render", texture, "--trajectory", input, "-o", "-", "--seed", "7", "--quiet")
    .trimEnd()
    .split("\n")
    .slice(1);
  const vib = Float64Array.from(table, (line) => Number(line.split(",")[2 + COLUMN.vib_m_s2]));
  const fft = new Fft(size);
  const mean = new Float64Array(size / 2 + 1);
  let windows = 0;
  for (let at = begin; at + size <= rows; at += size / 2, windows++) {
    fft.density(vib.subarray(at, at + size), rate_hz).forEach((x, k) => (mean[k] += x));
  }
  const bin_hz = rate_hz / size;
  const from = Math.ceil(FLOOR_HZ / bin_hz);
  let power = 0;
  for (let k = from; k < mean.length; k++) power += (mean[k] / windows) * bin_hz;
  const at = grid.modelAt(speed_mm_s, force_n);
  const level = new Band(grid, true).level_db(at);
  const apart = near(`${name}: level rendered at ${speed_mm_s} mm/s, ${force_n} N`, decibels(power), level, 0.3);
  // Bands of 20 Hz, whose noise is small.
  let worst = 0;
  const width = Math.round(20 / bin_hz);
  for (let k = from; k + width < 0.48 * size; k += width) {
    const freqs = Array.from({ length: width }, (_, n) => (k + n) * bin_hz);
    const wanted = densities(grid, at, freqs).reduce((sum, x) => sum + x, 0);
    const found = mean.subarray(k, k + width).reduce((sum, x) => sum + x, 0) / windows;
    worst = Math.max(worst, near(`${name}: density at ${Math.round(k * bin_hz)} Hz`, decibels(found / wanted), 0, 1.2));
  }
  return [apart, worst];
}

/** What was rendered goes through the ring in messages and comes back as the bytes of the command. */
function checkTables(name, texture) {
  const random = numbers(6);
  const lines = ["t_s,x_mm,y_mm,z_mm"];
  const ticks = 8000;
  const positions_mm = new Float32Array(3 * ticks);
  for (let n = 0; n < ticks; n++) {
    const t = n / TICK_HZ;
    positions_mm.set([60 * Math.sin(9 * t) + 0.001 * random(), 5 * t, Math.max(1 - 60 * t, -2)], 3 * n);
    lines.push([t, ...positions_mm.subarray(3 * n, 3 * n + 3)].join(","));
  }
  const [input, output] = [join(folder, "moves.csv"), join(folder, "felt.csv")];
  writeFileSync(input, lines.join("\n") + "\n");
  const render = (trajectory, to) =>
    run("render", texture, "--rate", `${TICK_HZ}`, "--trajectory", trajectory, "-o", to, "--seed", "3", "--quiet");
  render(input, output);
  const wanted = readFileSync(output, "utf8");
  const [header, ...rows] = wanted
    .trimEnd()
    .split("\n")
    .map((line) => line.split(","));
  same(`${name}: header`, RENDERED, header.join());
  same(`${name}: columns`, COLUMNS.join(), header.slice(2, 11).join());
  const columns = Float32Array.from(
    rows.flatMap((row) => row.slice(2, 11)),
    Number,
  );
  const flags = Uint32Array.from(rows, (row) => Number(row[11]));
  const ring = new Ring(ticks);
  for (let from = 0; from < ticks; from += 1600) {
    const part = (array, width) => array.slice(width * from, width * (from + 1600));
    ring.add({
      session: 1,
      first: from,
      positions_mm: part(positions_mm, 3),
      columns: part(columns, WIDTH),
      flags: part(flags, 1),
    });
  }
  if (renderedCsv(ring, TICK_HZ) !== wanted) fail(`${name}: the table is not the command's`);
  if (!flags.some((flag) => flag & 2) || !columns.some((x) => x !== 0)) fail(`${name}: nothing was felt`);
  const [again, felt] = [join(folder, "again.csv"), join(folder, "felt-again.csv")];
  writeFileSync(again, trajectoryCsv(ring, TICK_HZ));
  render(again, felt);
  if (readFileSync(felt, "utf8") !== wanted) fail(`${name}: the trajectory saved renders otherwise`);
}

for (const check of [checkLsf, checkFft, checkScales, checkShortest, checkRing]) console.log(check());
for (const texture of textures) {
  const name = basename(texture);
  const inspect = JSON.parse(run("inspect", texture, "--json"));
  const grid = new Grid(inspect.ar);
  checkLookup(name, grid);
  const levels = new Levels(inspect.ar);
  const [speed, force] = [Math.min(100, grid.max_speed_mm_s), Math.min(1, grid.max_force_n)];
  const rough = near(`${name}: rough_db`, levels.level_db(100, 1), inspect.attributes.rough_db, 1e-6);
  const began = performance.now();
  levels.advance(Infinity, () => 0);
  const sampled_ms = performance.now() - began;
  // The picture, with its coarse sums, against the exact level at points of the lattice and between them.
  let coarse = 0;
  for (const [x, y, tolerance] of [
    [32, 24, 0.1],
    [64, 48, 0.1],
    [16, 40, 0.1],
    [20.5, 24.5, 0.5],
    [40.3, 11.7, 0.5],
    [60.5, 30.5, 0.5],
  ]) {
    const [column, row] = [x / (levels.columns - 1), y / (levels.rows - 1)];
    const rms = levels.between(column, row);
    const exact = levels.level_db(column * grid.max_speed_mm_s, row * grid.max_force_n);
    coarse = Math.max(coarse, near(`${name}: picture at ${x}, ${y}`, decibels(rms * rms), exact, tolerance));
  }
  if (!(levels.low_db < levels.high_db)) fail(`${name}: colours from ${levels.low_db} to ${levels.high_db} dB`);
  let [apart, worst] = [0, 0];
  for (const [v, f] of [
    [speed, force],
    [0.3 * grid.max_speed_mm_s, 0.6 * grid.max_force_n],
    [0.9 * grid.max_speed_mm_s, 0.2 * grid.max_force_n],
    [1.3 * grid.max_speed_mm_s, 0.5 * grid.max_force_n],
  ]) {
    const found = checkRendered(name, texture, grid, inspect.wall.stiffness_n_m, v, f);
    [apart, worst] = [Math.max(apart, found[0]), Math.max(worst, found[1])];
  }
  if (TICK_HZ % grid.rate_hz === 0) checkTables(name, texture);
  console.log(
    `${name}: rough_db within ${rough.toExponential(0)} dB, levels rendered within ${apart.toFixed(2)} dB ` +
      `(20 Hz bands ${worst.toFixed(2)} dB), picture within ${coarse.toFixed(3)} dB in ${sampled_ms.toFixed(0)} ms, tables to the byte`,
  );
}
