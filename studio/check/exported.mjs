// The page that `asperity studio LIBRARY --export DIR` wrote, from a server that knows nothing but files: seen, stroked,
// heard and taken away. No studio runs. Where `--compiler` gave it one, it also compiles, edits, opens and saves.
//
//   STUDIO_MODULES=…/node_modules ASPERITY=…/asperity node exported.mjs CHROMIUM LIBRARY DIR
//
// The library's second texture is called `ice`; its first one is another.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize, resolve } from "node:path";
import { clean, downloaded, drop, run, shown } from "./aid.mjs";
import { assert, axe, chromium, count } from "./chromium.mjs";
import { files } from "./files.mjs";
import { after, shown as now, written } from "./steering.mjs";
import { firstSession, sameAsCommand } from "./ticks.mjs";
import { Visit } from "./visit.mjs";

const [executablePath, ...paths] = process.argv.slice(2);
const [library, folder] = paths.map((path) => resolve(path));
const asperity = process.env.ASPERITY ?? "asperity";
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json",
  ".png": "image/png", ".svg": "image/svg+xml" };

const began = Date.now();
const work = mkdtempSync(join(tmpdir(), "exported-"));
/** A file that the server says it does not have. */
let withheld = null;
// Below a path, as on many a web server.
const server = createServer(({ url }, response) => {
  const path = normalize(decodeURIComponent(new URL(url, "http://x").pathname)).replace(/^\/a\/b\//, "");
  try {
    if (path === withheld) throw new Error("not now");
    const bytes = readFileSync(join(folder, path || "index.html"));
    response.writeHead(200, { "Content-Type": TYPES[extname(path) || ".html"] ?? "application/octet-stream" }).end(bytes);
  } catch {
    response.writeHead(404).end("nothing");
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const address = `http://127.0.0.1:${server.address().port}/a/b/`;
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--autoplay-policy=no-user-gesture-required"] });

async function textures(visit, about) {
  const { page } = visit;
  await page.waitForSelector(".cells [role=option] img[data-state=loaded]");
  assert(await page.locator(".cells [role=option]").count() === about.library.textures, "the gallery shows every texture");
  await page.click(".cells [role=option]:has-text(\"ice\")");
  await shown(page, "ice");
  await page.waitForSelector(".loaded");
  assert((await page.textContent("#command code")).startsWith("asperity extract "), "a texture is picked, and its command is shown");
  await visit.penStroke({ pressure: (t) => 0.3 + 0.2 * Math.sin(9 * t), seconds: 1, px_s: 300 });
  await visit.take();
  const played = firstSession(visit.chunks);
  const difference = sameAsCommand(asperity, work, await visit.asset(), played);
  assert(difference === null, difference ?? `${played.flags.length} ticks have the bits of asperity render`);
}

/** A page that shows, and makes nothing. */
async function filesAlone(visit, about) {
  const { page } = visit;
  for (const id of ["prompt", "open", "feel", "views", "history"]) {
    assert(!(await page.isVisible(`#${id}`)), `without a compiler there is no ${id}`);
  }
  const other = await Visit.begin(browser, page.url());
  await shown(other.page, "ice");
  assert(page.url().endsWith("#texture=ice") && (await other.page.getAttribute(".cell:has-text(\"ice\")", "aria-selected")) === "true", "its address is a link to the texture");
  await other.end();
  await clean(page, assert, "exported", "light");
  await clean(page, assert, "exported again", "dark");

  await page.click("#take-button");
  const endings = await page.locator(".kind").evaluateAll((kinds) => kinds.map(({ dataset }) => dataset.ending));
  assert(endings.join() === about.files.join(), `it can be taken away as ${endings.join(", ")}`);
  run(asperity, work, "extract", library, "ice", "-o", "ice.asp", "--quiet");
  for (const ending of endings) {
    const { name, bytes } = await downloaded(page, () => page.click(`.kind[data-ending="${ending}"]`));
    if (ending === "asp") assert(bytes.equals(readFileSync(join(work, "ice.asp"))), `${name} has the bytes of asperity extract`);
    else assert(bytes.length > 1000, `${name} has ${bytes.length} bytes`);
  }
  await page.keyboard.press("Escape");

  await page.click(".cells [role=option] >> nth=0");
  await page.waitForFunction(() => document.getElementById("surface-title").textContent !== "ice");
  await page.keyboard.press("Control+z");
  await shown(page, "ice");
  assert(true, "undo returns to a texture");
  await drop(page, [{ name: "a.asp", bytes: Buffer.from("x") }], async () =>
    assert(await page.locator("#drop").isHidden(), "a file that is dragged over it is not asked for"));
}

/** A page with the compiler: what the studio does, by the same bytes. */
async function compiler(visit) {
  const { page } = visit;
  const tools = { assert, asperity, work, offline: true };
  const asset = async () => {
    await page.click("#take-button");
    const { bytes } = await downloaded(page, () => page.click(".kind[data-ending=asp]"));
    await page.keyboard.press("Escape");
    return bytes;
  };
  const same = async (now, what) => assert((await asset()).equals(written(tools, now.command, what,
    { "ice.asp": ice })), `${what}: the bytes of ${now.command.split("\n").at(-1)}`);
  run(asperity, work, "extract", library, "ice", "-o", "ice.asp", "--quiet");
  const ice = readFileSync(join(work, "ice.asp"));
  withheld = "compiler.wasm";
  await page.focus("#slider-rough");
  await page.keyboard.press("ArrowRight");
  await page.waitForSelector("#feel .error strong");
  assert((await page.textContent("#feel .error")).includes("Try again"), `a compiler that cannot be loaded is said: ${await page.textContent("#feel .error strong")}`);
  assert((await page.textContent("#opening")) === "", "and its progress is gone");
  withheld = null;
  assert(visit.errors.splice(0).every((text) => text.includes("404")), "the console names the file alone");
  await page.keyboard.press("ArrowLeft");
  // A texture of the files, edited: the module is given it.
  await page.focus("#slider-rough");
  const began = Date.now();
  await same(await after(page, () => page.keyboard.press("ArrowRight"), ({ count }, { count: was }) => count > was), "edit");
  console.log(`  the first edit took ${((Date.now() - began) / 1000).toFixed(1)} s, loading the compiler`);
  await page.click("#views label:first-child");
  const compiled = Date.now();
  await visit.compile("rough abrasive sheet with gritty particles");
  console.log(`  a prompt took ${Date.now() - compiled} ms`);
  await same(await after(page, async () => {}, () => true), "prompt");
  for (const scheme of ["light", "dark"]) await clean(page, assert, "offline", scheme);
  const linked = await Visit.begin(browser, page.url());
  await shown(linked.page, "rough abrasive sheet with gritty particles");
  const [here, there] = [await now(page), await now(linked.page)];
  assert(page.url().includes("#recipe=") && here.id === there.id && here.command === there.command, "its address holds the recipe, which makes the same bytes again");
  await linked.end();

  const other = await Visit.begin(browser, address);
  await other.page.evaluate(axe);
  await other.page.waitForSelector(".cells [role=option]");
  await other.page.click("#views label:first-child");
  await files(other, tools);
  assert(other.errors.length === 0 && other.foreign.length === 0, `nor has another visit${other.errors.map((text) => `; ${text}`).join("")}`);
  await other.end();
}

try {
  const visit = await Visit.begin(browser, address);
  const { page } = visit;
  await page.evaluate(axe);
  const about = JSON.parse(readFileSync(join(folder, "api/about.json"), "utf8"));
  await textures(visit, about);
  await (about.compiler ? compiler(visit) : filesAlone(visit, about));
  assert(visit.errors.length === 0, `the console has no error${visit.errors.map((text) => `; ${text}`).join("")}`);
  assert(visit.foreign.length === 0, `nothing else is asked${visit.foreign.map((text) => `; ${text}`).join("")}`);

  server.closeAllConnections();
  await new Promise((done) => server.close(done));
  if (!about.compiler) {
    await page.click(".cells [role=option] >> nth=0");
    await page.waitForSelector("[data-key=server]");
    assert((await page.textContent("[data-key=server]")).includes("web server"), "a web server that is gone is said");
  }
  await visit.end();
} finally {
  await browser.close();
  server.close();
  rmSync(work, { recursive: true });
}
console.log(`the exported page: ${count} claims hold in Chromium, ${((Date.now() - began) / 1000).toFixed(0)} s`);
