// Drives the studio's page in a real Chromium, as people do: keys, pen, fingers; and asserts what comes out.
//
//   STUDIO_MODULES=…/node_modules node browser.mjs ADDRESS CHROMIUM
//
// STUDIO_MODULES has playwright-core and axe-core. ADDRESS is that of a running studio. With ASPERITY, a
// path of the command, the worklet's ticks are compared with those of `asperity render`, and files that the page
// gives, and textures of its gallery, with those of the command. STUDIO_PICTURES is a folder that takes
// screenshots.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { clean } from "./aid.mjs";
import { readable } from "./boxes.mjs";
import { assert, axe, chromium, count } from "./chromium.mjs";
import { files } from "./files.mjs";
import { gallery } from "./gallery.mjs";
import { output } from "./output.mjs";
import { steer } from "./steer.mjs";
import { firstSession, sameAsCommand } from "./ticks.mjs";
import { Visit } from "./visit.mjs";

const PROMPT = "rough abrasive sheet with gritty particles";
/** Force of a pen's full pressure, and what the slider begins with, N. */
const [FULL_N, SLIDER_N] = [3, 1];
const TICK_HZ = 16000;
/** Pixels of the page a millimetre, before any zoom. */
const PX_MM = 5;

const [address, executablePath, studio] = process.argv.slice(2);
const near = (x, wanted, share) => Math.abs(x - wanted) <= share * wanted;

async function prompts(visit) {
  const { page } = visit;
  assert(await page.evaluate(() => document.activeElement.id === "prompt"), "the prompt has the focus at first");
  await page.keyboard.type("coarse sandpa");
  await page.waitForSelector("#suggestions [role=option]");
  await page.keyboard.press("ArrowDown");
  const active = await page.getAttribute("#prompt", "aria-activedescendant");
  const chosen = await page.textContent(`#${active}`);
  await page.keyboard.press("Enter");
  const ended = await page.inputValue("#prompt");
  assert(ended === `coarse ${chosen}` && chosen.includes("sandpaper"), `a suggestion ends the prompt: “${ended}”`);
  assert((await page.getAttribute("#prompt", "aria-expanded")) === "false", "the list is closed then");

  await page.keyboard.press("Control+a");
  await page.keyboard.press("Backspace");
  await page.keyboard.press("Enter");
  assert((await page.textContent("#prompt-error")).includes("Describe a surface"), "an empty prompt is refused with help");

  await visit.compile(PROMPT);
  assert((await page.textContent("#prompt-error")) === "", "an error goes when a prompt compiles");
  const words = await page.$$eval(".word", (all) =>
    all.map(({ dataset, children }) => [children[0].textContent, dataset.role, dataset.moved]));
  assert(words.map(([word]) => word).join(" ") === PROMPT, "every word of the prompt is shown");
  const [, role, moved] = words.find(([word]) => word === "rough");
  assert(role === "quality" && moved === "rough", "“rough” is a quality that moved rough");
  assert(/(Known|Close|A guess)/.test(await page.textContent(".certainty")), "the certainty is in words");
  assert((await page.textContent("#command code")).startsWith("asperity compile "), "the command is shown");
  assert((await page.$$(".axis input:enabled")).length === 4, "rough, slippery, hard and sharp have sliders");
  assert((await page.$$(".material")).length > 0, "nearest materials are offered");
}

async function pen(visit) {
  const { page } = visit;
  const pressure = 0.4;
  await visit.penStroke({ pressure: () => pressure, seconds: 1.2, px_s: 400 });
  const ticks = await visit.take();
  const moving = ticks.filter(({ depth_mm, speed_mm_s }) => depth_mm > 0 && speed_mm_s > 40);
  assert(moving.length > 4000, `a pen's stroke comes out as ${moving.length} ticks in contact`);
  const mean = (name) => moving.reduce((sum, tick) => sum + Math.abs(tick[name]), 0) / moving.length;
  const force_n = mean("normal_force_n");
  assert(near(force_n, pressure * FULL_N, 0.08), `their force is that of the pressure: ${force_n.toFixed(2)} N`);
  // Not the mean of the speed: a busy machine sends a pen's events in bursts, and the hand cuts jumps.
  const way_mm = ticks.reduce((sum, { depth_mm, speed_mm_s }) => sum + (depth_mm > 0 ? speed_mm_s / TICK_HZ : 0), 0);
  const pen_mm = (1.2 * 400) / PX_MM;
  assert(way_mm > 0.5 * pen_mm && way_mm < 1.1 * pen_mm, `their way is that of the pen: ${way_mm.toFixed(0)} of ${pen_mm} mm`);
  assert(mean("vib_m_s2") > 0.1, `they vibrate: ${mean("vib_m_s2").toFixed(2)} m/s² in the mean`);
  assert(mean("friction_n") > 0.05, `they rub: ${mean("friction_n").toFixed(2)} N`);
  assert(ticks.some(({ tap_n }) => Math.abs(tap_n) > 0.01), "putting the pen down taps");
  const peak = await page.evaluate(() => window.studioCheck.peak);
  assert(peak > 1e-4 && peak <= 0.51, `the first sound peaks at ${(20 * Math.log10(peak)).toFixed(0)} dB of full scale, −6 at most`);
  assert((await page.textContent("#force-source")).includes("pressure"), "the page says that force comes from the pressure");
}

async function keyboard(visit) {
  const { page } = visit;
  await page.focus("#prompt");
  let tabs = 0;
  while (tabs < 12 && (await page.evaluate(() => document.activeElement.id)) !== "stage") {
    await page.keyboard.press("Tab");
    tabs++;
  }
  assert(tabs < 12, `the surface is ${tabs} tabs from the prompt`);
  const outlined = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle !== "none");
  assert(outlined, "its focus is visible");
  await visit.take();
  await page.keyboard.down("ArrowRight");
  await page.waitForTimeout(500);
  await page.keyboard.up("ArrowRight");
  await page.waitForTimeout(200);
  const stroke = (await visit.take()).filter(({ speed_mm_s, depth_mm }) => depth_mm > 0 && speed_mm_s > 80);
  assert(stroke.length > 3000, "an arrow strokes");
  await page.keyboard.press(" ", { delay: 150 });
  await page.waitForTimeout(250);
  const taps = await visit.take();
  assert(taps.some(({ tap_n }) => Math.abs(tap_n) > 0.01) && taps.every(({ speed_mm_s }) => speed_mm_s < 5), "Space taps");
  const before = await page.getAttribute("#scale", "data-text");
  for (let n = 0; n < 6; n++) await page.keyboard.press("+");
  const finer = await page.getAttribute("#scale", "data-text");
  assert(finer !== before, `+ zooms: ${before}, then ${finer}`);
  await page.keyboard.press("0");
  assert((await page.getAttribute("#scale", "data-text")) === before, "0 resets the zoom");

  const title = () => page.textContent("#surface-title");
  const was = await title();
  await page.focus(".material");
  const began = Date.now();
  await page.keyboard.press("Enter");
  await page.waitForFunction((name) => document.getElementById("surface-title").textContent !== name, was);
  assert((await title()) !== was, `a nearest material is compiled by a key: ${await title()}`);
  await page.waitForFunction(() => window.studioCheck.statuses.some(({ about, name }) => about === "swap" && name === "ok"));
  assert(true, `what plays is cross-faded to it, after ${Date.now() - began} ms`);
  await page.focus("#prompt");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("ArrowUp");
  assert((await page.inputValue("#prompt")) === PROMPT, "↑ brings back the earlier prompt");
  await page.focus("#theme");
  const themes = [];
  for (let n = 0; n < 3; n++) {
    await page.keyboard.press("Enter");
    themes.push(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
  }
  assert(themes[0] !== themes[1] && themes[2] === themes[0], "keys switch the theme to light, dark and the system's");
}

async function selfMoving(visit) {
  const { page } = visit;
  await visit.take();
  await page.focus("#auto");
  await page.keyboard.press("Enter");
  const frames = await page.evaluate(() => new Promise((done) => {
    const [began, all] = [performance.now(), []];
    const next = (now) => (now < began + 900 ? requestAnimationFrame(next, all.push(now)) : done(all.length / 0.9));
    requestAnimationFrame(next);
  }));
  await page.waitForTimeout(100);
  const circle = (await visit.take()).filter(({ speed_mm_s }) => speed_mm_s > 50);
  assert(circle.length > 6000, `a hand moves by itself, at ${frames.toFixed(0)} frames a second`);
  const force_n = circle.reduce((sum, tick) => sum + tick.normal_force_n, 0) / circle.length;
  assert(near(force_n, SLIDER_N, 0.08), `with the force of the slider: ${force_n.toFixed(2)} N`);
  await page.waitForFunction(() => Number(document.querySelector("#readout [data-name=friction] .value").textContent) > 0);
  assert(true, "the readout has its friction");
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.waitForTimeout(100);
  assert(await page.isHidden("#contact"), "with reduced motion its mark does not move about");
  await page.emulateMedia({ reducedMotion: "no-preference" });
  await page.keyboard.press("Enter");
  await page.waitForTimeout(200);
  await visit.take();
  await page.waitForTimeout(300);
  assert((await visit.take()).every(({ depth_mm }) => depth_mm <= 0), "and is lifted when it is stopped");
}

/** What gives way is followed down until it bears the force; the touch that starts the sound is felt. */
async function givesWay(browser) {
  const visit = await Visit.begin(browser, address);
  const { page } = visit;
  await visit.compile("memory foam");
  const { x, y, width, height } = await page.locator("#stage").boundingBox();
  const before = await page.screenshot({ clip: { x, y, width, height } });
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.waitForTimeout(4000);
  const { depth_mm, normal_force_n } = (await visit.take()).at(-1);
  assert(depth_mm > 10 && near(normal_force_n, SLIDER_N, 0.05),
    `foam gives way by ${depth_mm.toFixed(1)} mm under ${normal_force_n.toFixed(2)} N`);
  assert(!before.equals(await page.screenshot({ clip: { x, y, width, height } })), "and is seen to");
  await page.mouse.up();
  await visit.end();
}

/** Ribs have an arrow on the page, and strokes along them are quieter. */
async function hasAxis(browser) {
  const visit = await Visit.begin(browser, address);
  const { page } = visit;
  await visit.compile("brushed stainless steel");
  const said = await page.textContent("#axis");
  assert(said.startsWith("↕ along −"), `brush marks have an arrow: ${said}`);
  const { x, y, width, height } = await page.locator("#stage").boundingBox();
  const side = 0.3 * Math.min(width, height);
  const loudness = async (right, down) => {
    await page.mouse.move(x + width / 2 - side * right, y + height / 2 - side * down);
    await page.mouse.down();
    await visit.take();
    for (let step = 0; step < 126; step++) {
      const way = Math.sin(step / 10);
      await page.mouse.move(x + width / 2 + side * right * way, y + height / 2 + side * down * way);
      await page.waitForTimeout(8);
    }
    const ticks = (await visit.take()).filter(({ depth_mm, speed_mm_s }) => depth_mm > 0 && speed_mm_s > 20);
    await page.mouse.up();
    const relative = ticks.reduce((sum, { vib_m_s2, speed_mm_s }) => sum + (vib_m_s2 / speed_mm_s) ** 2, 0);
    return 10 * Math.log10(relative / ticks.length);
  };
  const [across_db, along_db] = [await loudness(1, 0), await loudness(0, 1)];
  assert(across_db > along_db + 2, `strokes along them are quieter by ${(across_db - along_db).toFixed(1)} dB`);
  await visit.compile("smooth polished glass");
  assert((await page.$("#axis")) === null, "glass has no axis");
  await visit.end();
}

async function fingers(visit) {
  const { page } = visit;
  const before = await page.getAttribute("#scale", "data-text");
  await visit.pinch(60, 260);
  assert((await page.getAttribute("#scale", "data-text")) !== before, "two fingers zoom");
  await page.click("#zoom-reset");
  await visit.take();
  await visit.fingerStroke();
  assert((await visit.take()).some(({ depth_mm, speed_mm_s }) => depth_mm > 0 && speed_mm_s > 20), "one finger strokes");
}

async function markup(visit) {
  const { page } = visit;
  const prompt = "<img src=x onerror=alert(1)> <b>cork</b>";
  await visit.compile(prompt);
  const found = await page.evaluate(() => document.querySelectorAll("main img[src=x], main b, [onerror]").length);
  assert(found === 0, "markup in a prompt stays text");
  const texts = await page.$$eval("#surface-title, #history button", (all) => all.map(({ textContent }) => textContent));
  assert(texts[0].includes("<img") && texts[1] === prompt, "and is shown as it is");
}

/** The limiter by itself, in an OfflineAudioContext. */
async function limiter(visit) {
  const [most, late] = await visit.page.evaluate(async () => {
    const ceiling = 0.8;
    const run = async (sample) => {
      const context = new OfflineAudioContext(1, 48000, 48000);
      await context.audioWorklet.addModule(new URL("limiter.js", document.baseURI));
      const input = Float32Array.from({ length: 48000 }, (_, n) => sample(n));
      const buffer = new AudioBuffer({ length: 48000, sampleRate: 48000 });
      buffer.copyToChannel(input, 0);
      const source = new AudioBufferSourceNode(context, { buffer });
      const node = new AudioWorkletNode(context, "limiter", { outputChannelCount: [1], processorOptions: { ceiling } });
      source.connect(node).connect(context.destination);
      source.start();
      return { input, output: (await context.startRendering()).getChannelData(0) };
    };
    // Clicks, bursts and a hum, a hundred times too loud.
    const loud = await run((n) => (n % 997 === 0 ? 80 : n % 6000 < 900 ? 5 * Math.sin(n * n) : 0.9 * Math.sin(n / 90)));
    const soft = await run((n) => 0.79 * Math.sin(n * 0.37));
    const late = [...Array(100).keys()].find((by) => soft.output.subarray(by).every((x, n) => x === soft.input[n]));
    return [loud.output.reduce((most, x) => Math.max(most, Math.abs(x)), 0) / ceiling, late];
  });
  assert(most <= 1 + 1e-6 && most > 0.9, `the limiter lets ${(100 * most).toFixed(1)} % of its ceiling through`);
  assert(late === 47, `and changes nothing below it but the time, by ${late} frames`);
}

/** The choice of the device, with those that Chromium imitates. */
async function devices(browser) {
  const visit = await Visit.begin(browser, address, (context) => context.grantPermissions(["microphone"]));
  const { page } = visit;
  const names = () => page.$$eval("#device option", (all) => all.map(({ textContent }) => textContent));
  // Until the devices are listed, nobody knows whether they have to be found.
  await page.waitForFunction(() => document.querySelector("#device option"));
  if (await page.isVisible("#find-devices")) await page.click("#find-devices");
  await page.waitForFunction(() => document.querySelectorAll("#device option").length > 1);
  assert((await names())[0] === "System default", `sound devices are listed: ${(await names()).join(", ")}`);
  await visit.compile("cork");
  await page.click("#sound-switch");
  await page.waitForFunction(() => window.studioCheck.contexts.at(-1)?.state === "running");
  await page.selectOption("#device", { index: 1 });
  await page.waitForFunction(() => window.studioCheck.contexts.at(-1).sinkId === document.getElementById("device").value);
  assert(true, "the chosen one plays");
  await page.evaluate(() => {
    navigator.mediaDevices.enumerateDevices = async () => [];
    navigator.mediaDevices.dispatchEvent(new Event("devicechange"));
  });
  await page.waitForSelector("[data-key=device]");
  assert((await page.evaluate(() => window.studioCheck.contexts.at(-1).sinkId)) === "", "where it is unplugged, that is said and the default plays");
  await visit.end();
}

/** What goes wrong is said, with its remedy. The browser logs some of these itself. */
async function failures(browser) {
  const visit = await Visit.begin(browser, address);
  const { page } = visit;
  await visit.compile("cork");
  await visit.penStroke({ pressure: () => 0.5, seconds: 1.6, px_s: 300 });
  assert((await page.textContent("#notices")).includes("no changing pressure"), "a pen that always says 0.5 is found out");
  const forces = (await visit.take()).filter(({ depth_mm, speed_mm_s }) => depth_mm > 0 && speed_mm_s > 40);
  const force_n = forces.reduce((sum, tick) => sum + tick.normal_force_n, 0) / forces.length;
  assert(near(force_n, SLIDER_N, 0.1), `and presses by the slider: ${force_n.toFixed(2)} N`);

  await page.evaluate(() => window.studioCheck.contexts.at(-1).suspend());
  await page.click("[data-key=sound] button");
  await page.waitForFunction(() => window.studioCheck.contexts.at(-1).state === "running");
  assert((await page.$$("[data-key=sound]")).length === 0, "a sound that the browser paused is said and resumed");

  await visit.penStroke({ pressure: (t) => 0.3 + 0.1 * Math.sin(9 * t), seconds: 0.3, px_s: 300 });
  assert((await page.$$("[data-key=pen]")).length === 0, "the notice goes when its pressure changes");

  await visit.context.setOffline(true);
  await page.waitForSelector("[data-key=server]", { timeout: 9000 });
  assert(true, "a server that is gone is noticed where nothing is asked of it");
  await visit.context.setOffline(false);
  await page.waitForSelector("[data-key=server]", { state: "detached", timeout: 9000 });
  process.kill(studio, "SIGSTOP");
  await page.fill("#prompt", "wet ice");
  await page.press("#prompt", "Enter");
  await page.waitForFunction((text) => document.getElementById("compile").textContent === text, "Cancel");
  await page.click("#compile");
  assert((await page.getAttribute("#prompt-form", "aria-busy")) === "false", "a prompt that takes long can be given up");
  await page.waitForSelector("[data-key=server]", { timeout: 20000 });
  assert(true, "a server that hangs is noticed");
  process.kill(studio, "SIGCONT");
  await page.waitForSelector("[data-key=server]", { state: "detached", timeout: 20000 });

  await visit.context.setOffline(true);
  await page.fill("#prompt", "wet ice");
  await page.press("#prompt", "Enter");
  await page.waitForSelector("[data-key=server]");
  assert((await page.textContent("[data-key=server]")).includes("asperity studio"), "a server that is gone is said");
  assert((await page.textContent("#surface-title")) === "cork", "what was loaded stays");
  await visit.context.setOffline(false);
  await page.waitForFunction(() => document.getElementById("surface-title").textContent === "wet ice", null, { timeout: 8000 });
  assert((await page.$$("[data-key=server]")).length === 0, "and the prompt is tried again until it is back");
  await visit.end();

  const other = await Visit.begin(browser, address, async (context) => {
    await context.route("**/asperity.wasm", (route) => route.fulfill({ contentType: "application/wasm", body: "no module" }));
    await context.route("**/api/compile", (route) => (route.request().postDataJSON().prompt === "refused"
      ? route.fulfill({ status: 400, json: { error: "the prompt <i>is</i> refused", help: "write another" } })
      : route.continue()));
  });
  await other.page.fill("#prompt", "refused");
  await other.page.press("#prompt", "Enter");
  await other.page.waitForSelector("#prompt-error p");
  const said = await other.page.innerText("#prompt-error");
  assert(said.includes("<i>is</i> refused") && said.includes("write another"), "a refusal is shown with its help, as text");
  await other.compile("cork");
  await other.page.click("#sound-switch");
  await other.page.waitForSelector("[data-key=sound]");
  assert((await other.page.textContent("[data-key=sound]")).includes("Restart"), "a renderer that fails is said, with a restart");
  await other.end();
}

const work = mkdtempSync(join(tmpdir(), "studio-"));
const began = Date.now();
const browser = await chromium.launch({ executablePath, args: ["--autoplay-policy=no-user-gesture-required", "--no-sandbox",
  "--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream"] });
try {
  console.log(`${browser.browserType().name()} ${browser.version()}`);
  const visit = await Visit.begin(browser, address);
  await visit.page.evaluate(axe);
  await clean(visit.page, assert, "as it begins", "light");
  await prompts(visit);
  await pen(visit);
  if (process.env.ASPERITY) {
    const played = firstSession(visit.chunks);
    const difference = sameAsCommand(process.env.ASPERITY, work, await visit.asset(), played);
    assert(difference === null, difference ?? `${played.flags.length} ticks have the bits of asperity render`);
  }
  for (const colorScheme of ["light", "dark"]) {
    await visit.page.emulateMedia({ colorScheme });
    await readable(visit.page, assert, `while it sounds, ${colorScheme}`);
  }
  await visit.page.emulateMedia({ colorScheme: "light" });
  await keyboard(visit);
  await selfMoving(visit);
  await fingers(visit);
  await markup(visit);
  await limiter(visit);
  await output(visit, { assert, asperity: process.env.ASPERITY, work });
  await visit.compile("ruff sandpapr with very high grit, and quantum");
  for (const scheme of ["light", "dark"]) await clean(visit.page, assert, "with a texture", scheme);
  assert(visit.foreign.length === 0, `${visit.requests} requests, none to another address`);
  assert(visit.errors.length === 0, `no error on the console${visit.errors.map((text) => `: ${text}`).join("")}`);
  await visit.end();
  const checks = process.env.ASPERITY ? [files, gallery, steer] : [];
  for (const check of checks) {
    const other = await Visit.begin(browser, address);
    await other.page.evaluate(axe);
    await check(other, { assert, asperity: process.env.ASPERITY, work });
    assert(other.errors.length === 0 && other.foreign.length === 0, `no error on the console${other.errors.map((text) => `: ${text}`).join("")}`);
    await other.end();
  }
  await devices(browser);
  await givesWay(browser);
  await hasAxis(browser);
  await failures(browser);
  console.log(`${count} assertions in ${((Date.now() - began) / 1000).toFixed(0)} s`);
} finally {
  await browser.close();
  rmSync(work, { recursive: true });
}
