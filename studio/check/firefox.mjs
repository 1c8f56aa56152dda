// The studio's page in a stock Firefox: it begins, compiles, sounds, edits, undoes, shows a gallery, gives files, and comes
// back after it is loaded again. The other checks of the page use Chromium.
//
//   STUDIO_MODULES=…/node_modules ASPERITY=… node firefox.mjs FIREFOX
//
// STUDIO_MODULES has puppeteer-core beside what the others need. Firefox keeps a page's sound waiting where the machine has no
// device for it: with pulseaudio installed it is given one that plays into nothing, and without, its sound is skipped.
import { spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { run } from "./aid.mjs";
import { assert, count } from "./chromium.mjs";
import { library, serve } from "./served.mjs";
import { written } from "./steering.mjs";

const { default: puppeteer } = createRequire(join(resolve(process.env.STUDIO_MODULES), "/"))("puppeteer-core");
const [executablePath] = process.argv.slice(2);
const asperity = process.env.ASPERITY;
const PROMPT = "rough abrasive sheet with gritty particles";
/** Time for anything that is waited for, ms. */
const PATIENCE_MS = 15000;

const began = Date.now();
const work = mkdtempSync(join(tmpdir(), "firefox-"));
const downloads = join(work, "downloads");
mkdirSync(downloads);
const { file, names } = library(work);
const { address, end } = await serve(work, [file, "--no-open"]);
const own = { ...process.env, HOME: work, XDG_RUNTIME_DIR: work };
const device = spawn("pulseaudio", ["-n", "--daemonize=no", "--exit-idle-time=-1", "-L", "module-native-protocol-unix", "-L", "module-null-sink rate=48000"],
  { env: own, stdio: "ignore" });
const hasDevice = await new Promise((done) => {
  device.on("error", () => done(false));
  device.on("exit", () => done(false));
  const look = setInterval(() => existsSync(join(work, "pulse", "native")) && done(true, clearInterval(look)), 50);
  setTimeout(() => done(false, clearInterval(look)), 3000);
});
const browser = await puppeteer.launch({ browser: "firefox", executablePath, headless: true, env: own, extraPrefsFirefox: {
  "media.autoplay.default": 0, "browser.download.folderList": 2, "browser.download.dir": downloads,
  "browser.download.useDownloadDir": true, "browser.download.alwaysOpenPanel": false } });

const page = await browser.newPage();
const errors = [];
page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
page.on("pageerror", (error) => errors.push(error.stack || String(error)));

/** Waits until something holds in the page; `what` is said where it does not. */
const until = (what, holds, ...given) => page.waitForFunction(holds, { timeout: PATIENCE_MS, polling: 50 }, ...given)
  .catch(() => { throw new Error(`does not hold in time: ${what}; the console has ${errors.join("; ") || "no error"}`); });
const text = (selector) => page.$eval(selector, (at) => at.textContent);
const title = (name) => until(`the surface has the name ${name}`, (name) => document.getElementById("surface-title").textContent === name, name);
const current = () => page.$eval("#timeline .tile[aria-current]", ({ dataset }) => dataset.texture);
const told = () => text("#timeline .told");
/** Does something, and waits until the session says something else. */
async function after(what, act) {
  const before = await told();
  await act();
  await until(what, (before) => document.querySelector("#timeline .told").textContent !== before, before);
  return current();
}

const begin = () => until("the page begins", () => document.querySelector(".loaded") && document.getElementById("edition").textContent !== "");

async function wide() {
  for (const [width, height] of [[1280, 720], [360, 740]]) {
    await page.setViewport({ width, height });
    await new Promise((done) => setTimeout(done, 300));
    assert(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `nothing is cut off at the side, ${width} px`);
  }
  await page.setViewport({ width: 1280, height: 800 });
}

async function sounds() {
  if (!hasDevice) return console.log("SKIPPED: the sound in Firefox: there is no sound device, and no pulseaudio to imitate one");
  const isPressed = (selector) => page.$eval(selector, (button) => button.getAttribute("aria-pressed") === "true");
  if (!(await isPressed("#sound-switch"))) await page.click("#sound-switch");
  await until("the sound is on", () => document.getElementById("sound-switch").getAttribute("aria-pressed") === "true");
  assert((await page.$$("[data-key=sound]")).length === 0, "the sound's worklet starts");
  if (!(await isPressed("#auto"))) await page.click("#auto");
  await until("the meter leaves silence", () => Number(document.getElementById("meter").getAttribute("aria-valuenow")) > -60);
  assert(true, `a hand in motion is heard: ${await text("#meter-text")}`);
  await until("the readout has friction", () => Number(document.querySelector("#readout [data-name=friction] .value").textContent) > 0);
  assert(true, "and the readout has its friction");
}

/** The file that the page gives as its own. */
async function taken(name) {
  await page.click("#take-button");
  await page.click('.kind[data-ending="asp"]');
  const file = join(downloads, name);
  // An empty file keeps the place of one that is being written.
  for (const from = Date.now(); existsSync(`${file}.part`) || !statSync(file, { throwIfNoEntry: false })?.size;) {
    if (Date.now() - from > PATIENCE_MS) throw new Error(`no file ${name} is given`);
    await new Promise((done) => setTimeout(done, 50));
  }
  await page.keyboard.press("Escape");
  return readFileSync(file);
}

try {
  console.log(await browser.version());
  await page.setViewport({ width: 1280, height: 800 });
  await page.goto(address);
  await begin();
  await page.waitForSelector(".cell img[data-state=loaded]");
  assert((await text(".tools [role=status]")).includes("textures"), "the gallery shows a library");
  const name = names[3];
  await page.click('.cell[data-index="3"]');
  await title(name);
  run(asperity, work, "extract", file, name, "-o", "picked.asp", "--quiet");
  assert((await taken(`${name}.asp`)).equals(readFileSync(join(work, "picked.asp"))), `“${name}” is picked, and its file has the bytes of asperity extract`);

  await page.click("#views label:first-child");
  // Typed letter by letter, suggestions would come between.
  await page.$eval("#prompt", (input, text) => (input.value = text), PROMPT);
  await page.focus("#prompt");
  await page.keyboard.press("Enter");
  await title(PROMPT);
  const compiled = await current();
  assert(true, "a prompt compiles, and its name stands on the surface");
  const wanted = written({ asperity, work }, await text("#command code"), "compiled", {});
  assert((await taken(`${PROMPT}.asp`)).equals(wanted), "its file has the bytes of asperity compile");
  await sounds();

  await page.focus("#slider-rough");
  const edited = await after("a slider edits", () => page.keyboard.press("ArrowRight"));
  assert(edited !== compiled && (await told()).includes("rough +1"), "a slider makes another texture");
  const undone = await after("undo returns", async () => {
    await page.keyboard.down("Control");
    await page.keyboard.press("z");
    await page.keyboard.up("Control");
  });
  assert(undone === compiled, "undo returns to what was before");
  await wide();

  const tiles = await page.$$eval("#timeline .tile", (all) => all.map(({ dataset }) => dataset.texture));
  await new Promise((done) => setTimeout(done, 500));
  await page.reload();
  await begin();
  await title(PROMPT);
  const again = await page.$$eval("#timeline .tile", (all) => all.map(({ dataset }) => dataset.texture));
  assert(again.join() === tiles.join() && (await current()) === compiled, `loaded again, the page has its ${tiles.length} textures`);
  assert(errors.length === 0, `no error on the console${errors.map((said) => `: ${said}`).join("")}`);
  console.log(`${count} claims hold in Firefox, ${((Date.now() - began) / 1000).toFixed(0)} s`);
} finally {
  await browser.close();
  await end();
  device.kill();
  rmSync(work, { recursive: true, force: true });
}
