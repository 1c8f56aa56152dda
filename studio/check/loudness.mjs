// All textures of a library are equally loud in the page: node loudness.mjs ASPERITY FOLDER PROMPTS
//
// The level of what the command renders in the standard stroke, and what the page turns it by. PROMPTS has one a line.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { trimOf } from "../page/output/loudness.js";
import { Fft } from "../page/plots/fft.js";
import { fail } from "./expect.mjs";

/** The stroke that levels are stated for, and a time in which soft things have given way. */
const STROKE = { speed_mm_s: 100, force_n: 1, seconds: 30, rate_hz: 1000 };
const REST_S = 4;
const FLOOR_HZ = 40;
const MOST_APART_DB = 1.5;

const run = (asperity, ...args) => execFileSync(asperity, args, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });

/** A column of what a stroke at a depth renders. */
function rendered(asperity, texture, depth_mm, seconds, name) {
  const { speed_mm_s, rate_hz } = STROKE;
  const input = `${texture}.csv`;
  const rows = Array.from({ length: seconds * rate_hz }, (_, n) => `${n / rate_hz},${(speed_mm_s * n) / rate_hz},0,${-depth_mm}`);
  writeFileSync(input, `t_s,x_mm,y_mm,z_mm\n${rows.join("\n")}\n`);
  const [header, ...lines] = run(asperity, "render", texture, "--rate", `${rate_hz}`, "--trajectory", input, "-o", "-").trimEnd().split("\n");
  const column = header.split(",").indexOf(name);
  return Float64Array.from(lines, (line) => Number(line.split(",")[column]));
}

/** The depth that bears the stroke's force at last, mm, by the secant rule from that of the wall. */
function depthOf(asperity, texture, { wall, contact }) {
  let depth_mm = (1000 * STROKE.force_n) / wall.stiffness_n_m;
  if (!contact) return depth_mm;
  for (let n = 0; n < 8; n++) {
    const force_n = rendered(asperity, texture, depth_mm, REST_S, "normal_force_n").at(-1);
    if (Math.abs(force_n / STROKE.force_n - 1) < 0.02) break;
    depth_mm *= Math.min(Math.max((STROKE.force_n / force_n) ** 0.6, 0.3), 3);
  }
  return depth_mm;
}

/** Level above 40 Hz that the command renders for a texture's file in the standard stroke, dB re 1 m/s². */
export function levelOf(asperity, texture, inspect = JSON.parse(run(asperity, "inspect", texture, "--json"))) {
  const { seconds, rate_hz } = STROKE;
  const x = rendered(asperity, texture, depthOf(asperity, texture, inspect), seconds, "vib_m_s2").subarray(REST_S * rate_hz);
  const fft = new Fft(1024);
  let [power, windows] = [0, 0];
  for (let at = 0; at + fft.size <= x.length; at += fft.size / 2, windows++) {
    fft.density(x.subarray(at, at + fft.size), rate_hz).forEach((density, k) => {
      if ((k * rate_hz) / fft.size >= FLOOR_HZ) power += (density * rate_hz) / fft.size;
    });
  }
  return 10 * Math.log10(power / windows);
}

function check(asperity, folder, prompts) {
  const levels = readFileSync(prompts, "utf8").trim().split("\n").map((prompt, n) => {
    const texture = join(folder, `loudness-${n}.asp`);
    run(asperity, "compile", prompt, "-o", texture, "--no-preview", "--quiet");
    const inspect = JSON.parse(run(asperity, "inspect", texture, "--json"));
    const own_db = levelOf(asperity, texture, inspect);
    return { prompt, own_db, heard_db: own_db + trimOf({ inspect }) };
  });
  const sorted = levels.map(({ heard_db }) => heard_db).sort((a, b) => a - b);
  const middle_db = sorted[sorted.length >> 1];
  const far = levels.filter(({ heard_db }) => Math.abs(heard_db - middle_db) > MOST_APART_DB);
  const spread = (of) => Math.max(...of) - Math.min(...of);
  if (far.length) fail(far.map(({ prompt, own_db, heard_db }) => `${prompt}: ${heard_db.toFixed(1)} dB of ${own_db.toFixed(1)}, not ${middle_db.toFixed(1)}`).join("\n"));
  console.log(`${levels.length} textures ${spread(levels.map(({ own_db }) => own_db)).toFixed(1)} dB apart are heard within ` +
    `${spread(sorted).toFixed(2)} dB of each other`);
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) check(...process.argv.slice(2));
