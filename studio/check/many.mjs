// Picks from a gallery for a long time, by clicks, arrow keys and undo: whatever the page keeps of a texture is limited, so
// its memory, its elements and its listeners stay as many as they are once these limits are reached.
//
//   STUDIO_MODULES=…/node_modules ASPERITY=… node many.mjs CHROMIUM [PICKS]
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { assert, chromium, count } from "./chromium.mjs";
import { numbers } from "./expect.mjs";
import { KINDS, library, serve } from "./served.mjs";

const [executablePath, picks = "1000"] = process.argv.slice(2);
const PLACES = 200;
/** What a session keeps, which is reached before the first count. */
const SESSION = 200;
/** Until then every texture has been on the surface, and the session has been full for a while. */
const WARM_UP = 280;
/** What may come on top, however many picks follow: in bytes, what some 25 textures have that the server describes. */
const MORE = { JSHeapUsedSize: 1 << 20, Nodes: 60, JSEventListeners: 20 };

const began = Date.now();
const folder = mkdtempSync(join(tmpdir(), "many-"));
const prompts = ["rough", "smooth", "soft", "wet", "dry"].flatMap((how) => KINDS.map((kind) => `${how} ${kind}`));
const { file, names } = library(folder, prompts.slice(0, PLACES));
console.log(`  ${PLACES} textures built in ${((Date.now() - began) / 1000).toFixed(0)} s`);

const { address, end } = await serve(folder, [file, "--no-open"]);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--autoplay-policy=no-user-gesture-required"] });

class Picking {
  #page;
  #cdp;
  #random = numbers(77);
  #place = 0;
  done = 0;

  static async begin() {
    const picking = new Picking();
    const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, reducedMotion: "reduce" });
    const page = await context.newPage();
    picking.errors = [];
    page.on("pageerror", (error) => picking.errors.push(String(error)));
    page.on("console", (message) => message.type() === "error" && picking.errors.push(message.text()));
    await page.goto(address);
    await page.waitForSelector(".cell");
    await page.waitForSelector(".loaded", { state: "attached" });
    // The renderer is given every texture too.
    await page.click("#sound-switch");
    await page.waitForSelector("#sound-switch[aria-pressed=true]");
    picking.#page = page;
    picking.#cdp = await context.newCDPSession(page);
    await picking.#cdp.send("Performance.enable");
    return picking;
  }

  /** In one go in the page: a click at a time by the browser's events would take minutes. */
  async #click(place) {
    await this.#page.evaluate(async ([place, part, name]) => {
      const list = document.querySelector(".cells");
      const cell = () => list.querySelector(`[data-index="${place}"]`);
      const until = async (what, holds) => {
        for (const began = performance.now(); !holds(); await new Promise(requestAnimationFrame)) {
          if (performance.now() - began > 15000) throw new Error(`no ${what} for ${name}`);
        }
      };
      if (!cell()) list.scrollTop = part * list.scrollHeight;
      await until("cell", cell);
      cell().click();
      await until("surface", () => document.getElementById("surface-title").textContent === name);
    }, [place, place / PLACES, names[place]]);
    this.done++;
  }

  async #arrow() {
    const before = await this.#page.textContent("#surface-title");
    await this.#page.focus(".cells");
    await this.#page.keyboard.press(before === names.at(-1) ? "ArrowLeft" : "ArrowRight");
    await this.#page.waitForFunction((name) => document.getElementById("surface-title").textContent !== name, before);
    this.done++;
  }

  async #undo() {
    const told = () => this.#page.textContent("#timeline .told");
    const before = await told();
    await this.#page.keyboard.press("Control+z");
    await this.#page.waitForFunction((was) => document.querySelector("#timeline .told").textContent !== was, before);
  }

  /** Picks until so many have been picked. */
  async until(most) {
    while (this.done < most) {
      // Every texture once, then those some places further.
      this.#place = (this.#place + 1 + (this.done < WARM_UP ? 0 : Math.floor(9 * this.#random()))) % PLACES;
      await this.#click(this.#place);
      if (this.done % 8 === 0) await this.#arrow();
      if (this.done % 7 === 0) await this.#undo();
    }
  }

  /** What the page has, with a full session and always the same texture on the surface. */
  async count() {
    const page = this.#page;
    const full = () => page.$$eval("#timeline .tile", (all, most) => all.length === most && all.at(-1).ariaCurrent === "true", SESSION);
    for (let n = 0; n === 0 || !(await full()); n++) await this.#click(n % 2);
    if ((await page.textContent("#surface-title")) !== names[0]) await this.#click(0);
    await page.waitForFunction(() => [...document.querySelectorAll(".cell img")].every(({ dataset }) => dataset.state));
    let found = null;
    for (let before = Infinity; before !== found?.Nodes;) {
      before = found?.Nodes;
      await page.waitForTimeout(500);
      await this.#cdp.send("HeapProfiler.collectGarbage");
      const { metrics } = await this.#cdp.send("Performance.getMetrics");
      found = Object.fromEntries(metrics.filter(({ name }) => name in MORE).map(({ name, value }) => [name, value]));
    }
    return found;
  }
}

try {
  const picking = await Picking.begin();
  await picking.until(WARM_UP);
  const before = await picking.count();
  const [from, at] = [picking.done, Date.now()];
  await picking.until(Number(picks));
  const now = await picking.count();
  const each_ms = (Date.now() - at) / (picking.done - from);
  for (const [name, most] of Object.entries(MORE)) {
    const more = now[name] - before[name];
    assert(more <= most, `${picking.done - from} picks after the first ${from}, ${name} is ${now[name]}, ${more} more than before, ${most} at most`);
  }
  assert(picking.errors.length === 0, `no error on the console${picking.errors.map((text) => `: ${text}`).join("")}`);
  console.log(`${count} claims hold, ${each_ms.toFixed(0)} ms a pick, ${((Date.now() - began) / 1000).toFixed(0)} s`);
} finally {
  await browser.close();
  await end();
  rmSync(folder, { recursive: true, force: true });
}
