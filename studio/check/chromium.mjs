// What the scripts that drive Chromium share: the modules in the folder STUDIO_MODULES, and claims that are counted.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const need = createRequire(join(resolve(process.env.STUDIO_MODULES ?? "node_modules"), "/"));

export const { chromium } = need("playwright-core");
export const axe = readFileSync(need.resolve("axe-core/axe.min.js"), "utf8");

/** Claims that were found to hold. */
export let count = 0;

export function assert(holds, text) {
  if (!holds) throw new Error(`does not hold: ${text}`);
  count++;
  console.log(`  ${text}`);
}
