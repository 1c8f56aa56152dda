// Checks what the live plots compute, most of it against the command:
//
//   node plots.mjs ASPERITY FOLDER MODULE.wasm TEXTURE.asp…
//
// FOLDER takes tables, MODULE.wasm is what the page asks for its models. Textures whose numerator is of LSFs, and rates other
// than 1 kHz, are welcome.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { renderedCsv, trajectoryCsv, RENDERED } from "../page/plots/csv.js";
import { Fft } from "../page/plots/fft.js";
import { decibels, FLOOR_HZ, Models } from "../page/plots/models.js";
import { COLUMN, COLUMNS, Ring, WIDTH } from "../page/plots/ring.js";
import { fail, near, numbers, same } from "./expect.mjs";
import { checkFft, checkRing, checkScales } from "./plots-maths.mjs";

const TICK_HZ = 16000;
const [asperity, folder, module, ...textures] = process.argv.slice(2);
if (textures.length === 0) fail("node plots.mjs ASPERITY FOLDER MODULE.wasm TEXTURE.asp…");
const runtime = (await WebAssembly.instantiate(readFileSync(module))).instance.exports;

const run = (...args) =>
  execFileSync(asperity, args, { encoding: "utf8", maxBuffer: 2 ** 30, stdio: ["ignore", "pipe", "inherit"] });

/** Level above the floor of what the runtime renders in a steady stroke, and its spectrum against the model's. */
function checkRendered(name, texture, models, stiffness_n_m, at) {
  const { rate_hz } = models;
  const { speed_mm_s, force_n } = at;
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
  const level = models.level_db(at);
  const apart = near(`${name}: level rendered at ${speed_mm_s} mm/s, ${force_n} N`, decibels(power), level, 0.3);
  // Bands of 20 Hz, whose noise is small.
  let worst = 0;
  const width = Math.round(20 / bin_hz);
  for (let k = from; k + width < 0.48 * size; k += width) {
    const freqs = Array.from({ length: width }, (_, n) => (k + n) * bin_hz);
    const wanted = models.densities(at, freqs).reduce((sum, x) => sum + x, 0);
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
  if (renderedCsv(ring, TICK_HZ, runtime) !== wanted) fail(`${name}: the table is not the command's`);
  if (!flags.some((flag) => flag & 2) || !columns.some((x) => x !== 0)) fail(`${name}: nothing was felt`);
  const [again, felt] = [join(folder, "again.csv"), join(folder, "felt-again.csv")];
  writeFileSync(again, trajectoryCsv(ring, TICK_HZ));
  render(again, felt);
  if (readFileSync(felt, "utf8") !== wanted) fail(`${name}: the trajectory saved renders otherwise`);
}

for (const check of [checkFft, checkScales, checkRing]) console.log(check());
for (const texture of textures) {
  const name = basename(texture);
  const inspect = JSON.parse(run("inspect", texture, "--json"));
  const began = performance.now();
  const models = new Models(runtime, readFileSync(texture), inspect.ar);
  const sampled_ms = performance.now() - began;
  const { max_speed_mm_s, max_force_n } = models;
  const place = (speed_share, force_share) => ({ speed_mm_s: speed_share * max_speed_mm_s, force_n: force_share * max_force_n });
  const rough = near(`${name}: rough_db`, models.level_db({ speed_mm_s: 100, force_n: 1 }), inspect.attributes.rough_db, 1e-3);
  // The picture, with its coarse sums, against the exact level at points of the lattice and between them.
  let coarse = 0;
  for (const [x, y, tolerance] of [[32, 24, 0.1], [64, 48, 0.1], [16, 40, 0.1], [20.5, 24.5, 0.5], [40.3, 11.7, 0.5], [60.5, 30.5, 0.5]]) {
    const [column, row] = [x / (models.columns - 1), y / (models.rows - 1)];
    const rms = models.between(column, row);
    const exact = models.level_db(place(column, row));
    coarse = Math.max(coarse, near(`${name}: picture at ${x}, ${y}`, decibels(rms * rms), exact, tolerance));
  }
  if (!(models.low_db < models.high_db)) fail(`${name}: colours from ${models.low_db} to ${models.high_db} dB`);
  let [apart, worst] = [0, 0];
  const usual = { speed_mm_s: Math.min(100, max_speed_mm_s), force_n: Math.min(1, max_force_n) };
  for (const at of [usual, place(0.3, 0.6), place(0.9, 0.2), place(1.3, 0.5)]) {
    const found = checkRendered(name, texture, models, inspect.wall.stiffness_n_m, at);
    [apart, worst] = [Math.max(apart, found[0]), Math.max(worst, found[1])];
  }
  if (TICK_HZ % models.rate_hz === 0) checkTables(name, texture);
  console.log(
    `${name}: rough_db within ${rough.toExponential(0)} dB, levels rendered within ${apart.toFixed(2)} dB ` +
      `(20 Hz bands ${worst.toFixed(2)} dB), picture within ${coarse.toFixed(3)} dB in ${sampled_ms.toFixed(0)} ms, tables to the byte`,
  );
}
