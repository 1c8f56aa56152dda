// The page at sizes from a telephone to a large screen, in the states that people see: nothing is cut off, nothing lies on
// anything else, axe finds nothing, and the surface has most of the window.
//
//   STUDIO_MODULES=…/node_modules ASPERITY=… node sizes.mjs CHROMIUM
//
// All that does not hold is told, at the end. STUDIO_PICTURES is a folder that takes screenshots.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { placed, readable } from "./boxes.mjs";
import { assert, axe, chromium, count } from "./chromium.mjs";
import { library, serve } from "./served.mjs";
import { after } from "./steering.mjs";
import { Visit } from "./visit.mjs";

const [executablePath] = process.argv.slice(2);
const SIZES = [[360, 740], [1280, 720], [1366, 650], [1920, 1080], [3840, 2160]];
/** The least share of the window that the stage has, from this width on. */
const [SHARE, WIDE] = [0.55, 1280];
const pictures = process.env.STUDIO_PICTURES;

const drawers = (page, open) => page.evaluate((open) => document.querySelectorAll(".drawers > details").forEach((drawer) =>
  (drawer.open = open ?? ["session-drawer", "nearby-drawer"].includes(drawer.id))), open);
const hide = (page, id) => page.evaluate((id) => document.getElementById(id).hidePopover(), id);

/**
 * Each begins where the one before it ended, with the drawers that are open at first; `back` undoes what later ones would not
 * begin with. In those that are `roomy` the stage has its share.
 */
const STATES = {
  "as it begins": { roomy: true, act: async ({ page }) => page.click("#views label:first-child") },
  "after a prompt": { roomy: true, act: (visit) => visit.compile("rough abrasive sheet with gritty particles, and quantum") },
  "in the gallery": { act: async ({ page }) => {
    await page.click("#views label:nth-child(2)");
    await page.waitForSelector(".cell img[data-state=loaded]");
  }, back: ({ page }) => page.click("#views label:first-child") },
  "with all drawers open": { roomy: true, act: ({ page }) => drawers(page, true), back: ({ page }) => drawers(page) },
  "with what to take": { popover: "take", act: ({ page }) => page.click("#take-button"), back: ({ page }) => hide(page, "take") },
  "with the keys": { popover: "keys", act: ({ page }) => page.evaluate(() => document.getElementById("keys").showPopover()),
    back: ({ page }) => hide(page, "keys") },
  "while comparing blindly": { roomy: true, act: async (visit) => {
    const { page } = visit;
    for (const [n, prompt] of ["cork", "wet ice"].entries()) {
      await visit.compile(prompt);
      await after(page, () => page.click(`#compare .slot >> nth=${n}`), () => true);
    }
    await page.click("#blind");
    await page.waitForSelector(".blind");
  } },
};

const failures = [];
function claim(holds, text) {
  if (holds) assert(true, text);
  else failures.push(text);
}

/** What of the page as it is must hold at a size. */
async function looked({ page }, what, { roomy = false, popover }, [width, height]) {
  const at = `${what}, ${width} × ${height}`;
  await page.setViewportSize({ width, height });
  await page.evaluate(() => scrollTo(0, 0));
  await page.waitForTimeout(300);
  if (pictures) await page.screenshot({ path: join(pictures, `${width}-${what.replaceAll(" ", "-")}.png`) });
  claim(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `nothing is cut off at the side ${at}`);
  await placed(page, claim, at);
  if (popover) {
    const inside = await page.$eval(`#${popover}`, (panel) => {
      const { left, top, right, bottom } = panel.getBoundingClientRect();
      return panel.matches(":popover-open") && left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight && panel.scrollWidth <= panel.clientWidth;
    });
    claim(inside, `all of it lies in the window ${at}`);
  }
  if (roomy && width >= WIDE) {
    const share = await page.$eval("#stage", ({ clientWidth, clientHeight }) => (clientWidth * clientHeight) / (innerWidth * innerHeight));
    const seen = await page.$eval("#stage", (stage) => stage.getBoundingClientRect().bottom <= innerHeight);
    claim(share >= SHARE && seen, `the surface has ${(100 * share).toFixed(0)} % of the window ${at}${seen ? "" : ", and part of it below the edge"}`);
  }
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  const list = violations.map(({ id, nodes }) => `; ${id}: ${nodes.map(({ target }) => target).join(", ")}`);
  claim(list.length === 0, `axe finds nothing ${at}${list.join("")}`);
}

const began = Date.now();
const folder = mkdtempSync(join(tmpdir(), "sizes-"));
const { address, end } = await serve(folder, [library(folder).file, "--no-open"]);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--autoplay-policy=no-user-gesture-required"] });
try {
  const visit = await Visit.begin(browser, address);
  const { page } = visit;
  await page.evaluate(axe);
  await drawers(page);
  for (const [what, state] of Object.entries(STATES)) {
    await page.setViewportSize({ width: 1280, height: 800 });
    await state.act(visit);
    for (const size of SIZES) await looked(visit, what, state, size);
    if (what === "after a prompt") {
      for (const [width, height] of [SIZES[0], SIZES[3]]) {
        await page.setViewportSize({ width, height });
        await readable(page, claim, `${what}, ${width} × ${height}`);
      }
    }
    await state.back?.(visit);
  }
  claim(visit.errors.length === 0, `no error on the console${visit.errors.map((text) => `: ${text}`).join("")}`);
  console.log(`${count} claims hold at ${SIZES.length} sizes, ${((Date.now() - began) / 1000).toFixed(0)} s`);
  assert(failures.length === 0, `all claims hold${failures.map((text) => `\n  not ${text}`).join("")}`);
} finally {
  await browser.close();
  await end();
  rmSync(folder, { recursive: true, force: true });
}
