// One visit of the page: what a person does there, and what its renderer posts meanwhile.

import { COLUMNS } from "../page/plots/ring.js";

const PEN_HZ = 120;

/** Runs in the page before its scripts: keeps contexts and gains, and what comes from the renderer's port. */
function watch() {
  const check = (window.studioCheck = { contexts: [], chunks: [], statuses: [], gains: [], peak: 0 });
  check.text = (buffer) => btoa(Array.from(new Uint8Array(buffer), (byte) => String.fromCharCode(byte)).join(""));
  window.AudioContext = class extends AudioContext {
    constructor(...options) {
      super(...options);
      check.contexts.push(this);
    }
  };
  window.AudioWorkletNode = class extends AudioWorkletNode {
    constructor(context, name, options) {
      super(context, name, options);
      if (name !== "asperity" || !(context instanceof AudioContext)) return;
      this.port.addEventListener("message", ({ data }) => {
        if (data.type === "status") check.statuses.push(data);
        if (data.type === "ticks") check.chunks.push(data);
      });
    }
  };
  window.GainNode = class extends GainNode {
    constructor(...options) {
      super(...options);
      check.gains.push(this);
    }
  };
  // What the loudspeaker gets at most.
  const measure = AnalyserNode.prototype.getFloatTimeDomainData;
  AnalyserNode.prototype.getFloatTimeDomainData = function (samples) {
    measure.call(this, samples);
    for (const x of samples) check.peak = Math.max(check.peak, Math.abs(x));
  };
}

export class Visit {
  static async begin(browser, address, prepare = async () => {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: "light", hasTouch: true,
      reducedMotion: "reduce" });
    await context.addInitScript(watch);
    await prepare(context);
    const visit = new Visit();
    const page = await context.newPage();
    Object.assign(visit, { context, page, errors: [], foreign: [], requests: 0, chunks: [] });
    page.on("console", (message) => message.type() === "error" && visit.errors.push(message.text()));
    page.on("pageerror", (error) => visit.errors.push(error.stack || String(error)));
    page.on("request", (request) => {
      visit.requests++;
      if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(address)) visit.foreign.push(request.url());
    });
    page.on("response", (response) => response.url().endsWith(".worklet.asp") && (visit.last = response.body().catch(() => null)));
    await page.goto(address);
    await page.waitForFunction(() => document.getElementById("edition").textContent !== "", null, { timeout: 10000 })
      .catch(() => { throw new Error(`the page does not begin: ${visit.errors.join("; ")}`); });
    // Without motion the page begins with a surface and nobody's hand.
    await page.waitForSelector(".loaded, #invitation:not([hidden])", { state: "attached" });
    await page.emulateMedia({ reducedMotion: "no-preference" });
    await page.evaluate(() => document.querySelectorAll("details.panel").forEach((drawer) => (drawer.open = true)));
    visit.cdp = await context.newCDPSession(page);
    return visit;
  }

  async compile(prompt) {
    await this.page.fill("#prompt", prompt);
    await this.page.press("#prompt", "Enter");
    await this.page.waitForFunction(() => document.getElementById("prompt-form").getAttribute("aria-busy") === "false"
      && document.querySelector(".loaded") && !document.getElementById("command").hidden);
    await this.page.waitForFunction((text) => document.querySelector("#history button")?.textContent === text, prompt);
  }

  /** The middle of the stage, px. */
  async middle() {
    const { x, y, width, height } = await this.page.locator("#stage").boundingBox();
    return [x + width / 2, y + height / 2];
  }

  /** A pen's stroke to and fro, by the browser's own events. The first contact also starts the sound. */
  async penStroke({ pressure, seconds, px_s }) {
    const [x, y] = await this.middle();
    const send = (type, at, force) => this.cdp.send("Input.dispatchMouseEvent", { type, x: x + at, y, button: "left",
      buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1, pointerType: "pen", force });
    const place = (t) => 100 * (1 - Math.abs((((t * px_s) / 100) % 4) - 2));
    for (let contact = 0; contact < 2; contact++) {
      await send("mousePressed", place(0), pressure(0));
      if (contact === 0) {
        await this.page.waitForFunction(() => document.getElementById("sound-switch").getAttribute("aria-pressed") === "true");
        await this.page.waitForTimeout(200);
      } else {
        // A pen does not wait for the page.
        const [began, sent] = [performance.now(), []];
        for (let t = 0; t < seconds; t = (performance.now() - began) / 1000) {
          sent.push(send("mouseMoved", place(t), pressure(t)));
          await new Promise((done) => setTimeout(done, 1000 / PEN_HZ));
        }
        await Promise.all(sent);
      }
      await send("mouseReleased", place(0), 0);
      await this.page.waitForTimeout(250);
    }
  }

  async pinch(from_px, to_px) {
    const [x, y] = await this.middle();
    const fingers = (px) => [-0.5, 0.5].map((side, id) => ({ x: x + side * px, y, id }));
    const send = (type, touchPoints) => this.cdp.send("Input.dispatchTouchEvent", { type, touchPoints });
    await send("touchStart", fingers(from_px).slice(0, 1));
    await send("touchStart", fingers(from_px));
    for (let n = 1; n <= 10; n++) await send("touchMove", fingers(from_px + ((to_px - from_px) * n) / 10));
    await send("touchEnd", []);
  }

  async fingerStroke() {
    const [x, y] = await this.middle();
    const send = (type, at) =>
      this.cdp.send("Input.dispatchTouchEvent", { type, touchPoints: at === null ? [] : [{ x: x + at, y }] });
    await send("touchStart", 0);
    for (let n = 1; n <= 40; n++) {
      await send("touchMove", 4 * n);
      await this.page.waitForTimeout(8);
    }
    await send("touchEnd", null);
    await this.page.waitForTimeout(250);
  }

  /** The ticks since the last call, with the names of `asperity render`. */
  async take() {
    // As text, since numbers would be written out one by one.
    const got = await this.page.evaluate(() => {
      const { chunks, text } = window.studioCheck;
      return chunks.splice(0).map(({ session, first, positions_mm, columns, flags }) =>
        ({ session, first, arrays: [positions_mm, columns, flags].map(({ buffer }) => text(buffer)) }));
    });
    const chunks = got.map(({ session, first, arrays: [positions_mm, columns, flags] }) => ({ session, first,
      positions_mm: numbers(positions_mm, Float32Array), columns: numbers(columns, Float32Array),
      flags: numbers(flags, Uint32Array) }));
    this.chunks.push(...chunks);
    return chunks.flatMap(({ columns, flags }) => Array.from(flags, (_, n) =>
      Object.fromEntries(COLUMNS.map((name, k) => [name, columns[n * COLUMNS.length + k]]))));
  }

  /** The asset that the page fetched last for its renderer. */
  asset() {
    return this.last;
  }

  end() {
    return this.context.close();
  }
}

/** What `studioCheck.text` wrote. */
export function numbers(text, Type) {
  const bytes = Buffer.from(text, "base64");
  return new Type(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
}
