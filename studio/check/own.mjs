// My library: textures are kept with names, notes and tags, several at once, and become a library's file.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { clean, downloaded, run } from "./aid.mjs";

const rows = (page) => page.$$eval(".kept .kept-name", (all) => all.map(({ value }) => value));
const until = (page, holds, argument) => page.waitForFunction(holds, argument, { timeout: 20000 });

/** Keeps two textures, and saves them as one file. */
export async function kept(visit, { assert, asperity, folder }) {
  const { page } = visit;
  await visit.compile("wet ice");
  await page.click("#keep");
  await visit.compile("cork");
  await page.focus("#stage");
  await page.keyboard.press("k");
  assert((await rows(page)).join() === "cork,wet ice" && (await page.getAttribute("#keep", "aria-pressed")) === "true", "a star and the key K keep what is on the surface");
  const name = page.locator(".kept li:first-child .kept-name");
  await name.fill("wet ice");
  await name.press("Enter");
  assert((await page.textContent("#own .error")).includes("Two textures are named “wet ice”"), "a name that is there twice is refused by name");
  await name.fill("dry cork");
  await page.fill(".kept li:first-child .kept-note", "for the arena’s floor");
  await page.fill(".kept li:first-child .kept-tags", "#floor, warm");
  await page.keyboard.press("Tab");
  assert((await page.textContent("#own .error")) === "" && (await page.inputValue(".kept li:first-child .kept-tags")) === "floor, warm", "names, notes and tags are taken");
  const { bytes, name: file } = await downloaded(page, () => page.click("#pack"));
  run(asperity, folder, "compile", "cork", "-o", "cork.asp", "--quiet");
  writeFileSync(join(folder, "session.csv"), "name,asset\nwet ice,wet ice.asp\ndry cork,cork.asp\n");
  run(asperity, folder, "build", "session.csv", "-o", "session.aspl", "--no-cache", "--quiet");
  assert(bytes.equals(readFileSync(join(folder, "session.aspl"))), `“${file}” has the bytes of asperity build`);
  await clean(page, assert, "with textures that are kept", "light");

  await page.click("#own button >> text=Show in the gallery");
  await page.fill("#gallery-search", "ARENA #floor");
  await until(page, () => document.querySelectorAll(".cell").length === 1);
  assert((await page.getAttribute(".cell", "aria-selected")) === "true", "the gallery finds them by notes and tags, and marks the one on the surface");
  await page.fill("#gallery-search", "");
  await until(page, () => document.querySelectorAll(".cell").length === 2);
  await page.click('.cell[data-index="0"]');
  await until(page, () => document.getElementById("surface-title").textContent === "wet ice");
  await page.click("#like");
  await until(page, () => document.querySelector(".cell")?.title.startsWith("wet ice"));
  assert((await page.textContent("#gallery-order option:checked")) === "Like “wet ice”", "and orders them by what is like it");
  await page.selectOption("#gallery-order", "library");
  await page.focus(".cells");
  await page.keyboard.press("Control+a");
  await page.fill(".chosen input", "both");
  await page.keyboard.press("Enter");
  assert((await page.inputValue(".kept li:last-child .kept-tags")) === "both", "several take a tag at once");
  await page.click(".chosen button >> text=Remove them");
  await until(page, () => document.querySelectorAll(".kept li").length === 0);
  await page.click("[data-key=gone-own] button >> text=Undo");
  assert((await rows(page)).join() === "dry cork,wet ice", "and what is let go can be taken back");
  for (const button of await page.$$(".kept li > button:last-child")) await button.click();
  await page.click("[data-key=gone-own] button >> text=Undo");
  assert((await rows(page)).join() === "dry cork,wet ice", "one after the other, too");
  await page.fill(".kept li:first-child .kept-name", "wet ice");
  await page.click("#pack");
  assert((await page.getAttribute(".kept-name:focus", "aria-invalid")) === "true", "nothing is saved under a name that was refused");
  for (const button of await page.$$(".kept li > button:last-child")) await button.click();
  assert((await page.textContent("#own .error")) === "", "and the refusal goes with its texture");
  assert((await page.$("#gallery-library option[value=own]")) === null, "without any, the gallery has no such library");
  await page.click("[data-key=gone-own] button:last-child");
  await page.click("#views label:nth-child(1)");
}

/** Keeps a part of the library that the gallery shows. */
export async function several({ page }, { assert }) {
  const MANY = 60;
  await page.focus(".cells");
  await page.keyboard.press("Home");
  await page.click('.cell[data-index="0"]', { modifiers: ["Control"] });
  await page.click("#several");
  for (let n = 0; n < 40 && !(await page.$(`.cell[data-index="${MANY - 1}"]`)); n++) {
    await page.$eval(".cells", (list) => (list.scrollTop += 200));
    await page.waitForTimeout(30);
  }
  await page.click(`.cell[data-index="${MANY - 1}"]`, { modifiers: ["Shift"] });
  assert((await page.textContent(".chosen [role=status]")) === `${MANY} chosen`, `${MANY} are chosen from the first to the last`);
  const before = (await rows(page)).length;
  await page.click("#keep-chosen");
  await until(page, (count) => document.querySelector("#own .told").textContent.startsWith(`${count} textures`), before + MANY);
  assert((await page.$$(".cell.kept")).length > 4, "all are kept at once, and have a star");
  await page.click(".ranges summary");
  await page.selectOption("#gallery-certainty", "known");
  await until(page, () => document.querySelector(".tools [role=status]").textContent.includes(" of "));
  const [known] = (await page.textContent(".tools [role=status]")).split(" ");
  assert(Number(known.replace(",", "")) >= 100, `certainty is a filter: ${known} are known`);
  await page.click(".ranges button");
  await page.click(".ranges summary");
}
