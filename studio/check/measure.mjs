// Prints what the studio's page costs while a hand strokes for a minute. It measures and claims nothing:
//
//   STUDIO_MODULES=…/node_modules node measure.mjs ADDRESS CHROMIUM [SECONDS]
//
// ADDRESS is that of a running studio. Underruns are what the browser counts as such, where it does, and the time by which
// the clock of the sound falls behind that of the page.
import { chromium } from "./chromium.mjs";
import { Visit } from "./visit.mjs";

const PROMPT = "rough abrasive sheet with gritty particles";
/** A page may not be held up for longer, ms. */
const LONG_MS = 50;

const [address, executablePath, seconds = "60"] = process.argv.slice(2);

const browser = await chromium.launch({ executablePath, args: ["--autoplay-policy=no-user-gesture-required", "--no-sandbox"] });
const visit = await Visit.begin(browser, address);
const { page, cdp } = visit;
await cdp.send("Performance.enable");
const memory = async () => {
  await cdp.send("HeapProfiler.collectGarbage");
  const { metrics } = await cdp.send("Performance.getMetrics");
  return metrics.find(({ name }) => name === "JSHeapUsedSize").value / 1e6;
};

await visit.compile(PROMPT);
const before_mb = await memory();
await page.click("#sound-switch");
await page.waitForFunction(() => window.studioCheck.statuses.some(({ about, name }) => about === "load" && name === "ok"));
await page.click("#auto");
await page.waitForTimeout(1000);
const felt = await page.evaluate(async (wanted_s) => {
  const check = window.studioCheck;
  const context = check.contexts.at(-1);
  const counted = () => context.playbackStats ?? context.playoutStats ?? null;
  const stats = counted() && { ...counted().toJSON?.() };
  const { contextTime, performanceTime } = context.getOutputTimestamp();
  const [begin_s, begin_ms] = [context.currentTime, performance.now()];
  let [frames, longest_ms, last_ms] = [0, 0, performance.now()];
  while (performance.now() < begin_ms + 1000 * wanted_s) {
    await new Promise(requestAnimationFrame);
    const now_ms = performance.now();
    longest_ms = Math.max(longest_ms, now_ms - last_ms);
    last_ms = now_ms;
    frames++;
    check.chunks.length = 0;
  }
  const took_s = (performance.now() - begin_ms) / 1000;
  const end = context.getOutputTimestamp();
  return { took_s, frames, longest_ms, sound_s: context.currentTime - begin_s, stats, stats_end: counted() && { ...counted().toJSON?.() },
    output_s: end.contextTime - contextTime, output_clock_s: (end.performanceTime - performanceTime) / 1000 };
}, Number(seconds));
const after_mb = await memory();

// Saving what the strip keeps: the longest task of the page meanwhile.
await page.evaluate((long_ms) => {
  window.studioCheck.tasks = [];
  new PerformanceObserver((list) => window.studioCheck.tasks.push(...list.getEntries()
    .map(({ duration }) => duration).filter((ms) => ms > long_ms))).observe({ type: "longtask" });
}, LONG_MS);
await page.click("#auto");
await page.click("#sound-switch");
await page.waitForTimeout(1000);
await page.evaluate(() => (window.studioCheck.tasks.length = 0));
const began = performance.now();
const save = page.locator(".plot-controls button").nth(1);
const [download] = await Promise.all([page.waitForEvent("download"), save.evaluate((button) => button.click())]);
await download.path();
const saved_s = (performance.now() - began) / 1000;
const tasks = await page.evaluate(() => window.studioCheck.tasks);
const wasm = await page.evaluate(async () => {
  const { instance } = await WebAssembly.instantiateStreaming(fetch("asperity.wasm"));
  return instance.exports.memory.buffer.byteLength / 1e6;
});

const { took_s, frames, longest_ms, sound_s, stats, stats_end, output_s, output_clock_s } = felt;
console.log(`Chromium ${browser.version()}, ${took_s.toFixed(1)} s of a hand that moves by itself`);
console.log(`frames a second: ${(frames / took_s).toFixed(1)}; the longest frame ${longest_ms.toFixed(0)} ms`);
console.log(stats_end && Object.keys(stats_end).length > 0
  ? `underruns: ${Object.keys(stats_end).map((name) => `${name} ${(stats_end[name] - stats[name]).toPrecision(4)}`).join(", ")}`
  : "underruns: this browser does not count them");
console.log(`the sound's clock went on by ${sound_s.toFixed(3)} s, ${(1000 * (sound_s - took_s)).toFixed(0)} ms more than the page's; ` +
  `at the output by ${output_s.toFixed(3)} s in ${output_clock_s.toFixed(3)} s`);
console.log(`JavaScript heap: ${before_mb.toFixed(1)} MB before, ${after_mb.toFixed(1)} MB after; the renderer's memory ${wasm.toFixed(1)} MB`);
console.log(`saving what the strip keeps: ${saved_s.toFixed(1)} s, tasks above ${LONG_MS} ms: ${tasks.map((ms) => ms.toFixed(0)).join(", ") || "none"}`);
if (visit.errors.length > 0) console.log(`errors: ${visit.errors.join("; ")}`);
await browser.close();
