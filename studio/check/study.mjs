// A scripted participant goes through a whole study, whatever its steps are: strokes and taps with the mouse and by keys, moves
// sliders, reloads in the middle, opens a second tab, loses the network; and asserts what the page does then.
//
//   STUDIO_MODULES=…/node_modules node study.mjs ADDRESS CHROMIUM [STUDY.toml]
//
// ADDRESS is that of a running study with a place for two participants; the names of the textures in STUDY.toml must not be
// seen. STUDIO_PICTURES is a folder that takes screenshots.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { assert, axe, chromium, count } from "./chromium.mjs";

const [address, executablePath, toml] = process.argv.slice(2);
const pictures = process.env.STUDIO_PICTURES;
/** Sizes and schemes that each step is looked at in: all of them where the whole example is gone through. */
const SIZES = process.env.STUDY_WHOLE ? [[1280, 720], [360, 740]] : [[360, 740]];
const SCHEMES = /** @type {const} */ (process.env.STUDY_WHOLE ? ["light", "dark"] : ["dark"]);
/** Rounds of strokes and a tap after which every surface has been explored. */
const MOST_ROUNDS = 40;

/** Names and prompts of the textures. */
const names = toml ? readFileSync(toml, "utf8").split(/^\[\[?/m).filter((part) => part.startsWith("texture]]"))
  .flatMap((part) => [...part.matchAll(/^(?:name|prompt)\s*=\s*"(.*)"/gm)].map(([, name]) => name)) : [];
/** Those that a text has as words. */
const named = (text) => names.filter((name) => new RegExp(`\\b${name.replaceAll(/[^\w\s]/g, ".")}\\b`, "i").test(text));

class Participant {
  step = null;
  answers = [];
  urls = [];
  errors = [];
  looked = new Set();

  static async begin(context) {
    const participant = new Participant();
    const page = await context.newPage();
    Object.assign(participant, { context, page });
    page.on("request", (request) => {
      participant.urls.push(request.url());
      if (request.url().includes("api/answer")) participant.answers.push({ url: request.url(), body: request.postData() });
    });
    page.on("response", async (response) => {
      if (response.ok() && response.url().includes("api/step")) participant.step = await response.json().catch(() => null);
    });
    page.on("console", (message) => {
      // What the check does on purpose.
      if (message.type() === "error" && !/409|ERR_INTERNET_DISCONNECTED/.test(message.text())) participant.errors.push(message.text());
    });
    page.on("pageerror", (error) => participant.errors.push(error.stack || String(error)));
    await page.goto(address);
    return participant;
  }

  kind() {
    return this.page.evaluate(() => document.getElementById("main").dataset.kind);
  }

  /** Waits until the step of an index is shown; from a reload on, behind a click. */
  async shown(index) {
    await this.page.waitForFunction((index) => {
      const { dataset } = document.getElementById("main");
      return dataset.kind !== "wait" && dataset.index === String(index);
    }, index);
    await this.page.waitForTimeout(100);
    assert(this.step.index === index, `step ${index + 1} of ${this.step.of} is open: ${this.step.form ?? this.step.kind}`);
    assert(await this.page.evaluate(() => document.activeElement.id === "heading"), "its heading has the focus");
  }

  blocked() {
    return this.page.isDisabled("#next");
  }

  missing() {
    return this.page.textContent("#missing");
  }

  async stroke() {
    const { mouse } = this.page;
    const { x, y, width, height } = await this.page.locator("#stage").boundingBox();
    const [left, middle, reach] = [x + width / 4, y + height / 2, width / 2];
    await mouse.move(left, middle);
    await mouse.down();
    for (let n = 1; n <= 60; n++) await mouse.move(left + reach * Math.abs(((n / 20) % 2) - (n > 40 ? 2 : 0)), middle);
    await mouse.up();
    await this.page.waitForTimeout(150);
  }

  async tap() {
    await this.page.mouse.down();
    await this.page.waitForTimeout(120);
    await this.page.mouse.up();
    await this.page.waitForTimeout(150);
  }

  /** By keys alone: from the heading to the surface. */
  async strokeByKeys() {
    const { keyboard } = this.page;
    await this.page.focus("#heading");
    await keyboard.press("Tab");
    assert(await this.page.evaluate(() => document.activeElement.id === "stage"), "the surface is one tab from the heading");
    for (const key of ["ArrowLeft", "ArrowRight"]) {
      await keyboard.down(key);
      await this.page.waitForTimeout(400);
      await keyboard.up(key);
      await this.page.waitForTimeout(100);
    }
    await keyboard.press(" ", { delay: 120 });
    await this.page.waitForTimeout(150);
  }

  /** Explores until `done`, by the mouse or by keys. */
  async explore(done, byKeys = false) {
    for (let n = 0; n < MOST_ROUNDS && !(await done()); n++) {
      if (byKeys) await this.strokeByKeys();
      else {
        await this.stroke();
        await this.tap();
      }
    }
    assert(await done(), `the surface is explored ${byKeys ? "by keys alone" : "with the mouse"}`);
  }

  async fill() {
    for (const input of await this.page.locator("input.rate").all()) {
      await input.focus();
      await this.page.keyboard.press(Math.random() < 0.5 ? "ArrowLeft" : "PageUp");
    }
    for (const points of await this.page.locator(".points").all()) await points.locator("label").nth(1).click();
    for (const input of await this.page.locator("textarea").all()) await input.fill("It was, “so to speak”, fine.\nYes, €.");
  }

  /** What of the page as it is must hold, at each size and in each scheme; once for what looks alike. */
  async look(what) {
    if (this.looked.has(what)) return;
    this.looked.add(what);
    await this.page.evaluate(axe);
    for (const [width, height] of SIZES) {
      await this.page.setViewportSize({ width, height });
      for (const colorScheme of SCHEMES) {
        await this.page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
        await this.page.waitForTimeout(150);
        const at = `${what}, ${colorScheme}, ${width} px`;
        const fits = await this.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
        assert(fits, `nothing is cut off at the side: ${at}`);
        const { violations } = await this.page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
        const list = violations.map(({ id, nodes }) => `; ${id}: ${nodes.map(({ target }) => target).join(", ")}`);
        assert(list.length === 0, `axe finds nothing: ${at}${list.join("")}`);
        const file = `study-${what}-${colorScheme}-${width}.png`.replaceAll(" ", "-");
        if (pictures) await this.page.screenshot({ path: join(pictures, file), fullPage: true });
      }
    }
    await this.page.setViewportSize({ width: 1280, height: 720 });
    await this.page.emulateMedia({ colorScheme: "light" });
  }

  /** Presses the button that leads on; its answer is sent once. */
  async next() {
    const before = this.answers.length;
    const { index } = this.step;
    await this.page.click("#next");
    await this.page.waitForFunction((index) => document.getElementById("main").dataset.index !== String(index), index);
    assert(this.answers.length === before + 1, "it is answered, by one request");
  }
}

/** Another tab of the same participant: its answer is refused, and it goes on with the step that is open. */
async function twoTabs(one) {
  const other = await Participant.begin(one.context);
  await other.shown(0);
  await one.next();
  await other.page.click("#next");
  await other.page.waitForSelector("[data-key=elsewhere]");
  await other.shown(1);
  assert(other.answers.length === 1, "a second tab is told that its step was answered, and shows the one that is open");
  await other.page.close();
}

/** A reload in the middle of a step. */
async function reload(one) {
  const { index } = one.step;
  await one.page.reload();
  await one.page.waitForSelector("#next:not([hidden])");
  assert((await one.page.textContent("#heading")) === "Welcome back", "after a reload a click is asked for, since it lets the page sound");
  await one.look("resumed");
  await one.page.click("#next");
  await one.page.waitForSelector("[data-kind=rating], [data-kind=prompt]");
  await one.shown(index);
}

/** The network is gone while an answer is sent. */
async function offline(one) {
  await one.context.setOffline(true);
  await one.page.click("#next");
  await one.page.waitForSelector("[data-key=server]");
  assert(await one.blocked(), "while the server is silent, that is said, and nothing can be sent twice");
  await one.look("silent");
  await one.context.setOffline(false);
  const { index } = one.step;
  await one.page.click("[data-key=server] button").catch(() => {});
  await one.shown(index + 1);
  assert((await one.page.$("[data-key=server], [data-key=elsewhere]")) === null, "it is answered when the server is back");
}

async function repeated(one) {
  const { url, body } = one.answers.at(-1);
  const status = await one.page.evaluate(async ([url, body]) =>
    (await fetch(url, { method: "POST", headers: { "Content-Type": "application/json" }, body })).status, [url, body]);
  assert(status === 409, "an answer that is sent again is refused with 409");
}

/** Nothing of the condition is seen: neither in what the server tells of the step, nor in the page. */
async function hidden(one) {
  const { attributes, title, ...step } = one.step;
  assert(named(JSON.stringify(step)).length === 0, "the step does not name its texture");
  const html = await one.page.evaluate(() => document.documentElement.outerHTML);
  const own = named(JSON.stringify({ attributes, title }));
  assert(named(html).filter((name) => !own.includes(name)).length === 0, "nor does the page");
}

async function rating(one, nth) {
  await hidden(one);
  const { explore, practice, picture } = one.step;
  const asks = explore.strokes > 0 || explore.taps > 0 || explore.seconds > 0;
  assert(await one.blocked(), `what is missing is said: “${await one.missing()}”`);
  await one.look(`${practice ? "practice" : "rating"} with${picture ? "" : "out"} picture`);
  if (nth === 0) {
    await one.stroke();
    await reload(one);
    await one.fill();
    assert(!asks || (await one.blocked()), `with all sliders moved it is still blocked: “${await one.missing()}”`);
    await one.explore(async () => !(await one.blocked()));
  } else {
    await one.explore(async () => !/stroke|tap|touch/.test(await one.missing()), nth === 1);
    assert(await one.blocked(), `explored, with no slider moved, it is blocked: “${await one.missing()}”`);
    await one.fill();
    assert(!(await one.blocked()), "it is free when all sliders were moved");
  }
}

async function prompt(one) {
  assert(await one.blocked(), `what is missing is said: “${await one.missing()}”`);
  await one.look("prompt");
  for (let n = 0; n < one.step.tries; n++) {
    await one.page.fill("#words", n === 0 ? "wet ice" : "wet ice, rougher");
    await one.page.press("#words", "Enter");
    await one.page.waitForFunction(() => document.getElementById("said").textContent.startsWith("This is"));
    await one.page.waitForFunction(() => !document.querySelector(".words-form [aria-busy]"));
    if (n === 0) await one.look("prompt tried");
    await one.explore(async () => !(await one.blocked()));
  }
  assert(await one.page.isDisabled("#words"), `${one.step.tries} tries are all`);
}

async function withdraws(browser) {
  const one = await Participant.begin(await browser.newContext());
  await one.page.waitForFunction(() => document.getElementById("main").dataset.kind !== "wait");
  if (!(await one.page.isVisible("#withdraw"))) return console.log("  the study is full: nobody withdraws");
  await one.page.click("#withdraw");
  await one.look("withdrawal");
  await one.page.click("#withdraw-no");
  assert((await one.kind()) === "consent", "who does not withdraw goes on");
  await one.page.click("#withdraw");
  await one.page.click("#withdraw-yes");
  await one.page.waitForSelector("[data-kind=end]");
  assert(!(await one.page.isVisible("#next")) && !(await one.page.isVisible("#withdraw")), "who withdraws is told that nothing is kept");
  await one.context.close();
}

const began = Date.now();
/** As browsers are: no sound before a click. */
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
try {
  const one = await Participant.begin(await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: "light" }));
  let ratings = 0;
  for (let index = 0; ; index++) {
    await one.shown(index);
    const { kind, form, device } = one.step;
    assert(!device, "no device is asked for");
    if (kind === "end") break;
    if (kind === "rating") await rating(one, ratings);
    else if (kind === "prompt") await prompt(one);
    else {
      // Texts may stay empty.
      const asks = kind === "break" || one.step.items?.some(({ text }) => !text);
      if (asks) assert(await one.blocked(), `what is missing is said: “${await one.missing()}”`);
      await one.look(form ?? kind);
      await one.fill();
      await one.page.waitForSelector("#next:enabled", { timeout: 1000 * ((one.step.seconds ?? 0) + 5) });
    }
    if (kind === "consent") await twoTabs(one);
    else if (kind === "rating" && ratings === 1) await offline(one);
    else await one.next();
    if (index === 1) await repeated(one);
    if (kind === "rating") ratings++;
  }
  await one.look("end");
  assert(!(await one.page.isVisible("#next")), "the end is the last step");
  const stimuli = one.urls.filter((url) => url.includes("api/stimulus"));
  const opaque = stimuli.every((url) => /\/api\/stimulus\/[^/]+\/[\w-]+\.(worklet\.asp|unlit\.png|normal\.png)$/.test(url));
  assert(opaque && named(decodeURI(one.urls.join("\n"))).length === 0, `${stimuli.length} requests name no texture`);
  const told = one.answers.map(({ body }) => JSON.parse(body)).filter(({ exploration }) => exploration);
  const sums = told.every(({ contact_s, exploration }) =>
    exploration.length === 36 && Math.abs(exploration.reduce((sum, s) => sum + s, 0) - contact_s) < 0.01);
  assert(sums, `${told.length} explorations have their time in contact in 36 bins`);
  await withdraws(browser);
  assert(one.errors.length === 0, `no error on the console${one.errors.map((text) => `: ${text}`).join("")}`);
  console.log(`${count} claims hold, ${((Date.now() - began) / 1000).toFixed(0)} s`);
} finally {
  await browser.close();
}
