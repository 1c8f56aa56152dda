// Steering as a person does it: sliders, words, seed, blend, compose, undo, slots; every texture has the bytes that the shown
// command lines write.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Fft } from "../page/plots/fft.js";
import { Session } from "../page/steer/session.js";

/** Time after which what rests is released, and what is asked for is shown, ms. */
const PATIENCE_MS = 15000;
const STROKE = { speed_mm_s: 100, force_n: 1, seconds: 30, rate_hz: 1000 };
const FLOOR_HZ = 40;

/** What the page shows now: the identity of the texture, and how many the session has. */
const shown = (page) => page.evaluate(() => ({
  told: document.querySelector("#timeline .told").textContent,
  id: document.querySelector("#timeline .tile[aria-current] img")?.src.match(/texture\/(\w+)/)[1],
  count: document.querySelectorAll("#timeline .tile").length,
  command: document.querySelector("#command code")?.textContent,
}));

/** Does something, and waits for what the page shows then. */
async function after(page, act, what = ({ told }, before) => told !== before.told) {
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

const bytesOf = async (page, id) => Buffer.from(await page.evaluate(async (id) => {
  const response = await fetch(`api/texture/${id}.asp`);
  return Array.from(new Uint8Array(await response.arrayBuffer()));
}, id));

/** Runs command lines in a folder of their own; the bytes of the file that the last one writes. */
function written({ asperity, work }, lines, name) {
  const folder = join(work, name);
  mkdirSync(folder);
  execFileSync("sh", ["-ec", `asperity() { "$PROGRAM" "$@" --quiet >/dev/null; }\n${lines}`],
    { cwd: folder, env: { ...process.env, PROGRAM: asperity }, stdio: ["ignore", "ignore", "inherit"] });
  const [, quoted, plain] = /-o (?:'((?:[^']|'\\'')*)'|(\S+))/.exec(lines.split("\n").at(-1));
  return readFileSync(join(folder, plain ?? quoted.replaceAll("'\\''", "'")));
}

async function same(page, tools, now, what) {
  if (!tools.asperity) return;
  const wanted = written(tools, now.command, what.replaceAll(/\W+/g, "-"));
  tools.assert(wanted.equals(await bytesOf(page, now.id)), `${what}: the bytes of ${now.command.split("\n").at(-1)}`);
}

/** What axe says of the page as it is; nothing where the page was not given axe. */
async function clean(page, { assert }, media, width, what) {
  await page.emulateMedia({ ...media, reducedMotion: "reduce" });
  await page.setViewportSize({ width, height: 800 });
  await page.waitForTimeout(150);
  const violations = await page.evaluate(async () => (window.axe ? (await window.axe.run(document, { resultTypes: ["violations"] })).violations : []));
  const list = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(", ")}`);
  assert(list.length === 0, `axe finds nothing ${what}, ${media.colorScheme}, ${width} px${list.map((text) => `; ${text}`).join("")}`);
  assert(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "nothing is cut off at the side");
  await page.emulateMedia({ colorScheme: "light", reducedMotion: "no-preference" });
  await page.setViewportSize({ width: 1280, height: 800 });
}

async function sliders(visit, tools) {
  const { page } = visit;
  const { assert } = tools;
  await visit.compile("cork");
  const start = await shown(page);
  const place = async (axis) => Number(await page.inputValue(`#slider-${axis}`));
  const before = await place("rough");
  await page.focus("#slider-rough");
  const keyed = await after(page, async () => {
    for (let n = 0; n < 12; n++) await page.keyboard.press("ArrowRight");
    assert((await page.textContent("#draft")) === "Draft", "what a slider plays is marked as a draft");
  }, ({ count }, { count: was }) => count > was);
  assert((await place("rough")) === before + 12 && keyed.told.includes("rougher +12"), "twelve keys make one edit of 12 steps");
  assert((await page.textContent("#draft")) === "", "which is no draft once the slider rests");
  await same(page, tools, keyed, "a slider by keys");

  const track = await page.locator("#slider-hard").boundingBox();
  const asked = { now: 0, most: 0, all: 0 };
  const begins = (request) => {
    if (!request.url().endsWith("/api/edit")) return;
    asked.all++;
    asked.most = Math.max(asked.most, ++asked.now);
  };
  const ends = (request) => request.url().endsWith("/api/edit") && asked.now--;
  const listeners = { request: begins, requestfinished: ends, requestfailed: ends };
  for (const [name, listen] of Object.entries(listeners)) page.on(name, listen);
  const dragged = await after(page, async () => {
    const y = track.y + track.height / 2;
    await page.mouse.move(track.x + track.width * 0.3, y);
    await page.mouse.down();
    for (let n = 1; n <= 25; n++) {
      await page.mouse.move(track.x + track.width * (0.3 + 0.016 * n), y);
      await page.waitForTimeout(12);
    }
    await page.mouse.up();
  }, ({ count }, { count: was }) => count > was);
  for (const [name, listen] of Object.entries(listeners)) page.off(name, listen);
  assert(asked.most === 1, `a dragged slider asks one thing at a time, ${asked.all} for 26 positions`);
  const commands = dragged.command.split("\n");
  assert(commands.length === 2 && commands[1].includes("--rougher 12") && commands[1].includes("--harder"),
    "two sliders make one edit of what was there before them");
  await same(page, tools, dragged, "a slider by the pointer");

  const undone = await after(page, () => page.keyboard.press("Control+z"));
  assert(undone.id === keyed.id && (await bytesOf(page, undone.id)).equals(await bytesOf(page, keyed.id)), "Ctrl+Z brings back the edit before");
  const first = await after(page, () => page.keyboard.press("Control+z"));
  assert(first.id === start.id && (await place("rough")) === before, "and the prompt, with its sliders");
  const redone = await after(page, () => page.keyboard.press("Control+Shift+z"));
  assert(redone.id === keyed.id && (await place("rough")) === before + 12, "Ctrl+Shift+Z brings the edit again");
  await after(page, () => page.keyboard.press("Control+y"));
  // From the base again, not from what the edit gave.
  await page.focus("#slider-hard");
  const again = await after(page, () => page.keyboard.press("ArrowLeft"), ({ count, told }, was) => told !== was.told);
  assert(again.command.split("\n").length === 2, "a slider goes on from where it began");
}

/** The list of textures by itself: how many it keeps, and which one a step leads to. */
function session({ assert }) {
  const loader = { onshown: [], onrefused: [], take: (make, how) => loader.show(how.entry.texture, how),
    show: (texture, how) => loader.onshown.forEach((hear) => hear(texture, how)) };
  const kept = new Session(loader);
  const texture = (n) => ({ id: `${n}` });
  for (let n = 0; n < 260; n++) loader.show(texture(n), { kind: "prompt" });
  assert(kept.entries.length === 200 && kept.current.texture.id === "259", "200 textures are kept for undo, the last ones");
  for (let n = 0; n < 300; n++) kept.undo();
  assert(kept.current.texture.id === "60" && !kept.canUndo, "undo ends at the oldest");
  kept.redo();
  const dropped = kept.entries[3];
  loader.show(texture(260), { kind: "prompt" });
  loader.show(texture(260), { kind: "prompt" });
  assert(kept.entries.map(({ texture: { id } }) => id).join() === "60,61,260", "what is new takes the place of what was undone, once");
  kept.undo();
  kept.show(dropped);
  assert(kept.entries.map(({ texture: { id } }) => id).join() === "60,61,63,260" && kept.current === dropped, "a slot brings back what was dropped");
}

async function words(visit, tools) {
  const { page } = visit;
  const now = await after(page, async () => {
    await page.fill("#words", "less gritty, more waxy");
    await page.press("#words", "Enter");
  });
  const understood = await page.textContent("#words-understood");
  tools.assert(/rough −\d+/.test(understood) && /slippery \+\d+/.test(understood), `words say what they moved: ${understood}`);
  await same(page, tools, now, "words");
  await page.fill("#words", "less quantum");
  await page.press("#words", "Enter");
  await page.waitForFunction(() => document.querySelector("#words-panel .error").textContent !== "");
  tools.assert((await shown(page)).id === now.id, `what is not understood is refused: ${await page.innerText("#words-panel .error")}`);
  await page.fill("#words", "");
}

async function seed(visit, tools) {
  const { page } = visit;
  await visit.compile("cork");
  const now = await after(page, () => page.click("#piece button"));
  tools.assert((await page.textContent("#piece")).includes("Seed 1"), "another piece has the next seed");
  await same(page, tools, now, "another piece");
}

async function mixtures(visit, tools) {
  const { page } = visit;
  await visit.compile("wet ice");
  await page.click(".mix summary");
  await page.selectOption("#mix-a", "words");
  await page.fill("#mix-a-words", "brushed steel");
  await page.press("#mix-a-words", "Tab");
  await page.selectOption("#mix-b", { index: (await page.$$("#mix-b option")).length - 2 });
  await page.focus("#mix-t");
  const blended = await after(page, () => page.keyboard.press("ArrowRight"));
  tools.assert(blended.command.includes("-t 0.51"), "two textures are blended by a slider");
  await same(page, tools, blended, "a blend");
  await page.selectOption("#mix-tap", "words");
  await page.fill("#mix-tap-words", "cork");
  await page.press("#mix-tap-words", "Tab");
  await page.selectOption("#mix-friction", "e0");
  const composed = await after(page, () => page.click("#mix fieldset:nth-child(2) > button"));
  await same(page, tools, composed, "a composition");
  await page.click(".finer summary");
  await clean(page, tools, { colorScheme: "dark" }, 360, "with everything open");
  for (const part of [".mix", ".finer"]) await page.click(`${part} summary`);
}

/** Level above 40 Hz that the command renders for a steady stroke, dB. */
function level_db({ asperity, work }, bytes, name) {
  const { speed_mm_s, force_n, seconds, rate_hz } = STROKE;
  const [texture, input, output] = [".asp", "-in.csv", "-out.csv"].map((ending) => join(work, name + ending));
  writeFileSync(texture, bytes);
  const { wall } = JSON.parse(execFileSync(asperity, ["inspect", texture, "--json"], { maxBuffer: 1 << 26 }));
  const z_mm = (-1000 * force_n) / wall.stiffness_n_m;
  const rows = Array.from({ length: seconds * rate_hz }, (_, n) => `${n / rate_hz},${(speed_mm_s * n) / rate_hz},0,${z_mm}`);
  writeFileSync(input, `t_s,x_mm,y_mm,z_mm\n${rows.join("\n")}\n`);
  execFileSync(asperity, ["render", texture, "--rate", `${rate_hz}`, "--trajectory", input, "-o", output, "--seed", "1", "--quiet"],
    { stdio: "ignore" });
  const [header, ...lines] = readFileSync(output, "utf8").trimEnd().split("\n");
  const column = header.split(",").indexOf("vib_m_s2");
  const x = Float64Array.from(lines.slice(rate_hz), (line) => Number(line.split(",")[column]));
  const fft = new Fft(1024);
  let [power, windows] = [0, 0];
  for (let at = 0; at + fft.size <= x.length; at += fft.size / 2, windows++) {
    fft.density(x.subarray(at, at + fft.size), rate_hz).forEach((density, k) => {
      if ((k * rate_hz) / fft.size >= FLOOR_HZ) power += (density * rate_hz) / fft.size;
    });
  }
  return 10 * Math.log10(power / windows);
}

async function slots(visit, tools) {
  const { page } = visit;
  const { assert } = tools;
  const slot = (n) => `#compare .slot >> nth=${n}`;
  const prompts = ["rough abrasive sheet with gritty particles", "cork", "wet ice"];
  for (const [n, prompt] of prompts.entries()) {
    await visit.compile(prompt);
    await page.click(slot(n));
  }
  const title = () => page.textContent("#surface-title");
  await page.focus("#stage");
  await page.keyboard.press("1");
  await page.waitForFunction((name) => document.getElementById("surface-title").textContent === name, prompts[0]);
  assert((await page.getAttribute(slot(0), "aria-pressed")) === "true", "key 1 switches to slot A");
  await page.focus("#prompt");
  await page.keyboard.type("2");
  assert((await title()) === prompts[0] && (await page.inputValue("#prompt")).endsWith("2"), "but not in a text field");

  await page.click("#sound-switch");
  await page.waitForFunction(() => window.studioCheck.contexts.at(-1)?.state === "running");
  const swaps = () => page.evaluate(() => window.studioCheck.statuses.filter(({ about, name }) => about === "swap" && name === "ok").length);
  const was = await swaps();
  await page.click(slot(1));
  await page.waitForFunction((was) => window.studioCheck.statuses.filter(({ about, name }) => about === "swap" && name === "ok").length > was, was);
  assert((await title()) === "cork", "a click cross-fades to slot B");

  await page.check("#match");
  const found = [];
  for (const n of [0, 1]) {
    await after(page, () => page.click(slot(n)), ({ told }) => told.includes(prompts[n]));
    await page.waitForTimeout(300);
    const { id } = await shown(page);
    const said_db = Number(/ (−?[\d.]+) dB$/.exec(await page.textContent("#compare .told"))[1].replace("−", "-"));
    const gains_db = await page.evaluate(() => window.studioCheck.gains.map(({ gain }) => 20 * Math.log10(gain.value)));
    assert(gains_db.some((gain_db) => Math.abs(gain_db - said_db) < 0.1), `slot ${"AB"[n]} is turned by the ${said_db} dB that the page says`);
    const level = tools.asperity ? level_db(tools, await bytesOf(page, id), `level-${n}`) : 0;
    found.push({ gain_db: said_db, level });
  }
  const [a, b] = found.map(({ gain_db, level }) => gain_db + level);
  const apart = Math.abs(found[0].level - found[1].level).toFixed(1);
  if (tools.asperity) assert(Math.abs(a - b) < 0.5, `slots ${apart} dB apart play ${(a - b).toFixed(2)} dB apart with matched levels`);
  assert((await page.textContent("#compare .told")).includes("100 mm/s"), "the page says what they are matched at");

  await clean(page, tools, { colorScheme: "light" }, 1280, "with slots");
  await page.click("#compare .row button");
  await page.waitForFunction(() => document.body.classList.contains("blind"));
  await page.waitForTimeout(300);
  const seen = () => page.evaluate(() => {
    const texts = [document.title];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_ELEMENT);
    for (let at = walker.currentNode; at; at = walker.nextNode()) {
      if (!at.checkVisibility({ visibilityProperty: true, checkVisibilityCSS: true }) || at.closest("[inert]")) continue;
      texts.push(at.getAttribute("aria-label") ?? "", at.getAttribute("title") ?? "", at.tagName === "IMG" ? at.src : "", at.value ?? "");
      for (const child of at.childNodes) if (child.nodeType === 3) texts.push(child.textContent);
    }
    return texts.join("\n");
  });
  const names = [...prompts, "api/texture"];
  for (const n of [1, 2, 3]) {
    const before = await swaps();
    await page.focus("#stage");
    await page.keyboard.press(String(n));
    await page.waitForFunction((n) => document.querySelectorAll("#compare .slot")[n - 1].getAttribute("aria-pressed") === "true", n);
    const text = await seen();
    assert(names.every((name) => !text.includes(name)), `blind, number ${n} plays and no name is seen${(await swaps()) > before ? "" : " (it played already)"}`);
  }
  await clean(page, tools, { colorScheme: "dark" }, 1280, "while comparing blindly");
  await page.keyboard.press("Control+z");
  assert(await page.evaluate(() => document.body.classList.contains("blind")), "undo does not give it away");
  await page.click("#compare .row button");
  await page.waitForFunction(() => !document.body.classList.contains("blind"));
  const told = await page.textContent("#compare .told");
  const third = /3 was ([A-D]), ([^;·]+)/.exec(told);
  await page.waitForFunction((name) => document.getElementById("surface-title").textContent === name, third[2].trim());
  assert(/1 was [A-D], .*2 was [A-D], /.test(told), `revealed: ${told}`);
  await page.uncheck("#match");
}

/** The server refuses, or has a texture no longer. */
async function refusals(visit, { assert }) {
  const { page } = visit;
  await visit.compile("cork");
  const place = await page.inputValue("#slider-rough");
  const refuse = (route) => route.fulfill({ status: 422, json: { error: "the <b>place</b> is out of reach", help: "stay nearer" } });
  await page.route("**/api/edit", refuse);
  await page.focus("#slider-rough");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.getElementById("draft").textContent === "" && document.querySelector("#feel .error").textContent);
  const said = await page.innerText("#feel .error");
  assert(said.includes("<b>place</b>") && said.includes("stay nearer") && (await page.inputValue("#slider-rough")) === place,
    "a refused slider says why, as text, and goes back");
  await page.unroute("**/api/edit", refuse);

  await visit.compile("wet ice");
  const lose = (route) => route.fulfill({ status: 404, json: { error: "the server does not have this texture, or no longer", help: "compile it again" } });
  await page.route("**/*.worklet.asp", lose);
  await page.click("#timeline button >> text=Undo");
  await page.waitForSelector("[data-key=gone]");
  assert((await page.textContent("#surface-title")) === "wet ice", "a texture that the server has no longer is said");
  await page.unroute("**/*.worklet.asp", lose);
  const made = await after(page, () => page.click("[data-key=gone] button"));
  assert(made.told.includes("cork") && (await page.$$("[data-key=gone]")).length === 0, "and made again by its own steps");
  // The browser logs refused requests by itself.
  visit.errors.splice(0, visit.errors.length, ...visit.errors.filter((text) => !text.includes("status of 4")));
}

/** `tools`: { assert, asperity, work }; without `asperity`, no bytes are compared. */
export async function steer(visit, tools) {
  session(tools);
  await sliders(visit, tools);
  await words(visit, tools);
  await seed(visit, tools);
  await mixtures(visit, tools);
  await slots(visit, tools);
  await refusals(visit, tools);
}
