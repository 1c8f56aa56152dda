// The page's own nodes in an OfflineAudioContext of the browser: what they give for an impulse, for noise, for a pointer.
import { COLUMN, COLUMNS } from "../page/plots/ring.js";
import { pointer, PAGE_S } from "./pointer.mjs";
import { apart_db } from "./third-octaves.mjs";
import { firstSession, sameAsCommand } from "./ticks.mjs";
import { numbers } from "./visit.mjs";

const RATE_HZ = 48000;
const TICK_HZ = 16000;
/** What the limiter lets through, −1 dB of full scale, and by how many frames it and the upsampler are late. */
const CEILING = 10 ** (-1 / 20);
const DELAY_FRAMES = 33 + 47;

/** Runs in the page: renders a chain. `signal` goes to its input; `asset`, `events` and `path` to its renderer. */
async function render({ mode = "plain", level_db = 0, channels = 1, seconds = 1, signal, gains_db, bursts,
  asset, events = [], path, page_s }) {
  const [{ buildChain }, { testChannels }] =
    await Promise.all(["output/chain.js", "output/tones.js"].map((name) => import(new URL(name, document.baseURI))));
  const context = new OfflineAudioContext(channels, 48000 * seconds, 48000);
  const module = fetch(new URL("asperity.wasm", document.baseURI)).then((response) => response.arrayBuffer());
  const chain = await buildChain(context, module, mode);
  chain.turn(level_db, 1, 0);
  if (gains_db) chain.equaliser.filters.forEach(({ gain }, n) => (gain.value = gains_db[n]));
  if (bursts !== undefined) testChannels(chain, bursts);
  if (signal) {
    const buffer = new AudioBuffer({ length: signal.length, sampleRate: 48000 });
    buffer.copyToChannel(Float32Array.from(signal), 0);
    const source = new AudioBufferSourceNode(context, { buffer });
    source.connect(chain.input);
    source.start();
  }
  const chunks = [];
  if (asset) {
    const { port } = chain.renderer;
    let loaded;
    const ready = new Promise((done) => (loaded = done));
    port.onmessage = ({ data }) => {
      if (data.type === "ticks") chunks.push(data);
      else if (data.about === "load") loaded(data);
    };
    port.postMessage({ type: "record", on: true });
    port.postMessage({ type: "load", asset: Uint8Array.from(atob(asset), (byte) => byte.charCodeAt(0)) });
    await ready;
    if (path) port.postMessage({ type: "path", path, t_s: page_s });
    // As a page posts them, at its frames.
    for (let at_s = 0.016; at_s < seconds; at_s += 0.016) {
      context.suspend(at_s).then(async () => {
        const due = [];
        while (events.length > 0 && events[0][0] - page_s <= context.currentTime) due.push(events.shift());
        if (due.length > 0) port.postMessage({ type: "hand", events: Float64Array.from(due.flat()) });
        await new Promise((done) => setTimeout(done, 2));
        context.resume();
      });
    }
  }
  const buffer = await context.startRendering();
  if (asset) {
    chain.renderer.port.postMessage({ type: "record", on: false });
    await new Promise((done) => setTimeout(done, 200));
  }
  const { text } = window.studioCheck;
  return { audio: Array.from({ length: channels }, (_, n) => text(buffer.getChannelData(n).buffer)),
    chunks: chunks.map(({ session, first, positions_mm, columns, flags }) =>
      ({ session, first, arrays: [positions_mm, columns, flags].map(({ buffer }) => text(buffer)) })) };
}

async function rendered({ page }, options) {
  const { audio, chunks } = await page.evaluate(render, options);
  const [positions_mm, columns, flags] = [Float32Array, Float32Array, Uint32Array];
  return { audio: audio.map((text) => numbers(text, Float32Array)), chunks: chunks.map(({ session, first, arrays }) =>
    ({ session, first, positions_mm: numbers(arrays[0], positions_mm), columns: numbers(arrays[1], columns),
      flags: numbers(arrays[2], flags) })) };
}

const peakOf = (signal) => signal.reduce((peak, x) => Math.max(peak, Math.abs(x)), 0);

/** Level of a signal at a frequency, dB of what an impulse of one has. */
function levelAt(signal, hz) {
  let [re, im] = [0, 0];
  signal.forEach((x, n) => {
    re += x * Math.cos((2 * Math.PI * hz * n) / RATE_HZ);
    im += x * Math.sin((2 * Math.PI * hz * n) / RATE_HZ);
  });
  return 10 * Math.log10(re * re + im * im);
}

/** What a mode or equaliser does to frequencies, dB. */
export async function responseAt(visit, options, frequencies_hz) {
  // An impulse that the limiter leaves alone; full scale is 40 m/s².
  const { audio: [audio] } = await rendered(visit, { ...options, signal: [20] });
  return frequencies_hz.map((hz) => levelAt(audio, hz) - 20 * Math.log10(0.5));
}

/** The hand that moves by itself, to and fro twice a second. */
async function selfMoving(visit, { assert, asperity, work }) {
  const asset = await visit.asset();
  const path = { name: "line", speed_mm_s: 120, force_n: 1, centre_mm: [5, 5], radius_mm: 60 / (2 * Math.PI), phase: 0 };
  const { chunks } = await rendered(visit, { asset: asset.toString("base64"), path, page_s: PAGE_S });
  const played = firstSession(chunks);
  const difference = sameAsCommand(asperity, work, asset, played);
  const x_mm = played.positions_mm.filter((_, n) => n % 3 === 0);
  const way_mm = x_mm.reduce((way, x, n) => way + Math.abs(x - (x_mm[n - 1] ?? x)), 0);
  assert(difference === null && way_mm > 60,
    difference ?? `a hand that moves by itself by ${way_mm.toFixed(0)} mm gives ticks with the bits of asperity render`);
}

/** The spectrum of what a pointer's strokes sound like is that of the command. */
export async function spectrum(visit, { assert, asperity, work }) {
  const asset = await visit.asset();
  const { audio: [audio], chunks } = await rendered(visit,
    { mode: "plain", seconds: 2.4, asset: asset.toString("base64"), events: pointer(), page_s: PAGE_S });
  const played = firstSession(chunks);
  const difference = sameAsCommand(asperity, work, asset, played);
  assert(difference === null,
    difference ?? `an OfflineAudioContext renders ${played.flags.length} ticks with the bits of asperity render`);
  await selfMoving(visit, { assert, asperity, work });
  const mass_kg = await visit.page.evaluate(() =>
    window.studioCheck.statuses.find(({ about }) => about === "load").effective_mass_kg);
  const column = (n, name) => played.columns[n * COLUMNS.length + COLUMN[name]];
  const signal = Float64Array.from(played.flags, (_, n) => column(n, "vib_m_s2") + column(n, "tap_n") / mass_kg);
  const apart = apart_db({ signal, rate_hz: TICK_HZ },
    { signal: Float64Array.from(audio.subarray(DELAY_FRAMES), (x) => 40 * x), rate_hz: RATE_HZ });
  assert(apart < 0.5, `its sound has the spectrum of these within ${apart.toFixed(4)} dB in third octaves to 450 Hz`);
}

export async function modes(visit, { assert }) {
  const [low, passed, high] = await responseAt(visit, { mode: "coil" }, [5, 100, 1000]);
  assert(low < -30 && Math.abs(passed) < 0.5 && high < -20,
    `for a voice coil, 100 Hz has ${passed.toFixed(2)} dB, 5 Hz ${low.toFixed(0)} dB, 1 kHz ${high.toFixed(0)} dB`);
  const signal = Array.from({ length: RATE_HZ }, (_, n) => 10 * Math.sin((2 * Math.PI * 100 * n) / RATE_HZ));
  const { audio: [ear] } = await rendered(visit, { mode: "ear", signal });
  const end = ear.subarray(RATE_HZ / 2);
  const [raised, kept, mirrored] = [350, 100, 150].map((hz) => levelAt(end, hz) - 20 * Math.log10((0.25 * RATE_HZ) / 4));
  assert(Math.abs(raised) < 0.1 && kept < -50 && mirrored < -45,
    `for headphones, 100 Hz sounds at 350 Hz with ${raised.toFixed(2)} dB, at 100 Hz with ${kept.toFixed(0)} dB, `
      + `at 150 Hz with ${mirrored.toFixed(0)} dB`);
  let seed = 1;
  const noise = Array.from({ length: RATE_HZ / 8 }, () => 400 * ((seed = (seed * 16807) % 2147483647) / 1073741823.5 - 1));
  for (const mode of ["plain", "ear", "coil", "dualsense"]) {
    for (const level_db of [-20, 24]) {
      const { audio } = await rendered(visit,
        { mode, level_db, channels: 4, seconds: 0.2, signal: noise, gains_db: [12, 12, 12, 12, 12] });
      const most = CEILING * 10 ** (Math.min(level_db, 0) / 20);
      const peaks = audio.map(peakOf);
      assert(Math.max(...peaks) <= most * (1 + 1e-6) && Math.max(...peaks) > 0.5 * most,
        `made for ${mode}, at ${level_db} dB, ten times too loud: the peak is ${Math.max(...peaks).toFixed(3)}`);
      if (mode !== "dualsense") continue;
      assert(peaks[0] === 0 && peaks[1] === 0 && peaks[2] === peaks[3], "and it plays on channels 3 and 4 alone");
    }
  }
}

export async function channels(visit, { assert }) {
  const { audio } = await rendered(visit, { mode: "dualsense", channels: 4, seconds: 4.5, bursts: 0.2 });
  audio.forEach((_, n) => {
    const slot = audio.map((channel) => channel.subarray((0.2 + n) * RATE_HZ, (1.15 + n) * RATE_HZ));
    const peaks = slot.map(peakOf);
    const [tone, other] = [100, 200].map((hz) => levelAt(slot[n], hz));
    const alone = peaks.every((peak, k) => k === n || peak < 0.01 * peaks[n]);
    assert(alone && peaks[n] > 0.2 && peaks[n] < CEILING && tone - other > 30,
      `burst ${n + 1} of the channel test plays 100 Hz on channel ${n + 1} alone`);
  });
}
