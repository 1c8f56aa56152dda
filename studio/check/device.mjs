// The page beside a servo loop on the simulated device: what the loop does is shown, and a texture is swapped.
//
//   STUDIO_MODULES=…/node_modules node device.mjs ADDRESS CHROMIUM PID
//
// ADDRESS is that which `asperity-lab servo LIBRARY --texture NAME --device sim: --studio` prints, PID its process,
// which is ended. The library has at least two textures.
import { clean } from "./aid.mjs";
import { assert, axe, chromium, count } from "./chromium.mjs";
import { Visit } from "./visit.mjs";

const [address, executablePath, process_id] = process.argv.slice(2);

const began = Date.now();
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
try {
  const visit = await Visit.begin(browser, address);
  const { page } = visit;
  await page.evaluate(axe);
  await page.waitForSelector("#servo-panel:not([hidden]) .badge[data-state]");
  const row = (name) => page.textContent(`#servo dt:text-is("${name}") + dd`);
  const until = (name, is) => page.waitForFunction(([name, is]) => {
    const term = [...document.querySelectorAll("#servo dt")].find(({ textContent }) => textContent === name);
    return new RegExp(is).test(term.nextElementSibling.textContent);
  }, [name, is]);
  assert((await page.textContent("#servo-name")).includes("1,000 Hz"), `the device is named: ${await page.textContent("#servo-name")}`);
  await page.waitForSelector("#servo .badge[data-state=contact]");
  assert(true, "the hand touches");
  await until("Force", "^0\\.[1-9]|^[1-9]");
  assert(true, `and feels a force: ${await row("Force")}`);
  await page.waitForFunction(() => document.querySelector(".latency td")?.textContent);
  assert(true, `how late the loop wakes is shown: ${await page.textContent(".latency tr:nth-child(2)")}`);
  const first = await row("Plays");

  // The plots are those of the device: they can be saved as soon as they have ticks.
  await page.waitForFunction(() => [...document.querySelectorAll(".plot-controls button")].every(({ disabled }) => !disabled));
  assert(true, "the plots show its ticks");

  // Without networks, textures come from the library.
  assert(await page.isDisabled("#prompt"), "no prompt is asked for where none is compiled");
  const other = page.locator(".cells [role=option]").filter({ hasNotText: first }).first();
  const name = (await other.locator(".called").textContent()).trim();
  await other.click();
  await page.waitForFunction((name) => document.getElementById("surface-title").textContent === name, name);
  assert((await row("Plays")) === first, "what is shown is not played yet");
  await page.click("#servo-play-button");
  await until("Plays", `^${name}$`);
  assert(name !== first, `a click has the device play “${name}”`);

  await page.evaluate(() => {
    const until = performance.now() + 2500;
    while (performance.now() < until);
  });
  await until("Ticks not shown", "^[1-9]");
  assert(true, `a page that stands still for 2.5 s misses ticks: ${await row("Ticks not shown")}`);
  await clean(page, assert, "beside a servo loop", "light");
  assert(visit.errors.length === 0, `no error on the console${visit.errors.map((text) => `: ${text}`).join("")}`);

  process.kill(Number(process_id), "SIGINT");
  await page.waitForFunction(() => document.querySelector("#servo .badge").dataset.state === "ended" || document.querySelector("[data-key=servo]"));
  assert(true, "the end of the loop is said");
  await visit.end();
  console.log(`${count} assertions in ${((Date.now() - began) / 1000).toFixed(0)} s`);
} finally {
  await browser.close();
}
