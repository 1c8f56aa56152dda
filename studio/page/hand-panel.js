// The hand and its panel: force, the hand that moves by itself, and the readout.

import { Auto } from "./auto.js";
import { element, find, notify, recall, remember, withdraw } from "./dom.js";
import { Force } from "./force.js";
import { Hand, now_s } from "./hand.js";
import { followKeys } from "./keys.js";
import { PATHS } from "./path.js";
import { followPointer } from "./pointer.js";
import { meansOf, Readout } from "./readout.js";
import { texts } from "./texts.js";

const reduced = matchMedia("(prefers-reduced-motion: reduce)");
/** Without the renderer's ticks, the hand's own numbers are shown so often. */
const READOUT_MS = 100;

/** A slider with its text; `use` takes its value now and after every change. */
function slider(name, otherwise, text, use) {
  const input = find(name);
  const recalled = recall(name, otherwise);
  input.value = Number.isFinite(recalled) ? recalled : otherwise;
  const update = () => {
    const value = Number(input.value);
    find(`${name}-text`).textContent = text(value);
    input.setAttribute("aria-valuetext", text(value));
    use(value);
  };
  input.addEventListener("input", () => {
    update();
    remember(name, Number(input.value));
  });
  update();
  return (by) => {
    input.value = Number(input.value) + by;
    input.dispatchEvent(new Event("input"));
  };
}

function choosePath(auto) {
  const recalled = recall("path", PATHS[0]);
  auto.name = PATHS.includes(recalled) ? recalled : PATHS[0];
  const choose = ({ target: { value } }) => {
    auto.name = value;
    remember("path", value);
    if (auto.running) auto.start();
  };
  find("auto-path").replaceChildren(...PATHS.map((path) => element("label", {},
    element("input", { type: "radio", name: "path", value: path, checked: path === auto.name, onchange: choose }),
    element("span", {}, texts.hand.paths[path]))));
}

export function startHandPanel({ surface, sound, state }) {
  const hand = new Hand((events) => sound.hand(events));
  const force = new Force((constant) => (constant ? notify("pen", { text: texts.hand.constant, help: texts.hand.constant_help })
    : withdraw("pen")));
  const readout = new Readout();
  const auto = new Auto({ surface, hand, force, sound });

  const turn = slider("force", force.slider_n, texts.hand.force_text, (newtons) => (force.slider_n = newtons));
  slider("auto-speed", auto.speed_mm_s, texts.hand.speed_text, (mm_s) => (auto.speed_mm_s = mm_s));
  choosePath(auto);

  // What moves the hand is a gesture, so it may start the sound; not after it was stopped on purpose.
  const begun = () => !sound.stopped && sound.start();
  const button = find("auto");
  const showAuto = () => {
    button.setAttribute("aria-pressed", String(auto.running));
    button.textContent = auto.running ? texts.hand.stop : texts.hand.start;
    if (!auto.running) surface.light();
  };
  button.addEventListener("click", () => {
    if (auto.running) auto.stop();
    else {
      begun();
      auto.start();
    }
    showAuto();
  });
  auto.on("end", showAuto);
  surface.on("zoom", () => {
    auto.outline();
    if (hand.last) surface.touch(hand.last);
  });
  showAuto();

  const parts = { surface, hand, force, begun };
  followPointer({ ...parts, turn });
  followKeys({ ...parts, speed_mm_s: () => auto.speed_mm_s });

  const source = find("force-source");
  hand.on("move", () => {
    surface.touch(reduced.matches && hand.owner === "auto" ? null : hand.last);
    const kind = ["pen", "touch", "mouse"].find((pointerType) => force.proved(pointerType));
    source.textContent = kind ? texts.hand.from_pressure(force.full_n) : texts.hand.from_slider;
  });
  source.textContent = texts.hand.from_slider;

  let gives_way = false;
  sound.on("ticks", (ticks) => {
    const means = meansOf(ticks);
    readout.show(means);
    surface.dent(hand.last, gives_way && means ? means.depth : 0);
  });
  setInterval(() => {
    if (sound.state === "on" && state.get("texture")) return;
    readout.show(hand.last && { speed: hand.speed_mm_s(now_s()), force: hand.last.force_n });
  }, READOUT_MS);

  state.on(["texture"], ({ texture }) => {
    if (!texture) return;
    button.disabled = false;
    // Until the renderer says its own.
    hand.stiffness_n_m = texture.inspect.wall.stiffness_n_m;
    gives_way = Boolean(texture.inspect.contact);
  });
  return { hand, move: () => {
    auto.start();
    showAuto();
  } };
}
