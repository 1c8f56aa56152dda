// A project outlives its studio: what was made, undo and slots are there again, to the byte, whatever moment it is killed at.
//
//   STUDIO_MODULES=…/node_modules ASPERITY=… node project.mjs CHROMIUM [KILLS]
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { assert, chromium } from "./chromium.mjs";
import { numbers } from "./expect.mjs";
import { serve } from "./served.mjs";
import { after, bytesOf, shown } from "./steering.mjs";
import { Visit } from "./visit.mjs";

const [executablePath, kills = "2"] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "project-"));
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--autoplay-policy=no-user-gesture-required"] });

/** A studio with the project, and a visit of its page. */
async function begin() {
  const studio = await serve(folder, ["--no-open", "--project", join(folder, "own")]);
  const visit = await Visit.begin(browser, studio.address);
  return { visit, end: async () => {
    await studio.end("SIGKILL");
    await visit.end();
  } };
}

const slots = (page) => page.$$eval("#compare .slot", (all) => all.map(({ title }) => title));
const tiles = (page) => page.$$eval("#timeline .tile", (all) => all.map(({ dataset }) => dataset.texture));

try {
  let { visit, end } = await begin();
  const { page } = visit;
  await visit.compile("cork");
  await page.click("#compare .slot >> nth=1");
  await page.focus("#slider-rough");
  await after(page, () => page.keyboard.press("ArrowRight"), ({ count }, { count: was }) => count > was);
  await visit.compile("wet ice");
  const now = await after(page, () => page.click("#timeline button >> text=Undo"));
  const was = { now, bytes: await bytesOf(page, now.id), slots: await slots(page), tiles: await tiles(page) };
  await page.waitForTimeout(300);
  await end();

  ({ visit, end } = await begin());
  await visit.page.waitForFunction((told) => document.querySelector("#timeline .told").textContent === told, was.now.told);
  const again = await shown(visit.page);
  assert(again.id === was.now.id && again.command === was.now.command && (await bytesOf(visit.page, again.id)).equals(was.bytes),
    `a studio that was killed begins where it was: ${again.told}`);
  assert((await slots(visit.page)).join() === was.slots.join() && (await tiles(visit.page)).join() === was.tiles.join(), "with its slots and its session");
  assert((await visit.page.$$(".axis input:enabled")).length === 4 && (await visit.page.textContent(".word .said")) === "cork", "its sliders and its reading");
  const redone = await after(visit.page, () => visit.page.click("#timeline button >> text=Redo"));
  assert(redone.told.includes("wet ice"), "redo goes on from there");
  await visit.page.click("#compare .slot >> nth=2");
  const first = await after(visit.page, () => visit.page.click("#timeline .tile >> nth=1"));
  assert(first.told.includes("cork") && (await visit.page.inputValue("#prompt")).length > 0, "and any texture is shown again");

  await visit.compile("felt");
  const cut = { slots: await slots(visit.page), tiles: await tiles(visit.page) };
  await visit.page.waitForTimeout(300);
  await end();
  ({ visit, end } = await begin());
  await visit.page.waitForSelector("#timeline .tile[aria-current]");
  assert(!cut.tiles.includes(redone.id) && (await slots(visit.page)).join() === cut.slots.join(), "a slot keeps what the session has no longer");
  await after(visit.page, () => visit.page.click("#compare .slot >> nth=2"), ({ told }) => told.includes("wet ice"));
  assert((await shown(visit.page)).id === redone.id, "and shows it again");

  const random = numbers(66);
  const words = ["rough", "soft", "wet", "polished", "dry"].flatMap((how) => ["oak", "steel", "felt", "slate", "wool"].map((what) => `${how} ${what}`));
  let lost = 0;
  for (let n = 0; n < Number(kills); n++) {
    const made = [];
    const stop = Date.now() + 400 + 1600 * random();
    while (Date.now() < stop) {
      const prompt = words[Math.floor(random() * words.length)];
      await visit.compile(prompt);
      made.push((await shown(visit.page)).id);
    }
    // The last one may be open still.
    await visit.page.fill("#prompt", "cracked mud");
    await visit.page.press("#prompt", "Enter");
    await new Promise((done) => setTimeout(done, 300 * random()));
    await end();
    JSON.parse(readFileSync(join(folder, "own", "project.json"), "utf8"));
    ({ visit, end } = await begin());
    await visit.page.waitForSelector("#timeline .tile[aria-current]");
    const there = await tiles(visit.page);
    lost += made.filter((id) => !there.includes(id)).length;
    if ((await visit.page.$$("[data-key=gone]")).length) lost++;
  }
  assert(lost === 0, `killed at ${kills} random moments, the project loses nothing but what was open`);
  await end();
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
