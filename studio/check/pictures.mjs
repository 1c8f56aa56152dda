// Draws the pictures of docs/studio.md, `studio-STATE-SCHEME.png`, and the frames of the README's animation:
//
//   STUDIO_MODULES=…/node_modules node pictures.mjs ADDRESS CHROMIUM FOLDER [FRAMES]
//
// ADDRESS is that of a studio with a library of some dozens of textures. `docs/images/draw --studio` starts one.
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "./chromium.mjs";

const PROMPT = "rough abrasive sheet with gritty particles";
const SLOTS = ["wet ice", "cork", "soft velvet", "brushed steel, slightly waxy"];
/** Frames of the animation, and the time between two, ms. */
const FRAMES = 36;
const FRAME_MS = 110;
const [address, executablePath, folder, frames] = process.argv.slice(2);

const shown = (page, name) => page.waitForFunction((name) => document.querySelector("#surface-title").textContent === name
  && document.getElementById("prompt-form").getAttribute("aria-busy") === "false", name);

async function compile(page, prompt) {
  await page.fill("#prompt", prompt);
  await page.press("#prompt", "Enter");
  await shown(page, prompt);
}

/** What is drawn in which colours. */
const SHOWN = { light: ["desk", "library", "scatter"], dark: ["plots", "gallery"] };

/** Each brings the page from the state before it to its own. */
const STATES = {
  start: async (page) => {
    await page.waitForSelector(".cells [role=option]");
    await page.click("#views label:first-child");
    await page.evaluate(() => scrollTo(0, 0));
  },
  desk: async (page) => {
    await compile(page, PROMPT);
    await page.waitForTimeout(3000);
  },
  // Plots are drawn where they are seen: all but the strip, above which a browser without a GPU keeps up.
  plots: async (page) => {
    await page.locator("#live-drawer").evaluate((live) => {
      live.open = true;
      live.scrollIntoView();
    });
    await page.waitForTimeout(4000);
  },
  library: async (page) => {
    await page.locator("#live-drawer").evaluate((live) => (live.open = false));
    await page.click("#auto");
    for (const [n, prompt] of SLOTS.entries()) {
      await compile(page, prompt);
      await page.locator("#compare .slot").nth(n).click();
      await page.click("#keep");
    }
    const rows = [["glazed counter", "for the kitchen", "wet"], ["pin board", "beside the door", "dry"], ["stage curtain", "", "dry, soft"], ["railing", "below the stairs", "wet"]];
    for (const [n, [name, note, tags]] of rows.entries()) {
      const row = page.locator(".kept li").nth(rows.length - 1 - n);
      for (const [field, text] of Object.entries({ name, note, tags })) await row.locator(`.kept-${field}`).fill(text);
    }
    await page.locator("#own-drawer").evaluate((drawer) => drawer.scrollIntoView({ block: "end" }));
    await page.evaluate(() => document.activeElement.blur());
    await page.waitForTimeout(300);
  },
  gallery: async (page) => {
    await page.evaluate(() => scrollTo(0, 0));
    await page.click("#views label:last-child");
    await page.locator(".cells [role=option]").nth(7).click();
    await page.waitForFunction(() => [...document.querySelectorAll(".cell img")].every(({ dataset }) => dataset.state === "loaded"));
    await page.waitForTimeout(1000);
  },
  scatter: async (page) => {
    await page.click(".modes label:nth-child(2)");
    await page.waitForTimeout(1500);
  },
};

/** A page that begins with nothing in its project, whatever was drawn before. */
async function begin(browser, colorScheme) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme });
  await page.route("**/api/project.json*", (route) => route.fulfill({ json: {} }));
  await page.goto(address);
  return page;
}

async function animate(page) {
  mkdirSync(frames, { recursive: true });
  await STATES.start(page);
  await STATES.desk(page);
  const clip = { x: 0, y: 0, width: 1280, height: 800 };
  for (let n = 0; n < FRAMES; n++) {
    await page.screenshot({ path: join(frames, `${String(n).padStart(3, "0")}.png`), clip });
    await page.waitForTimeout(FRAME_MS);
  }
}

const browser = await chromium.launch({ executablePath, args: ["--autoplay-policy=no-user-gesture-required", "--no-sandbox"] });
for (const [colorScheme, drawn] of Object.entries(SHOWN)) {
  const page = await begin(browser, colorScheme);
  for (const [name, reach] of Object.entries(STATES)) {
    await reach(page);
    if (drawn.includes(name)) await page.screenshot({ path: join(folder, `studio-${name}-${colorScheme}.png`) });
  }
  await page.close();
}
if (frames) await animate(await begin(browser, "light"));
await browser.close();
