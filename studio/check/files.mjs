// Files in and out of the page: every download has the bytes of the command, and dropped files are opened or refused by name.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { clean, downloaded, drop, run, shown } from "./aid.mjs";
import { hattXml } from "./hatt.mjs";
import { kept } from "./own.mjs";

/** By the endings of the page: the command that writes such a file of `wet ice.asp`, and its name. */
const COMMANDS = {
  asp: [["compile", "wet ice", "-o", "wet ice.asp"], "wet ice.asp"],
  json: [["inspect", "wet ice.asp", "--json"], null],
  png: [["preview", "wet ice.asp", "-o", "wet ice.png"], "wet ice.png"],
  "normal.png": [["preview", "wet ice.asp", "-o", "drawn.png", "--normal", "normal.png", "--height", "height.png"], "normal.png"],
  "height.png": [null, "height.png"],
  "plot.png": [["plot", "wet ice.asp", "-o", "plot.png"], "plot.png"],
  "listen.wav": [["listen", "wet ice.asp", "-o", "listen.wav"], "listen.wav"],
  "export.wav": [["export", "wet ice.asp", "--to", "wav", "-o", "export.wav"], "export.wav"],
  "export.csv": [["export", "wet ice.asp", "--to", "csv", "-o", "export.csv"], "export.csv"],
  "export.hjif": [["export", "wet ice.asp", "--to", "hjif", "-o", "export.hjif"], "export.hjif"],
  "export.hmpg": [["export", "wet ice.asp", "--to", "hmpg", "-o", "export.hmpg"], "export.hmpg"],
  "export.ahap": [["export", "wet ice.asp", "--to", "ahap", "-o", "export.ahap"], "export.ahap"],
  "export.haptic": [["export", "wet ice.asp", "--to", "haptic", "-o", "export.haptic"], "export.haptic"],
  "export.gltf": [["export", "wet ice.asp", "--to", "gltf", "-o", "export.gltf"], "export.gltf"],
  "export.c": [["export", "wet ice.asp", "--to", "c-array", "-o", "wet ice.c"], "wet ice.c"],
  "export.h": [null, "wet ice.h"],
  "export.rs": [["export", "wet ice.asp", "--to", "rust", "-o", "export.rs"], "export.rs"],
};

async function out({ page }, { assert, asperity, folder }) {
  await page.click("#take-button");
  const endings = await page.$$eval(".kind", (all) => all.map(({ dataset }) => dataset.ending));
  const missing = Object.keys(COMMANDS).filter((ending) => !endings.includes(ending));
  assert(missing.length === 0, `the panel offers ${endings.length} files, none is missing${missing.map((ending) => `: ${ending}`).join("")}`);
  const names = [];
  for (const [ending, [args, file]] of Object.entries(COMMANDS)) {
    const printed = args && run(asperity, folder, ...args, ...(file ? ["--quiet"] : []));
    const { name, bytes } = await downloaded(page, () => page.click(`.kind[data-ending="${ending}"]`));
    names.push(name);
    assert(bytes.equals(file ? readFileSync(join(folder, file)) : printed), `“${name}” has the bytes of the command`);
  }
  assert(new Set(names).size === names.length && names.every((name) => name.startsWith("wet ice")), "each has a name of its own");
  await clean(page, assert, "in the panel of files", "dark");
  await page.keyboard.press("Escape");
  assert(await page.isHidden("#take"), "Escape closes the panel");
}

/** Files to open, with the name and the bytes of what they become. */
function inputs(asperity, folder) {
  writeFileSync(join(folder, "Models_Test Board.xml"), hattXml("Test Board"));
  run(asperity, folder, "import", "hatt", "Models_Test Board.xml", "-o", "board.asp", "--quiet");
  run(asperity, folder, "import", "haptic", "export.haptic", "-o", "effect.asp", "--quiet");
  run(asperity, folder, "builtin", "-o", "grit.asp", "--quiet");
  const file = (name, asset) => ({ name, bytes: readFileSync(join(folder, name)), asset: readFileSync(join(folder, asset)),
    title: JSON.parse(run(asperity, folder, "inspect", asset, "--json")).name });
  return [file("grit.asp", "grit.asp"), file("Models_Test Board.xml", "board.asp"), file("export.haptic", "effect.asp")];
}

async function opened(visit, { assert, asperity, folder, offline }) {
  const { page } = visit;
  const files = inputs(asperity, folder);
  for (const { name, title, asset, bytes } of files) {
    await drop(page, [{ name, bytes }], async () => assert(await page.isVisible("#drop"), "a target is shown while files are dragged"));
    await shown(page, title);
    await page.click("#take-button");
    const { bytes: kept } = await downloaded(page, () => page.click('.kind[data-ending="asp"]'));
    assert(kept.equals(asset), `${name} is opened by a drop, with the bytes of the command`);
    await page.keyboard.press("Escape");
  }
  assert(await page.isHidden("#drop"), "the target goes with the drop");

  // The browser must know in time that a script chooses.
  const chooser = page.waitForEvent("filechooser", { timeout: 60000 });
  // Where a claim fails before, that is the error.
  chooser.catch(() => {});
  const library = { name: "session.aspl", bytes: readFileSync(join(folder, "session.aspl")) };
  const broken = { name: "broken.asp", bytes: files[0].bytes.subarray(0, 900) };
  const strange = { name: "notes.txt", bytes: Buffer.from("nothing to feel") };
  await drop(page, [files[0], broken, strange, library, files[1]]);
  await shown(page, files[1].title);
  const notices = await page.$$eval(".notice p", (all) => all.map(({ textContent }) => textContent));
  assert(notices.length === 2 && notices[0].includes("broken.asp") && notices[1].includes("notes.txt"),
    `of five files, two are refused by name: ${notices.join(" | ")}`);
  // The browser logs what a server refuses; a page without one has none.
  const logged = visit.errors.splice(0);
  assert(logged.length === (offline ? 0 : 2) && logged.every((text) => text.includes("status of 4")), "and nothing else is on the console");
  assert((await page.$$(".cell")).length === 2, "a library is shown in the gallery");
  await clean(page, assert, "with files that were refused", "light");
  for (const button of await page.$$(".notice button:last-child")) await button.click();

  await page.focus("#open");
  await page.keyboard.press("Enter");
  await (await chooser).setFiles(join(folder, "grit.asp"));
  await shown(page, files[0].title);
  assert(true, "a file is opened by keys alone");
}

/** A picture of heights, of which the page asks what it does not say. */
async function map(visit, { assert, asperity, folder }) {
  const { page } = visit;
  run(asperity, folder, "compile", "corduroy", "-o", "corduroy.asp", "--quiet");
  run(asperity, folder, "preview", "corduroy.asp", "-o", "seen.png", "--height", "ribs.png", "--quiet");
  const bytes = readFileSync(join(folder, "ribs.png"));
  await drop(page, [{ name: "ribs.png", bytes }]);
  await page.waitForSelector("dialog[open]");
  await page.keyboard.press("Escape");
  await page.waitForSelector("dialog", { state: "detached" });
  await drop(page, [{ name: "ribs.png", bytes }]);
  await page.fill("#map-width_mm", "60");
  await page.fill("#map-depth_mm", "0.5");
  await page.fill("#map-like", "corduroy trousers");
  await clean(page, assert, "when a map is asked about", "light");
  await page.keyboard.press("Enter");
  await shown(page, "ribs");
  await page.click("#take-button");
  const { bytes: kept } = await downloaded(page, () => page.click('.kind[data-ending="asp"]'));
  await page.keyboard.press("Escape");
  const command = await page.textContent("#command code");
  run(asperity, folder, "import", "surface", "ribs.png", "--width-mm", "60", "--depth-mm", "0.5", "--like", "corduroy trousers", "-o", "ribs.asp", "--quiet");
  assert(kept.equals(readFileSync(join(folder, "ribs.asp"))) && command.includes("--width-mm 60 --depth-mm 0.5 --like 'corduroy trousers'"),
    `a height map becomes a texture by its size and words, with the bytes of ${command}`);
}

/** A list of prompts, which becomes a library to look through. */
async function list({ page, errors }, { assert, asperity, folder, offline }) {
  const rows = [["floor", "wet ice"], ["hall", "xqzt"], ["wall", "cork"]];
  const table = (rows) => Buffer.from(`name,prompt\n${rows.map((row) => `${row.join(",")}\n`).join("")}`);
  writeFileSync(join(folder, "rooms.csv"), table(rows));
  await drop(page, [{ name: "rooms.csv", bytes: table(rows) }]);
  await page.waitForFunction(() => document.querySelector(".cell[data-index='2']")?.title.startsWith("wall"), null, { timeout: 60000 });
  await page.click(".cell[data-index='2']");
  await shown(page, "wall");
  run(asperity, folder, "build", "rooms.csv", "-o", "rooms.aspl", "--no-cache", "--quiet");
  run(asperity, folder, "extract", "rooms.aspl", "wall", "-o", "wall.asp", "--quiet");
  await page.click("#take-button");
  const { bytes } = await downloaded(page, () => page.click('.kind[data-ending="asp"]'));
  await page.keyboard.press("Escape");
  assert(bytes.equals(readFileSync(join(folder, "wall.asp"))), "a list of prompts becomes a library, with the bytes of asperity build");
  await page.click(".ranges summary");
  await page.selectOption("#gallery-certainty", "guess");
  await page.waitForFunction(() => document.querySelectorAll(".cell").length === 1);
  assert((await page.getAttribute(".cell", "title")).startsWith("hall"), "and tells which prompts are guesses");
  await page.selectOption("#gallery-certainty", "any");
  await page.click(".ranges summary");
  // The module of a page without a server answers nothing else meanwhile.
  if (offline) return;
  await drop(page, [{ name: "many.csv", bytes: table(Array.from({ length: 5000 }, (_, n) => [`n ${n}`, `cork and ${n} wool`])) }]);
  await page.waitForFunction(() => /[1-9]\d* of 5,000/.test(document.getElementById("opening").textContent), null, { timeout: 60000 });
  await page.click("#stop-batch");
  await page.waitForFunction(() => document.getElementById("opening").textContent === "", null, { timeout: 60000 });
  errors.splice(0);
  assert((await page.$$(".notice")).length === 0 && (await page.$$(".cell")).length === 3, "a long one says how far it is, and can be stopped");
}

/** Folders, which a browser gives to a page where they are dropped by hand alone. */
async function folders({ page, cdp, errors }, { assert, asperity, folder, offline }) {
  const dropped = async (name, files) => {
    mkdirSync(join(folder, name));
    for (const [file, content] of Object.entries(files)) writeFileSync(join(folder, name, file), content);
    const data = { items: [], files: [join(folder, name)], dragOperationsMask: 1 };
    for (const type of ["dragEnter", "dragOver", "drop"]) await cdp.send("Input.dispatchDragEvent", { type, x: 300, y: 300, data });
  };
  const refused = async (name, files) => {
    await dropped(name, files);
    await page.waitForSelector(`[data-key="open ${name}"]`);
    return page.textContent(`[data-key="open ${name}"] p`);
  };
  const none = await refused("notes", { "a.txt": "" });
  assert(none.includes("asperity record-check"), `a folder of something else is refused: ${none}`);
  const oak = await refused("oak", { "recording.toml": "name = \"Oak\"\n[[file]]\npath = \"all.csv\"\n" });
  assert(offline || oak.includes("oak/"), `a recording is read as asperity import recording reads it: ${oak}`);
  errors.splice(0);
  for (const button of await page.$$(".notice button:last-child")) await button.click();
  // A page without a server has no folder for temporary files.
  if (offline) return;
  await dropped("cord", { "cord_height.png": readFileSync(join(folder, "ribs.png")) });
  await page.waitForSelector("dialog[open]");
  await page.fill("#map-width_mm", "60");
  await page.fill("#map-depth_mm", "0.5");
  await page.keyboard.press("Enter");
  await shown(page, "cord");
  await page.click("#take-button");
  const { bytes } = await downloaded(page, () => page.click('.kind[data-ending="asp"]'));
  await page.keyboard.press("Escape");
  run(asperity, folder, "import", "surface", "cord", "--width-mm", "60", "--depth-mm", "0.5", "-o", "cord.asp", "--quiet");
  assert(bytes.equals(readFileSync(join(folder, "cord.asp"))), "a folder with a material's pictures becomes the texture of asperity import surface");
}

/** `offline` where the page comes from files alone. */
export async function files(visit, { assert, asperity, work, offline = false }) {
  const folder = join(work, "files");
  mkdirSync(folder);
  const tools = { assert, asperity, folder, offline };
  await visit.compile("wet ice");
  await out(visit, tools);
  await kept(visit, tools);
  await opened(visit, tools);
  await map(visit, tools);
  await list(visit, tools);
  await folders(visit, tools);
}
