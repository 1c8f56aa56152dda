// The slots of the comparison: switching, levels, and what may be seen while it is blind.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { clean } from "./aid.mjs";
import { levelOf } from "./loudness.mjs";
import { after, bytesOf, shown } from "./steering.mjs";

/** `tools` as of `steer`. */
export async function compare(visit, tools) {
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

  const found = [];
  for (const n of [0, 1]) {
    await after(page, () => page.click(slot(n)), ({ told }) => told.includes(prompts[n]));
    await page.waitForTimeout(400);
    const { id } = await shown(page);
    const file = join(tools.work, `level-${n}.asp`);
    writeFileSync(file, await bytesOf(page, id));
    // The second node of a chain turns it up or down.
    const gain_db = await page.evaluate(() => {
      const own = window.studioCheck.gains.filter(({ context }) => context === window.studioCheck.contexts.at(-1));
      return 20 * Math.log10(own[1].gain.value);
    });
    found.push({ gain_db, level: tools.asperity ? levelOf(tools.asperity, file) : 0 });
  }
  const [a, b] = found.map(({ gain_db, level }) => gain_db + level);
  const apart = Math.abs(found[0].level - found[1].level).toFixed(1);
  if (tools.asperity) assert(Math.abs(a - b) < 0.5, `slots ${apart} dB apart play ${(a - b).toFixed(2)} dB apart`);
  assert((await page.textContent("#turned")).includes("dB"), "the page says by how much it turns what plays");
  const level_db = async () => Number((await page.inputValue("#level")));
  await page.uncheck("#equal");
  assert((await page.textContent("#turned")) === "", "or leaves each as strong as it is");
  const before_db = await level_db();
  await after(page, () => page.click(slot(0)), ({ told }) => told.includes(prompts[0]));
  await page.waitForFunction((was) => Number(document.getElementById("level").value) < was, before_db);
  const turned_db = before_db - (await level_db());
  assert(found[0].level - found[1].level - turned_db < 6.6, `then what is ${apart} dB louder comes with a level ${turned_db} dB lower`);
  await page.fill("#level", String(before_db));
  await page.check("#equal");

  await clean(page, tools.assert, "with slots", "light");
  await page.click("#blind");
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
  await clean(page, tools.assert, "while comparing blindly", "dark");
  await page.keyboard.press("Control+z");
  assert(await page.evaluate(() => document.body.classList.contains("blind")), "undo does not give it away");
  await page.click("#blind");
  await page.waitForFunction(() => !document.body.classList.contains("blind"));
  const told = await page.textContent("#compare .told");
  const third = /3 was ([A-D]), ([^;·]+)/.exec(told);
  await page.waitForFunction((name) => document.getElementById("surface-title").textContent === name, third[2].trim());
  assert(/1 was [A-D], .*2 was [A-D], /.test(told), `revealed: ${told}`);
  await clean(page, assert, "revealed", "light");
}
