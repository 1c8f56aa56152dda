// Steering as a person does it: sliders, words, seed, blend, compose, undo, slots; every texture has the bytes that the shown
// command lines write.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { Events } from "../page/events.js";
import { Session } from "../page/steer/session.js";
import { compare } from "./compare.mjs";
import { clean } from "./aid.mjs";
import { after, bytesOf, same, shown } from "./steering.mjs";

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
  assert((await place("rough")) === before + 12 && keyed.told.includes("rough +12"), "twelve keys make one edit of 12 steps");
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
  const loader = Object.assign(new Events(), { take: (make, how) => loader.show(how.entry.texture, how),
    show: (texture, how) => loader.emit("shown", { texture, how }) });
  const kept = new Session(loader);
  const texture = (n) => ({ id: `${n}`, name: "", inspect: {} });
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
  await clean(page, tools.assert, "with everything open", "dark");
  await page.click(".finer summary");
}

/** A texture without a latent, as of a file. */
async function encoded(visit, tools) {
  const { page } = visit;
  if (!tools.asperity) return;
  const file = join(tools.work, "grit.asp");
  execFileSync(tools.asperity, ["builtin", "-o", file, "--quiet"], { stdio: "ignore" });
  const bytes = readFileSync(file);
  const opened = await page.evaluate(async (bytes) => {
    const response = await fetch("api/open?name=grit.asp", { method: "POST", headers: { "Content-Type": "application/octet-stream" },
      body: new Uint8Array(bytes) });
    const answer = await response.json();
    return answer.texture ?? answer;
  }, [...bytes]);
  const open = (route) => route.fulfill({ json: opened });
  await page.route("**/api/compile", open);
  await after(page, () => page.fill("#prompt", "grit").then(() => page.press("#prompt", "Enter")));
  await page.unroute("**/api/compile", open);
  tools.assert((await page.$$(".axis input:enabled")).length === 0, "a texture without a latent has no sliders to move");
  const now = await after(page, () => page.click("#feel > button"));
  tools.assert((await page.$$(".axis input:enabled")).length === 4, "but once it is encoded");
  await same(page, tools, now, "encoding", { "grit.asp": bytes });
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
  assert(made.told.includes("cork") && (await page.$$("[data-key=gone]")).length === 0, "and can be asked for again");
  assert((await page.inputValue("#prompt")) === "cork", "with its prompt");
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
  await compare(visit, tools);
  await encoded(visit, tools);
  await refusals(visit, tools);
}
