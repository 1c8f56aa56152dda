// What the checks of the page share.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { placed } from "./boxes.mjs";

/** Runs the command in a folder; what it prints. */
export const run = (asperity, cwd, ...args) =>
  execFileSync(asperity, args, { cwd, stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1 << 28 });

/** The file that the page gives by `act`: { name, bytes }. */
export async function downloaded(page, act) {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  if (!download.url().startsWith("blob:")) throw new Error(`downloads from ${download.url()}`);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** Drags files, [{ name, bytes }], over the page, calls `over()`, and drops them. */
export async function drop(page, files, over = async () => {}) {
  const given = files.map(({ name, bytes }) => ({ name, text: Buffer.from(bytes).toString("base64") }));
  const transfer = await page.evaluateHandle((given) => {
    const transfer = new DataTransfer();
    for (const { name, text } of given) {
      transfer.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], name));
    }
    return transfer;
  }, given);
  const send = (type) => page.dispatchEvent("body", type, { dataTransfer: transfer });
  await send("dragenter");
  await send("dragover");
  await over();
  await send("drop");
}

/** What is on the surface, and has been heard: waits until it has the name. */
export const shown = (page, name) =>
  page.waitForFunction((name) => document.getElementById("surface-title").textContent === name, name);

/** Windows, and the one of a scheme in which axe looks: twelve looks at each state would take minutes. */
const WINDOWS = [["light", 2560, 1300], ["light", 1280, 800], ["dark", 360, 740]];
const LOOKS = { light: 1280, dark: 360 };

/**
 * Whether something is cut off at any width, and what axe says of the page as it is. With STUDIO_PICTURES,
 * a folder, it also takes screenshots.
 */
export async function clean(page, assert, what, scheme) {
  for (const [colorScheme, width, height] of WINDOWS) {
    await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
    await page.setViewportSize({ width, height });
    await page.waitForTimeout(150);
    assert(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `nothing is cut off at the side ${what}, ${width} px`);
    await placed(page, assert, `${what}, ${width} px`);
    const folder = process.env.STUDIO_PICTURES;
    if (folder) await page.screenshot({ path: join(folder, `studio-${what.replaceAll(" ", "-")}-${colorScheme}-${width}.png`) });
    if (width !== LOOKS[scheme]) continue;
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    const list = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(", ")}`);
    assert(list.length === 0, `axe finds nothing ${what}, ${colorScheme}, ${width} px${list.map((text) => `; ${text}`).join("")}`);
  }
  await page.emulateMedia({ colorScheme: "light", reducedMotion: "no-preference" });
  await page.setViewportSize({ width: 1280, height: 800 });
}
