// The gallery of a library of 1,000 textures: scrolled, searched, ordered, filtered, and picked from in every way.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { clean, downloaded, run, shown } from "./aid.mjs";
import { several } from "./own.mjs";

const COUNT = 1000;
const KINDS = ["cork", "wet ice", "brushed steel", "soft velvet", "coarse sandpaper", "oak board", "smooth glass", "thick carpet", "Käsepapier", "rough brick"];
/** Cells that the document may have, whatever the library. */
const MOST_CELLS = 60;

/** Two libraries: `many.aspl`, and a `later.aspl` with one texture more, one less, and one that changed. */
function libraries(asperity, folder) {
  const table = (name, rows) => writeFileSync(join(folder, name), rows.map((row) => `${row.join(",")}\n`).join(""));
  table("kinds.csv", [["name", "prompt"], ...KINDS.map((kind) => [kind, kind === "Käsepapier" ? "waxy paper" : kind])]);
  run(asperity, folder, "build", "kinds.csv", "-o", "kinds.aspl", "--no-preview", "--no-cache", "--quiet");
  const rows = Array.from({ length: COUNT }, (_, n) => [`${KINDS[n % KINDS.length]} ${n}`, `kinds.aspl#${KINDS[n % KINDS.length]}`]);
  const build = (name, rows) => {
    table(`${name}.csv`, [["name", "asset"], ...rows]);
    run(asperity, folder, "build", `${name}.csv`, "-o", `${name}.aspl`, "--no-preview", "--no-cache", "--quiet");
  };
  build("many", rows);
  build("later", [["wet ice 1", "kinds.aspl#cork"], ...rows.slice(2), ["new felt", "kinds.aspl#thick carpet"]]);
}

const cells = (page) => page.$$eval(".cell", (all) => all.map(({ title }) => title.split("\n")[0]));
const counted = (page) => page.textContent(".tools [role=status]");

/** Waits until the list has changed to what holds. */
const until = (page, holds, argument) => page.waitForFunction(holds, argument, { timeout: 20000 });

async function scrolled({ page }, assert) {
  const found = await page.evaluate(async () => {
    const list = document.querySelector(".cells");
    let most = 0;
    const frames = [];
    const [began, to] = [performance.now(), list.scrollHeight - list.clientHeight];
    for (let now = began; now < began + 1000; now = await new Promise(requestAnimationFrame)) {
      frames.push(now);
      list.scrollTop = (to * (now - began)) / 1000;
      most = Math.max(most, document.querySelectorAll(".cell").length);
    }
    list.scrollTop = to;
    return { most, frames: frames.length };
  });
  assert(found.most <= MOST_CELLS, `scrolled from end to end at ${found.frames} frames a second, the document has ${found.most} cells at most`);
  await until(page, (count) => [...document.querySelectorAll(".cell")].some((cell) => cell.getAttribute("aria-posinset") === String(count)), COUNT);
  await until(page, () => document.querySelector(".cell:last-child img").dataset.state === "loaded");
  assert(true, "the last one is there, with its picture");
  const top = () => page.$eval(".cells", ({ scrollTop }) => scrollTop);
  const before = await top();
  await page.click("#views label:nth-child(1)");
  assert(await page.isVisible("#prompt"), "the prompt is a click away");
  await page.click("#views label:nth-child(2)");
  await page.waitForSelector(".cell");
  await page.waitForTimeout(100);
  assert((await top()) === before, "and the gallery comes back where it was");
}

async function searched({ page }, assert) {
  await page.fill("#gallery-search", "KASE 8");
  await until(page, () => document.querySelector(".tools [role=status]").textContent.includes(" of "));
  const names = await cells(page);
  assert(names.length > 10 && names.every((name) => name.startsWith("Käsepapier") && name.includes("8")), `“KASE 8” finds ${names[0]} and others`);
  await page.fill("#gallery-search", "waxy");
  await until(page, () => document.querySelector(".tools [role=status]").textContent.startsWith("100 of"));
  assert(true, "prompts are searched too");
  await page.fill("#gallery-search", "no such thing");
  await page.waitForSelector(".shelf .none:not([hidden])");
  await page.click(".shelf .none button");
  assert((await counted(page)) === "1,000 textures", "what finds nothing says so, with the way back");
}

async function ordered({ page }, assert, table) {
  await page.selectOption("#gallery-order", "rough falling");
  const wanted = [...table].sort((a, b) => b.attributes.rough_db - a.attributes.rough_db);
  await until(page, (name) => document.querySelector('.cell[data-index="0"]')?.title.startsWith(name), wanted[0].name);
  const names = await cells(page);
  const rough = new Map(table.map(({ name, attributes }) => [name, attributes.rough_db]));
  assert(names.every((name, n) => n === 0 || rough.get(name) <= rough.get(names[n - 1])), `the roughest come first: ${names[0]}`);
  await page.click(".ranges summary");
  const [low, high] = [Math.min(...rough.values()), Math.max(...rough.values())];
  await page.locator(".ranges .span >> nth=0").locator(".least").fill("60");
  const least = low + (high - low) * 0.6;
  const kept = table.filter(({ attributes }) => attributes.rough_db >= least).length;
  await until(page, (count) => document.querySelector(".tools [role=status]").textContent.startsWith(`${count} of`), kept);
  assert(true, `a range keeps ${kept} of ${COUNT}`);
  await clean(page, assert, "in the gallery", "dark");
  await page.click(".ranges button");
  await page.selectOption("#gallery-order", "library");
  await page.click(".ranges summary");
}

/** What is on the surface has the bytes of `asperity extract`. */
async function extracted({ page }, { assert, asperity, folder }, library, name) {
  await shown(page, name);
  await page.click("#take-button");
  const { bytes } = await downloaded(page, () => page.click('.kind[data-ending="asp"]'));
  await page.keyboard.press("Escape");
  run(asperity, folder, "extract", library, name, "-o", "one.asp", "--quiet");
  assert(bytes.equals(readFileSync(join(folder, "one.asp"))), `“${name}” has the bytes of asperity extract`);
}

async function picked(visit, tools, names) {
  const { page } = visit;
  const { assert } = tools;
  await until(page, () => document.querySelector('.cell[data-index="3"]'));
  await page.click('.cell[data-index="3"]');
  await extracted(visit, tools, "many.aspl", names[3]);
  assert((await page.getAttribute('.cell[data-index="3"]', "aria-selected")) === "true", "it is marked");
  await page.focus(".cells");
  const columns = await page.$$eval(".cell", (all) => all.filter(({ style }) => style.transform.includes(" 0px)")).length);
  await page.keyboard.press("ArrowDown");
  await shown(page, names[3 + columns]);
  assert(true, "the arrow keys play what they reach");
  await page.uncheck("#gallery-follow");
  await page.focus(".cells");
  await page.keyboard.press("End");
  await page.waitForTimeout(300);
  assert((await page.textContent("#surface-title")) === names[3 + columns], "unless they are told not to");
  await page.keyboard.press("Enter");
  await extracted(visit, tools, "many.aspl", names[COUNT - 1]);
}

async function scattered(visit, tools) {
  const { page } = visit;
  const { assert } = tools;
  await page.click(".modes label:nth-child(2)");
  const canvas = page.locator(".plot-canvas-scatter");
  await canvas.focus();
  const reached = () => document.querySelector(".scatter .plot-readout").textContent !== "";
  // Before its first frame a key finds no point.
  for (let n = 0; n < 50 && !(await page.evaluate(reached)); n++) {
    await page.keyboard.press("ArrowLeft");
    await page.waitForTimeout(100);
  }
  await until(page, reached);
  const said = (await page.textContent("#announcement")).split(", ")[0];
  await page.keyboard.press("Enter");
  await extracted(visit, tools, "many.aspl", said);
  const box = await canvas.boundingBox();
  let name = null;
  // A point where nobody has been yet.
  for (let n = 0; n < 400 && !name; n++) {
    const [x, y] = [box.x + box.width * (0.1 + 0.8 * ((n * 0.618) % 1)), box.y + box.height * (0.1 + (0.7 * n) / 400)];
    await page.mouse.move(x, y);
    if (!(await canvas.evaluate(({ classList }) => classList.contains("hits")))) continue;
    await page.mouse.click(x, y);
    name = await page.waitForFunction((before) => {
      const now = document.getElementById("surface-title").textContent;
      return now !== before && now;
    }, said, { timeout: 1000 }).then((handle) => handle.jsonValue()).catch(() => null);
  }
  assert(name !== null, "a point of the scatter is clicked");
  await extracted(visit, tools, "many.aspl", name);
  await page.locator(".scatter select >> nth=0").selectOption("sharp");
  await page.locator(".scatter select >> nth=1").selectOption("slippery");
  await page.waitForTimeout(100);
  await clean(page, assert, "with the scatter", "light");
}

async function compared(visit, tools) {
  const { page } = visit;
  const { assert } = tools;
  await page.setInputFiles("#open-files", join(tools.folder, "later.aspl"));
  await page.waitForSelector("#gallery-library:not([hidden])");
  await page.click(".modes label:nth-child(3)");
  await page.waitForSelector(".found h3");
  const titles = await page.$$eval(".found h3", (all) => all.map(({ textContent }) => textContent));
  assert(titles.join() === "Changed (1),Added (1),Removed (1)", `two libraries differ: ${titles.join(", ")}`);
  await clean(page, assert, "with differences", "dark");
  await page.click(".changed button:last-child");
  await extracted(visit, tools, "later.aspl", "wet ice 1");
  await page.click(".found ul:last-child button");
  await extracted(visit, tools, "many.aspl", "cork 0");
}

export async function gallery(visit, { assert, asperity, work }) {
  const { page } = visit;
  const folder = join(work, "gallery");
  mkdirSync(folder);
  libraries(asperity, folder);
  const table = JSON.parse(run(asperity, folder, "list", "many.aspl", "--json")).textures;
  await page.click("#views label:nth-child(2)");
  assert((await page.textContent(".start")).includes("asperity studio library.aspl"), "without a library, the gallery says how to get one");
  await clean(page, assert, "without a library", "light");
  await page.setInputFiles("#open-files", join(folder, "many.aspl"));
  await page.waitForSelector(".cell");
  assert((await counted(page)) === "1,000 textures", "a library of 1,000 textures is opened");
  await scrolled(visit, assert);
  await searched(visit, assert);
  await ordered(visit, assert, table);
  await picked(visit, { assert, asperity, folder }, table.map(({ name }) => name));
  await several(visit, { assert });
  await scattered(visit, { assert, asperity, folder });
  await compared(visit, { assert, asperity, folder });
}
