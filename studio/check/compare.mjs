// The slots of the comparison: switching, levels, and what may be seen while it is blind.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Fft } from "../page/plots/fft.js";
import { clean } from "./aid.mjs";
import { after, bytesOf, shown } from "./steering.mjs";

/** What levels are matched at. */
const STROKE = { speed_mm_s: 100, force_n: 1, seconds: 30, rate_hz: 1000 };
const FLOOR_HZ = 40;

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
  await page.uncheck("#match");
}
