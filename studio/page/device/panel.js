// The device behind the server: what its loop does, how punctual it is, and what it plays.

import { announce, element, find, notify, recall, remember, withdraw } from "../dom.js";
import { COLUMN, WIDTH } from "../plots/ring.js";
import { texts } from "../texts.js";
import { Feed } from "./feed.js";
import { Jitter } from "./jitter.js";

/** Bits of the runtime's flags (`runtime/src/events.rs`), the first that is set counts. */
/** @type {[number, string][]} */
const STATES = [[1 << 7, "safe"], [1 << 8, "ramping"], [1, "contact"]];
const MOST_TEXTS = 6;
/** Shares of the ticks, as the server names them. */
const LATENCIES = ["p50", "p99", "p99_9", "max"];
/** Numbers change no more often than eyes follow, ms. */
const SHOW_MS = 200;

const stateOf = (flags) => STATES.find(([bit]) => flags & bit)?.[1] ?? "free";

/** Builds the panel where `about` names a device, which the plots then show. */
export function startDevicePanel({ server, state, surface, plots }) {
  state.on(["about"], ({ about }) => {
    const panel = find("servo-panel");
    if (!about?.device || !panel.hidden) return;
    panel.hidden = false;
    plots.begin(about.device.rate_hz);
    new DevicePanel({ server, state, surface, plots }, about.device);
  });
}

class DevicePanel {
  #parts;
  #values = {};
  #badge = element("span", { class: "badge" });
  #said = element("ol", { class: "said" });
  #jitter;
  #feed;
  #seen = -1;
  #shown_ms = 0;
  #playing = null;

  constructor(parts, { name, rate_hz, swaps }) {
    this.#parts = parts;
    this.#jitter = new Jitter(rate_hz);
    const value = (key) => [element("dt", {}, texts.device[key]), (this.#values[key] = element("dd", {}, texts.readout.none))];
    find("servo-name").textContent = texts.device.name(name, rate_hz);
    find("servo").replaceChildren(
      element("p", { class: "row" }, this.#badge),
      element("dl", { class: "rows" }, ...["playing", "force", "missed", "lost"].flatMap(value)),
      this.#latencies(),
      element("figure", {}, this.#jitter.element, element("figcaption", { class: "small" }, texts.device.jitter)),
      ...(swaps ? this.#swap() : [element("p", { class: "small" }, texts.device.scene)]),
      this.#said);
    this.#feed = new Feed(parts.server);
    this.#feed.on("news", (news) => this.#news(news));
    this.#feed.on("ticks", (ticks) => this.#ticks(ticks));
    this.#feed.on("silence", (error) => error
      ? notify("servo", { text: texts.device.silent, help: error.help ?? texts.device.silent_help }) : withdraw("servo"));
    this.#feed.run();
  }

  /** A table: how late the loop woke and what a tick took, at a few shares of the ticks. */
  #latencies() {
    const row = (key) => {
      this.#values[key] = LATENCIES.map(() => element("td", {}));
      return element("tr", {}, element("th", { scope: "row" }, texts.device[key]), ...this.#values[key]);
    };
    const heads = [texts.device.latency, ...texts.device.shares].map((text) => element("th", { scope: "col" }, text));
    return element("table", { class: "latency" }, element("tr", {}, ...heads), row("wakeup"), row("compute"));
  }

  /** The button that plays what the page shows, and the choice to do so at once. */
  #swap() {
    const { state } = this.#parts;
    const button = element("button", { type: "button", class: "strong", id: "servo-play-button" }, texts.device.play);
    const box = element("input", { type: "checkbox", id: "servo-follow" });
    box.checked = recall("servo-follow", false);
    box.addEventListener("change", () => remember("servo-follow", box.checked));
    button.addEventListener("click", () => this.#play(state.get("texture")));
    state.on(["texture"], ({ texture }) => {
      button.disabled = !texture;
      if (texture && box.checked) this.#play(texture);
    });
    return [button, element("label", { class: "small" }, box, " ", texts.device.follow)];
  }

  async #play(texture) {
    try {
      await this.#parts.server.playOnDevice(texture);
      withdraw("servo-play");
    } catch ({ message, help }) {
      notify("servo-play", { text: message, help });
    }
  }

  #news({ playing, missed, ended, wakeup_us, compute_us, said }) {
    const fresh = said.filter(([number]) => number > this.#seen);
    for (const [number, text] of fresh) {
      this.#seen = number;
      this.#said.append(element("li", {}, text));
      announce(text);
    }
    while (this.#said.children.length > MOST_TEXTS) this.#said.firstElementChild.remove();
    if (ended) {
      this.#badge.textContent = texts.device.states.ended;
      this.#badge.dataset.state = "ended";
      this.#parts.surface.touch(null);
    }
    if (performance.now() - this.#shown_ms < SHOW_MS && playing === this.#playing && !ended) return;
    this.#shown_ms = performance.now();
    this.#playing = playing;
    this.#show({ playing, missed: texts.device.count(missed), lost: texts.device.count(this.#feed.lost) });
    for (const [key, us] of Object.entries({ wakeup: wakeup_us, compute: compute_us })) {
      LATENCIES.forEach((share, n) => (this.#values[key][n].textContent = texts.device.us(us[share])));
    }
    this.#jitter.draw();
  }

  #ticks(message) {
    const { plots, surface } = this.#parts;
    const { columns, flags, positions_mm, wakeup_us } = message;
    plots.addTicks(message);
    this.#jitter.add(wakeup_us);
    const last = flags.length - 1;
    const column = (name) => columns[last * WIDTH + COLUMN[name]];
    const name = stateOf(flags[last]);
    this.#badge.textContent = texts.device.states[name];
    this.#badge.dataset.state = name;
    const force_n = Math.hypot(column("fx_n"), column("fy_n"), column("fz_n"));
    this.#show({ force: texts.device.force_text(force_n) });
    const [x_mm, y_mm] = positions_mm.subarray(3 * last);
    // The hand wanders over a surface without end; the stage shows the part around it.
    surface.touch(column("depth_mm") > 0 ? { x_mm: x_mm + surface.view.centre_mm[0], y_mm: y_mm + surface.view.centre_mm[1],
      force_n: column("normal_force_n") } : null);
  }

  #show(values) {
    for (const [key, text] of Object.entries(values)) {
      if (this.#values[key].textContent !== text) this.#values[key].textContent = text;
    }
  }
}
