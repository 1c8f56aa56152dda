// A designer's first five minutes: sound within 2 s of the page, ten clicks to a library of three edited textures, which is
// still there tomorrow.
//
//   STUDIO_MODULES=…/node_modules ASPERITY=… node designer.mjs CHROMIUM
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { downloaded, run } from "./aid.mjs";
import { assert, chromium } from "./chromium.mjs";
import { serve } from "./served.mjs";
import { after, bytesOf, written } from "./steering.mjs";

const [executablePath] = process.argv.slice(2);
const [asperity, work] = [process.env.ASPERITY, mkdtempSync(join(tmpdir(), "designer-"))];
/** Others may keep the machine busy: of so many beginnings, one has to be quick. */
const BEGINNINGS = 3;
/** As browsers are: no sound before a click. */
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, acceptDownloads: true });
const page = await context.newPage();
let [studio, elsewhere] = [];
let clicks = 0;
let project;
const click = (selector, options) => {
  clicks++;
  return page.click(selector, options);
};

try {
  let seconds = Infinity;
  for (let n = 0; n < BEGINNINGS && seconds >= 2; n++) {
    await studio?.end();
    project = ["--no-open", "--project", join(work, `desk-${n}`)];
    studio = await serve(work, project);
    await page.goto(studio.address);
    const opened = Date.now();
    clicks = 0;
    await click("#stage");
    await page.waitForFunction(() => Number(document.getElementById("meter").getAttribute("aria-valuenow")) > -50);
    seconds = (Date.now() - opened) / 1000;
  }
  assert(seconds < 2, `sound is heard ${seconds.toFixed(1)} s after the page has opened`);

  const commands = [];
  for (const [prompt, slider] of [["wet ice", "rough"], ["cork board", "hard"], ["soft velvet", "slippery"]]) {
    await page.fill("#prompt", prompt);
    await after(page, () => page.press("#prompt", "Enter"), ({ told }) => told.includes(prompt));
    const { width, height } = await page.locator(`#slider-${slider}`).boundingBox();
    const { command } = await after(page, () => click(`#slider-${slider}`, { position: { x: 0.45 * width, y: height / 2 } }), ({ command }, was) => command !== was.command);
    commands.push(command);
    await click("#keep");
  }
  await page.fill(".kept li:first-child .kept-note", "for the throne");
  const { bytes } = await downloaded(page, () => click("#pack"));
  assert(clicks <= 10, `${clicks} clicks lead to a library of three edited textures`);
  const names = ["wet ice", "cork board", "soft velvet"];
  commands.forEach((command, n) => writeFileSync(join(work, `${n}.asp`), written({ asperity, work }, command, `made-${n}`, {})));
  writeFileSync(join(work, "three.csv"), `name,asset\n${names.map((name, n) => `${name},${n}.asp\n`).join("")}`);
  run(asperity, work, "build", "three.csv", "-o", "three.aspl", "--no-cache", "--quiet");
  assert(bytes.equals(readFileSync(join(work, "three.aspl"))), "it has the bytes of the commands below the surface");

  await page.waitForTimeout(300);
  await studio.end("SIGKILL");
  studio = await serve(work, project);
  await page.goto(studio.address);
  await page.waitForFunction(() => document.querySelectorAll(".kept li").length === 3);
  assert((await page.$$eval(".kept-name", (all) => all.map(({ value }) => value))).join() === [...names].reverse().join()
    && (await page.inputValue(".kept li:first-child .kept-note")) === "for the throne", "tomorrow it is still there, with its note");
  const again = await downloaded(page, () => page.click("#pack"));
  assert(again.bytes.equals(bytes), "to the byte");

  // Its last texture goes to somebody else as a link.
  await page.click("#take-button");
  const link = await page.textContent(".link-row code");
  await page.keyboard.press("Escape");
  elsewhere = await serve(work, ["--no-open", "--project", join(work, "elsewhere")]);
  const theirs = await context.newPage();
  await theirs.goto(elsewhere.address + link);
  const here = await after(theirs, async () => {}, ({ told }) => told.includes("soft velvet"));
  assert((await bytesOf(theirs, here.id)).equals(readFileSync(join(work, "2.asp"))) && here.command === commands[2], `a link of ${link.length} letters makes the same bytes elsewhere`);
  assert(here.told.includes("slippery") && (await theirs.evaluate(() => location.hash)) === "", "as an edit that goes on, and the address is the page's again");
  await theirs.evaluate((text) => dispatchEvent(Object.assign(new Event("paste"), { clipboardData: { getData: () => text } })), "#recipe=bm90aGluZw");
  await theirs.waitForSelector("[data-key=link]");
  assert((await theirs.textContent("[data-key=link]")).includes("holds no recipe"), "one that was cut short is refused");

  // A second tab goes on, and the first one says so.
  const other = await context.newPage();
  await other.goto(studio.address);
  await other.waitForFunction(() => document.querySelectorAll(".kept li").length === 3);
  await page.fill(".kept li:first-child .kept-note", "for nobody");
  await page.keyboard.press("Tab");
  await page.waitForSelector("[data-key=project]");
  assert((await page.textContent("[data-key=project]")).includes("another tab"), "a project in two tabs is written by the one that was opened last");
  await other.fill(".kept li:first-child .kept-note", "for the queen");
  await other.keyboard.press("Tab");
  await page.click("[data-key=project] button >> text=Reload");
  await page.waitForFunction(() => document.querySelector(".kept-note")?.value === "for the queen");
  assert(true, "and nothing of it is lost");
} finally {
  await browser.close();
  for (const each of [studio, elsewhere]) await each?.end();
  rmSync(work, { recursive: true, force: true });
}
