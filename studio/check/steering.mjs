// What the checks of steering share: what the page shows, and the bytes that its command lines write.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

/** Time in which a slider is released and what is asked for is shown, ms. */
const PATIENCE_MS = 15000;

/** What the page shows now: the identity of the texture, and how many the session has. */
export const shown = (page) => page.evaluate(() => ({
  told: document.querySelector("#timeline .told").textContent,
  id: document.querySelector("#timeline .tile[aria-current]")?.dataset.texture,
  count: document.querySelectorAll("#timeline .tile").length,
  command: document.querySelector("#command code")?.textContent,
}));

/** Does something, and waits for what the page shows then. */
export async function after(page, act, what = ({ told }, before) => told !== before.told) {
  const before = await shown(page);
  await act();
  const began = Date.now();
  for (;;) {
    const now = await shown(page);
    if (what(now, before)) return now;
    if (Date.now() - began > PATIENCE_MS) throw new Error(`the page shows ${now.told} still`);
    await page.waitForTimeout(20);
  }
}

export const bytesOf = async (page, id) => Buffer.from(await page.evaluate(async (id) => {
  const response = await fetch(`api/texture/${id}.asp`);
  return Array.from(new Uint8Array(await response.arrayBuffer()));
}, id));

/** Runs command lines in a folder of their own, beside `files`; the bytes of the file that the last one writes. */
export function written({ asperity, work }, lines, name, files) {
  const folder = join(work, name);
  mkdirSync(folder);
  for (const [file, bytes] of Object.entries(files)) writeFileSync(join(folder, file), bytes);
  execFileSync("sh", ["-ec", `asperity() { "$PROGRAM" "$@" --quiet >/dev/null; }\n${lines}`],
    { cwd: folder, env: { ...process.env, PROGRAM: asperity }, stdio: ["ignore", "ignore", "inherit"] });
  const [, quoted, plain] = /-o (?:'((?:[^']|'\\'')*)'|(\S+))/.exec(lines.split("\n").at(-1));
  return readFileSync(join(folder, plain ?? quoted.replaceAll("'\\''", "'")));
}

export async function same(page, tools, now, what, files = {}) {
  if (!tools.asperity) return;
  const wanted = written(tools, now.command, what.replaceAll(/\W+/g, "-"), files);
  tools.assert(wanted.equals(await bytesOf(page, now.id)), `${what}: the bytes of ${now.command.split("\n").at(-1)}`);
}
