// Nobody else on the machine learns the address that opens the studio: no program's arguments have its secret, and the file
// that leads a browser there is its user's alone. The browser is a stand-in that stays, then Chromium by the same file.
//
//   STUDIO_MODULES=…/node_modules ASPERITY=… node ps.mjs CHROMIUM
import { chmodSync, existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { assert, chromium } from "./chromium.mjs";
import { serve } from "./served.mjs";

const [executablePath] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "ps-"));

/** The arguments of every program that runs, as `ps` shows them to all users. */
const commandLines = () => readdirSync("/proc").filter((name) => /^\d+$/.test(name)).flatMap((id) => {
  try {
    return [readFileSync(`/proc/${id}/cmdline`, "utf8").replaceAll("\0", " ")];
  } catch {
    return [];
  }
});

const seen = join(folder, "seen");
writeFileSync(join(folder, "xdg-open"), `#!/bin/sh\nprintf '%s\\n' "$@" >${seen}.part\nmv ${seen}.part ${seen}\nsleep 30 &\necho $! >${seen}.sleep\nwait\n`);
chmodSync(join(folder, "xdg-open"), 0o700);
const { address, end } = await serve(folder, [], { PATH: `${folder}:${process.env.PATH}`, DISPLAY: ":99" });
let browser = null;
try {
  const token = new URL(address).pathname.replaceAll("/", "");
  assert(/^[\w-]{22}$/.test(token), "the address has a secret of 128 bits");
  for (let n = 0; n < 100 && !existsSync(`${seen}.sleep`); n++) await new Promise((done) => setTimeout(done, 50));
  const given = readFileSync(seen, "utf8").trim().split("\n");
  assert(given.length === 1 && given[0].endsWith(".html"), "the browser is given one file, and nothing else");
  const { mode, uid } = statSync(given[0]);
  assert((mode & 0o777) === 0o600 && uid === process.getuid(), "which its user alone reads");
  assert(readFileSync(given[0], "utf8").includes(address), "and which has the address");

  const opening = commandLines();
  assert(opening.some((line) => line.includes(given[0])), "while it opens, its arguments are seen");
  assert(!opening.some((line) => line.includes(token)), `of ${opening.length} programs, none has the secret in its arguments`);

  browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const page = await browser.newPage();
  await page.goto(`file://${given[0]}`);
  await page.waitForURL(address);
  await page.waitForFunction(() => document.getElementById("edition")?.textContent);
  assert(!commandLines().some((line) => line.includes(token)), "nor has Chromium, which comes to the page by that file");
  await end();
  assert(!existsSync(given[0]), "the file goes with the studio");
} finally {
  await browser?.close();
  await end();
  if (existsSync(`${seen}.sleep`)) process.kill(Number(readFileSync(`${seen}.sleep`, "utf8")));
  rmSync(folder, { recursive: true, force: true });
}
