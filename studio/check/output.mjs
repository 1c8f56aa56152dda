// The sound for ears and actuators, and the hand that moves by itself, in the page.
import { readFileSync } from "node:fs";
import { renderedCsv } from "../page/plots/csv.js";
import { Ring } from "../page/plots/ring.js";
import { clean } from "./aid.mjs";
import { channels, modes, responseAt, spectrum } from "./offline.mjs";

/** Ticks in which the hand gets up to its speed, and its speed, mm/s. */
const BEGIN_TICKS = 4000;
const SPEED_MM_S = 100;
const TICK_HZ = 16000;

/** The ticks of the hand that moves by itself are smooth while the page does nothing for 300 ms. */
async function steadyHand(visit, { assert }) {
  const { page } = visit;
  await page.check("#auto-path input[value=circle]");
  await visit.take();
  await page.click("#auto");
  await page.waitForTimeout(500);
  await page.evaluate(() => {
    const until = performance.now() + 300;
    while (performance.now() < until);
  });
  await page.waitForTimeout(300);
  const ticks = (await visit.take()).filter(({ depth_mm }) => depth_mm > 0).slice(BEGIN_TICKS);
  const speeds = ticks.map(({ speed_mm_s }) => speed_mm_s);
  const [least, most] = [Math.min(...speeds), Math.max(...speeds)];
  assert(ticks.length > 8000 && least > 0.98 * SPEED_MM_S && most < 1.02 * SPEED_MM_S,
    `while the page is blocked for 300 ms, the hand keeps its speed: ${least.toFixed(1)} to ${most.toFixed(1)} mm/s`);
  const shown = () => page.evaluate(() => document.getElementById("contact").style.transform);
  const before = await shown();
  await page.waitForTimeout(100);
  assert((await shown()) !== before, "and the page draws where it is");

  await page.check("#auto-path input[value=tap]");
  await page.waitForTimeout(200);
  await visit.take();
  await page.waitForTimeout(1200);
  const down = (await visit.take()).map(({ depth_mm }) => depth_mm > 0);
  const taps = down.flatMap((now, n) => (now && n > 0 && !down[n - 1] ? [n / TICK_HZ] : []));
  const periods = taps.slice(1).map((at_s, n) => at_s - taps[n]);
  assert(periods.length > 0 && periods.every((s) => Math.abs(s - 0.5) < 0.02), `it taps twice a second, ${taps.length} times`);
  await page.check("#auto-path input[value=line]");
  await page.waitForTimeout(300);
  // A finger takes its place.
  await visit.fingerStroke();
  await page.waitForFunction(() => document.getElementById("auto").getAttribute("aria-pressed") === "false");
  await visit.take();
  await page.waitForTimeout(300);
  assert((await visit.take()).every(({ depth_mm }) => depth_mm <= 0), "a finger takes its place, and it stays lifted");
  await page.check("#auto-path input[value=circle]");
}

async function choice(visit, { assert }) {
  const { page } = visit;
  const level = () => page.textContent("#level-text");
  await page.selectOption("#mode", "coil");
  assert((await level()) === "−50 dB", "the mode for a voice coil begins at −50 dB");
  await page.fill("#level", "-30");
  await page.selectOption("#mode", "ear");
  assert((await level()) === "−6 dB" && (await page.textContent("#mode-text")).includes("250 Hz higher"),
    "that for headphones at −6 dB, and the page says what it does");
  await page.selectOption("#mode", "coil");
  assert((await level()) === "−50 dB", "chosen again, that for a voice coil is at −50 dB again");
  await page.selectOption("#mode", "dualsense");
  await page.waitForSelector("#mode-text strong");
  const said = await page.textContent("#mode-text");
  assert(said.includes("2 channels") && said.includes("USB") && (await page.isHidden(".channel-test")),
    "without four channels that is said, with the remedy");
}

/** With a device of four channels, as far as the page can see. */
async function fourChannels(visit, { assert }) {
  const { page } = visit;
  await page.evaluate(() => {
    const { destination } = window.studioCheck.contexts.at(-1);
    Object.defineProperties(destination, { maxChannelCount: { get: () => 4 }, channelCount: { set: () => {}, get: () => 4 } });
  });
  await page.selectOption("#mode", "coil");
  await page.selectOption("#mode", "dualsense");
  await page.click(".channel-test button");
  const named = [];
  for (let n = 1; n <= 4; n++) {
    await page.waitForFunction((channel) =>
      document.querySelector(".channel-test p").textContent.includes(`Channel ${channel}`), n);
    named.push(await page.textContent(".channel-test p"));
  }
  assert(named[2].includes("left actuator"), `the channel test names them: ${named.join("; ")}`);
  await page.waitForFunction(() => !document.querySelector(".channel-test button").disabled);
  await page.selectOption("#mode", "plain");
}

async function equaliser(visit, { assert }) {
  const { page } = visit;
  await page.click("#equaliser summary");
  await page.focus("#band-60");
  for (let n = 0; n < 8; n++) await page.keyboard.press("ArrowRight");
  await page.fill("#band-200", "-6");
  assert(await page.isChecked("#equaliser-use"), "a band that is moved turns the equaliser on");
  const drawn = await page.getAttribute(".response .curve", "d");
  const points = drawn.slice(1).split("L").map((point) => point.split(" ").map(Number));
  // 240 pixels are 20 to 500 Hz, 92 are 30 dB.
  const gainAt = (hz) => {
    const at = 26 + (240 * Math.log(hz / 20)) / Math.log(25);
    const [, y] = points.reduce((best, point) => (Math.abs(point[0] - at) < Math.abs(best[0] - at) ? point : best));
    return ((52 - y) * 30) / 92;
  };
  const frequencies_hz = [25, 40, 60, 85, 110, 200, 300, 450];
  const found = await responseAt(visit, { mode: "plain", gains_db: [0, 8, 0, -6, 0] }, frequencies_hz);
  const apart = Math.max(...frequencies_hz.map((hz, n) => Math.abs(gainAt(hz) - found[n])));
  assert(apart < 0.3 && Math.max(...found) > 7, `the equaliser does what its drawing says, within ${apart.toFixed(2)} dB`);
  await page.fill("#actuator-name", "<b>my coil</b>");
  await page.keyboard.press("Enter");
  assert((await page.textContent("#actuator option:checked")) === "<b>my coil</b>", "an actuator is saved by its name, as text");
  await page.selectOption("#actuator", "flat");
  assert((await page.inputValue("#band-60")) === "0" && !(await page.isChecked("#equaliser-use")), "flat is off");
  await page.selectOption("#actuator", { label: "<b>my coil</b>" });
  assert((await page.inputValue("#band-60")) === "8", "and the actuator comes back");

  await page.focus("#tones");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector(".hz").textContent === "25 Hz");
  await page.waitForFunction(() => document.querySelector(".hz").textContent === "40 Hz");
  assert(true, "test tones go on from step to step");
  await page.focus("#band-110");
  await page.keyboard.press("ArrowLeft");
  const plays = () => page.evaluate(() => document.getElementById("tones").getAttribute("aria-pressed") === "true");
  assert((await plays()) && (await page.inputValue("#band-110")) === "-1", "a key that sets a band leaves them on");
  await clean(visit.page, assert, "with equaliser and motors", "dark");
  await page.keyboard.press("x");
  assert(!(await plays()), "any other key stops them");
  await page.focus("#tones");
  await page.keyboard.press(" ");
  await page.waitForFunction(() => document.getElementById("tones").getAttribute("aria-pressed") === "true");
  await page.keyboard.press(" ");
  assert(!(await plays()), "also the one that started them");
  await page.selectOption("#actuator", { label: "<b>my coil</b>" });
  await page.click("#actuator + button");
  assert((await page.$$("#actuator option")).length === 2, "an actuator is deleted");
  await page.selectOption("#actuator", "flat");
  for (const name of ["equaliser", "motors"]) await page.click(`#${name} summary`);
}

async function motors(visit, { assert }) {
  const { page } = visit;
  await page.click("#motors summary");
  assert((await page.textContent("#motors")).includes("No gamepad") && (await page.$("#rumble")) === null,
    "without a gamepad there is a line only");
  await page.evaluate(() => {
    const effects = (window.studioCheck.effects = []);
    const vibrationActuator = { playEffect: async (type, effect) => effects.push([type, effect]), reset: async () => {} };
    navigator.getGamepads = () => [{ id: "Pad", vibrationActuator }, null];
    const patterns = (window.studioCheck.patterns = []);
    navigator.vibrate = (pattern) => patterns.push(pattern);
    dispatchEvent(new Event("gamepadconnected"));
  });
  await page.check("#rumble");
  await page.check("#vibration");
  await page.click("#auto");
  await page.waitForFunction(() => window.studioCheck.effects.filter(([type, { strongMagnitude: s, weakMagnitude: w }]) =>
    type === "dual-rumble" && s > 0.01 && w > 0.01 && s <= 1 && w <= 1).length > 4);
  assert(true, "a gamepad rumbles with the stroke, with both motors");
  await page.waitForFunction(() => window.studioCheck.patterns.filter((ms) => ms > 0).length > 4);
  assert(true, "a phone vibrates with it");
  await page.click("#auto");
  await page.waitForFunction(() => window.studioCheck.patterns.at(-1) === 0);
  assert(true, "and stops with it");
  await page.uncheck("#rumble");
  await page.uncheck("#vibration");
}

/** A worker writes the table of the ticks; the frozen strip has those of the page's renderer. */
async function tables(visit, { assert }) {
  const { page } = visit;
  const [freeze, save] = [".plot-controls button >> nth=0", ".plot-controls button >> nth=1"];
  await page.click(freeze);
  await visit.take();
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(save)]);
  const text = readFileSync(await download.path(), "utf8");
  const lines = text.trimEnd().split("\n");
  const [first, last] = [lines[1], lines.at(-1)].map((line) => Number(line.split(",")[0]));
  const ring = new Ring(last + 1);
  for (const chunk of visit.chunks) if (chunk.first + chunk.flags.length <= last + 1) ring.add(chunk);
  ring.first = first;
  const module = readFileSync(new URL("../page/asperity.wasm", import.meta.url));
  const runtime = (await WebAssembly.instantiate(module)).instance.exports;
  assert(renderedCsv(ring, TICK_HZ, runtime) === text, `${lines.length - 1} ticks are saved as a table by a worker, to the byte`);
  await page.click(freeze);
  await page.evaluate(() => scrollTo(0, 0));
}

export async function output(visit, tools) {
  if (tools.asperity) await spectrum(visit, tools);
  await modes(visit, tools);
  await channels(visit, tools);
  await steadyHand(visit, tools);
  await choice(visit, tools);
  await fourChannels(visit, tools);
  await motors(visit, tools);
  await equaliser(visit, tools);
  await tables(visit, tools);
}
