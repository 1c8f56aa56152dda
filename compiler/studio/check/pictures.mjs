// Draws the pictures of docs/studio.md:
//
//   STUDIO_MODULES=…/node_modules node pictures.mjs ADDRESS CHROMIUM FOLDER
//
// ADDRESS is that of a running studio. Each picture comes in light and dark: `studio-desk` and `studio-plots`.
import { join } from "node:path";
import { chromium } from "./chromium.mjs";

const PROMPT = "rough abrasive sheet with gritty particles";
const [address, executablePath, folder] = process.argv.slice(2);

const browser = await chromium.launch({ executablePath, args: ["--autoplay-policy=no-user-gesture-required"] });
for (const colorScheme of ["light", "dark"]) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme });
  const path = (name) => join(folder, `studio-${name}-${colorScheme}.png`);
  await page.goto(address);
  await page.fill("#prompt", PROMPT);
  await page.keyboard.press("Enter");
  await page.waitForFunction((prompt) => document.querySelector("#surface-title").textContent === prompt, PROMPT);
  await page.click("#sound-switch");
  await page.click("#auto");
  await page.waitForTimeout(4000);
  await page.screenshot({ path: path("desk") });
  // Plots are drawn where they are seen: all but the strip, above which a browser without a GPU keeps up.
  await page.locator(".live").evaluate((live) => live.scrollIntoView());
  await page.waitForTimeout(4000);
  await page.screenshot({ path: path("plots") });
  await page.close();
}
await browser.close();
