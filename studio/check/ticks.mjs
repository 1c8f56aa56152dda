// The ticks that the page's renderer posted, against those of `asperity render --rate 16000`.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const TICK_HZ = 16000;

const join32 = (arrays, Type) => {
  const all = new Type(arrays.reduce((sum, { length }) => sum + length, 0));
  arrays.reduce((at, array) => (all.set(array, at), at + array.length), 0);
  return all;
};

/** The first session that was heard, from its first tick on. */
export function firstSession(chunks) {
  const own = chunks.filter(({ session }) => session === chunks[0].session);
  let count = 0;
  for (const { first, flags } of own) {
    if (first !== count) throw new Error(`tick ${first} follows ${count} ticks`);
    count += flags.length;
  }
  const all = (name, Type) => join32(own.map((chunk) => chunk[name]), Type);
  return { positions_mm: all("positions_mm", Float32Array), columns: all("columns", Float32Array), flags: all("flags", Uint32Array) };
}

/** `null` where the command renders the same bits for the same positions, else the first difference. */
export function sameAsCommand(asperity, folder, asset, { positions_mm, columns, flags }) {
  const [texture, input, output] = ["texture.asp", "samples.csv", "rendered.csv"].map((name) => join(folder, name));
  writeFileSync(texture, asset);
  const row = (_, n) => [n / TICK_HZ, ...positions_mm.subarray(3 * n, 3 * n + 3)].join(",");
  writeFileSync(input, ["t_s,x_mm,y_mm,z_mm", ...Array.from(flags, row)].join("\n") + "\n");
  execFileSync(asperity, ["render", texture, "--rate", `${TICK_HZ}`, "--trajectory", input, "-o", output,
    "--quiet"], { stdio: ["ignore", "ignore", "inherit"] });
  const [header, ...lines] = readFileSync(output, "utf8").trimEnd().split("\n");
  const names = header.split(",").slice(2, 11);
  if (lines.length !== flags.length) return `${flags.length} ticks for ${lines.length} rows`;
  for (let tick = 0; tick < lines.length; tick++) {
    const wanted = lines[tick].split(",").slice(2);
    const k = names.findIndex((_, column) => !Object.is(Math.fround(Number(wanted[column])), columns[9 * tick + column]));
    if (k >= 0) return `tick ${tick}: ${names[k]} is ${columns[9 * tick + k]}, the command has ${wanted[k]}`;
    if (Number(wanted[9]) !== flags[tick]) return `tick ${tick}: flags are ${flags[tick]}, the command has ${wanted[9]}`;
  }
  return null;
}
