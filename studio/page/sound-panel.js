// The panel of the sound: switch, level, meter, device, and what went wrong.

import { startDevices } from "./devices.js";
import { find, notify, recall, remember, withdraw } from "./dom.js";
import { startOutput } from "./output/panel.js";
import { Meter } from "./readout.js";
import { texts } from "./texts.js";

function showState(sound, meter) {
  const { state } = sound;
  const button = find("sound-switch");
  button.setAttribute("aria-pressed", String(state === "on"));
  button.textContent = { on: texts.sound.stop, starting: texts.sound.starting }[state] ?? texts.sound.start;
  find("sound-text").textContent = state === "on" ? texts.sound.latency(1000 * sound.total_latency_s) : texts.sound.off;
  meter.on = state === "on";
  if (state === "on") withdraw("sound");
  if (state !== "suspended") return;
  notify("sound", { text: texts.sound.suspended, help: texts.sound.suspended_help,
    action: { label: texts.sound.resume, run: () => sound.start() } });
}

export function startSoundPanel({ sound, hand }) {
  const meter = new Meter(() => sound.measure());
  sound.on("state", () => showState(sound, meter));
  sound.on("limit", () => meter.limits());
  // The renderer's wall may be softer than the asset's.
  sound.on("loaded", ({ stiffness_n_m }) => {
    hand.stiffness_n_m = stiffness_n_m;
    withdraw("renderer");
  });
  sound.on("refused", ({ name }) => notify("renderer", { text: texts.sound.refused(name), help: texts.sound.refused_help }));
  sound.on("failure", ({ kind, detail }) => {
    const text = texts.sound[kind];
    notify("sound", { text: typeof text === "function" ? text(detail) : text, help: texts.sound[`${kind}_help`],
      action: { label: texts.sound.restart, run: () => sound.start() } });
  });
  showState(sound, meter);

  find("sound-switch").addEventListener("click", () => {
    sound.stopped = sound.state === "on" || sound.state === "starting";
    if (sound.stopped) sound.stop();
    else sound.start();
  });

  const equal = find("equal");
  equal.title = texts.sound.equal_title;
  equal.checked = recall("equal", true) === true;
  const turned = () => (find("turned").textContent = sound.trim_db ? texts.sound.turned(sound.trim_db) : "");
  const choose = () => {
    sound.balance(equal.checked);
    turned();
  };
  equal.addEventListener("change", () => {
    remember("equal", equal.checked);
    choose();
  });
  sound.on("loaded", turned);
  choose();

  // The level is not remembered: every visit begins at a safe one.
  const level = find("level");
  const update = () => {
    sound.level = Number(level.value);
    const text = texts.sound.level_text(sound.level_db);
    find("level-text").textContent = text;
    level.setAttribute("aria-valuetext", text);
  };
  const setLevel = (level_db) => {
    level.value = level_db;
    update();
  };
  level.addEventListener("input", update);
  sound.on("louder", (db) => setLevel(sound.level_db - db));
  setLevel(sound.level_db);
  startOutput({ sound, setLevel });
  return startDevices(sound);
}
