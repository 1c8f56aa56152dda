// Drives modules through `page/worklet.js` as an AudioWorklet would, and compares what they render
// with `asperity render --rate 16000`:
//
//   node check.mjs ASPERITY FOLDER REFUSED.asp MODULE.wasm… -- TEXTURE.asp…
//
// REFUSED.asp has a rate of 1500 Hz, which 16 kHz is no multiple of; the first and the last texture
// differ in their rate. FOLDER takes the tables.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { pointer, PAGE_S } from "../check/pointer.mjs";
import { apart_db } from "../check/third-octaves.mjs";

const TICK_HZ = 16000;
const QUANTUM = 128;
const BLOCKS = 900;
/** Above 2³², so that both halves of it count. */
const SEED = 4294967303n;
/** Frames by which the upsampler is late. */
const DELAY_FRAMES = 33;

function fail(text) {
  console.error(text);
  process.exit(1);
}

// What an AudioWorkletGlobalScope has, as far as the processor may use it.
globalThis.sampleRate = 48000;
globalThis.currentTime = 0;
globalThis.AudioWorkletProcessor = class {
  constructor() {
    this.posted = [];
    this.port = { onmessage: null, postMessage: (message) => this.posted.push(structuredClone(message)) };
  }
};
let Processor;
globalThis.registerProcessor = (_name, type) => (Processor = type);
// Nor has it these.
const { performance } = globalThis;
for (const name of ["TextDecoder", "TextEncoder", "atob", "performance", "fetch"]) {
  Object.defineProperty(globalThis, name, { get: () => fail(`a worklet has no ${name}`), configurable: true });
}
await import(new URL("../page/worklet.js", import.meta.url));

/** A processor with its clock, before its module is ready. */
class Node {
  constructor(processorOptions) {
    globalThis.currentTime = 0;
    this.processor = new Processor({ processorOptions });
    this.blocks = 0;
    this.busy_ms = 0;
    this.audio = [];
  }

  post(data) {
    this.processor.port.onmessage({ data });
  }

  async ready() {
    while (!this.status("module")) await new Promise(setImmediate);
  }

  /** The last status about something. */
  status(about) {
    return this.processor.posted.findLast((message) => message.type === "status" && message.about === about);
  }

  run(blocks) {
    for (let n = 0; n < blocks; n++) {
      globalThis.currentTime = (this.blocks++ * QUANTUM) / sampleRate;
      const channels = [new Float32Array(QUANTUM), new Float32Array(QUANTUM)];
      const began = performance.now();
      if (!this.processor.process([], [channels])) fail("the processor ended");
      this.busy_ms += performance.now() - began;
      if (channels[0].some((x, k) => x !== channels[1][k])) fail("the channels differ");
      this.audio.push(channels[0]);
    }
  }
}

/** A whole session: what was posted of its ticks, its audio, and a hash of all of it. */
async function session(module, asset) {
  const node = new Node({ module, asset, seed: SEED, delay_s: 0.02 });
  node.post({ type: "record", on: true });
  node.run(3);
  if (node.audio.some((block) => block.some((x) => x !== 0))) fail("sound before the module");
  await node.ready();
  const [ready, loaded] = [node.status("module"), node.status("load")];
  if (ready.status !== 0 || loaded?.status !== 0) fail(`not loaded: ${ready.name}, ${loaded?.name}`);
  const events = pointer();
  for (let next = 0, block = 0; block < BLOCKS; block++) {
    // The page hands over what came since its last frame.
    if (block % 6 === 0) {
      const from = next;
      while (next < events.length && events[next][0] - PAGE_S <= currentTime) next++;
      if (next > from) node.post({ type: "hand", events: Float64Array.from(events.slice(from, next).flat()) });
    }
    node.run(1);
  }
  node.post({ type: "record", on: false });
  const chunks = node.processor.posted.filter((message) => message.type === "ticks");
  let count = 0;
  for (const { session, first, flags } of chunks) {
    if (session !== 1 || first !== count) fail(`ticks ${first} of session ${session} after ${count}`);
    count += flags.length;
  }
  if (count !== (BLOCKS * QUANTUM) / 3) fail(`${count} ticks in ${BLOCKS} blocks`);
  const joined = (name, type) => type.from(chunks.flatMap((chunk) => Array.from(chunk[name])));
  const played = {
    positions: joined("positions_mm", Float32Array),
    columns: joined("columns", Float32Array),
    flags: joined("flags", Uint32Array),
    audio: Float32Array.from(node.audio.slice(3).flatMap((block) => Array.from(block))),
  };
  const hash = createHash("sha256");
  for (const numbers of Object.values(played)) hash.update(new Uint8Array(numbers.buffer));
  const tick_us = (1000 * node.busy_ms) / count;
  return { ...played, hash: hash.digest("hex"), mass_kg: loaded.effective_mass_kg, tick_us };
}

/** What the command renders for the recorded positions: nine columns and the flags, by tick. */
function rendered(asperity, folder, texture, positions) {
  const [input, output] = ["samples.csv", "rendered.csv"].map((name) => join(folder, name));
  const rows = ["t_s,x_mm,y_mm,z_mm"];
  for (let n = 0; n < positions.length / 3; n++) {
    rows.push([n / TICK_HZ, ...positions.subarray(3 * n, 3 * n + 3)].join(","));
  }
  writeFileSync(input, rows.join("\n") + "\n");
  execFileSync(asperity, ["render", texture, "--rate", `${TICK_HZ}`, "--trajectory", input, "-o", output,
    "--seed", `${SEED}`, "--quiet"], { stdio: ["ignore", "ignore", "inherit"] });
  const [header, ...lines] = readFileSync(output, "utf8").trimEnd().split("\n");
  const names = header.split(",");
  return { names: names.slice(2, 11), lines: lines.map((line) => line.split(",").slice(2)) };
}

/** Compares every tick with the command's, bit for bit. */
function compare(name, played, { names, lines }) {
  const ticks = played.flags.length;
  if (lines.length !== ticks) fail(`${name}: ${lines.length} rows for ${ticks} ticks`);
  const bits = new Uint32Array(played.columns.buffer);
  const number = new Float32Array(1);
  const numberBits = new Uint32Array(number.buffer);
  lines.forEach((line, tick) => {
    names.forEach((column, k) => {
      number[0] = Number(line[k]);
      if (numberBits[0] !== bits[9 * tick + k]) {
        fail(`${name}: tick ${tick}, ${column}: ${played.columns[9 * tick + k]}, the command has ${line[k]}`);
      }
    });
    if (Number(line[9]) !== played.flags[tick]) fail(`${name}: tick ${tick}, flags: ${played.flags[tick]} not ${line[9]}`);
  });
  // A session of which nothing is heard proves nothing.
  const taps = played.flags.reduce((sum, flags) => sum + ((flags >> 1) & 1), 0);
  const contact = played.flags.reduce((sum, flags) => sum + (flags & 1), 0);
  if (taps < 2 || contact < ticks / 3) fail(`${name}: ${taps} taps, ${contact} ticks in contact`);
  return `${ticks} ticks, ${contact} in contact, ${taps} taps`;
}

/** Compares the spectrum of the audio with that of vibration and tap as the command has them. */
function compareSpectra(name, { audio, mass_kg }, { names, lines }) {
  const [vib, tap] = ["vib_m_s2", "tap_n"].map((column) => names.indexOf(column));
  const ticks = Float64Array.from(lines, (line) => Number(line[vib]) + Number(line[tap]) / mass_kg);
  const most = apart_db({ signal: ticks, rate_hz: TICK_HZ }, { signal: audio.subarray(DELAY_FRAMES), rate_hz: 3 * TICK_HZ });
  if (!(most < 0.5)) fail(`${name}: a third octave of the audio differs by ${most} dB`);
  return `third octaves within ${most.toFixed(4)} dB`;
}

/** What is refused, and that what played plays on. */
async function refusals(module, refused, good, other) {
  const node = new Node({ module });
  node.post({ type: "swap", asset: good, id: "early" });
  await node.ready();
  const expect = (about, name, id) => {
    const status = node.status(about);
    if (status?.name !== name || status.id !== id) fail(`${about}: ${JSON.stringify(status)} instead of ${name}`);
    return status;
  };
  expect("swap", "empty", "early");
  node.post({ type: "load", asset: good, id: 1 });
  const first = expect("load", "ok", 1);
  for (const about of ["load", "swap"]) {
    node.post({ type: about, asset: refused, id: 2 });
    const { model_rate_hz } = expect(about, "rate", 2);
    if (model_rate_hz !== 1500) fail(`${about}: the refused rate is ${model_rate_hz} Hz`);
    node.post({ type: about, asset: good.slice(0, 100), id: 3 });
    expect(about, "format", 3);
  }
  node.post({ type: "hand", events: Float64Array.of(0, 0, NaN, 0, 0) });
  expect("hand", "event", undefined);
  // More swaps than there are slots: the last one is heard, and one that had to wait was replaced.
  for (let id = 10; id < 15; id++) node.post({ type: "swap", asset: id < 14 ? good : other, id });
  expect("swap", "replaced", 13);
  node.run(20);
  const last = expect("swap", "ok", 14);
  if (last.session !== 1 || !(last.tick > 0)) fail("a swap began another session");
  if (!(last.stiffness_n_m > 0) || last.model_rate_hz === first.model_rate_hz) fail("a swap has the figures of before");

  const broken = new Node({ module: new Uint8Array(8), asset: good });
  await broken.ready();
  if (broken.status("module").name !== "module") fail("a module that is none was taken");
  globalThis.sampleRate = 44100;
  const slow = new Node({ module, asset: good });
  if (slow.status("context")?.name !== "context") fail("a context of 44.1 kHz was taken");
  globalThis.sampleRate = 48000;
}

const [asperity, folder, refused, ...rest] = process.argv.slice(2);
const split = rest.indexOf("--");
const [modules, textures] = [rest.slice(0, split), rest.slice(split + 1)];
if (modules.length === 0 || textures.length === 0) fail("no module or no texture is given");
const bytes = (path) => new Uint8Array(readFileSync(path));

for (const path of modules) await refusals(bytes(path), bytes(refused), bytes(textures[0]), bytes(textures.at(-1)));
for (const texture of textures) {
  const name = basename(texture);
  const hashes = [];
  for (const path of modules) {
    const played = await session(bytes(path), bytes(texture));
    const command = rendered(asperity, folder, texture, played.positions);
    const of = `${name}, ${basename(path)}`;
    const [ticks, spectra] = [compare(of, played, command), compareSpectra(of, played, command)];
    console.log(`${of}: ${ticks}, bits of the command; ${spectra}; ${played.tick_us.toFixed(2)} µs a tick`);
    hashes.push(played.hash);
  }
  if (new Set(hashes).size !== 1) {
    fail(`${name}: the modules differ: ${hashes.join(", ")}; run studio/build-worklet and commit its module`);
  }
}
