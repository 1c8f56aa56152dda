// The equaliser's part of the panel: bands, their response, actuators that a person saved, and the tones to set them by.

import { announce, element, recall, remember } from "../dom.js";
import { texts } from "../texts.js";
import { BANDS, MOST_DB } from "./equaliser.js";
import { Response } from "./response.js";
import { tonesButton } from "./tones.js";

const own = texts.output;
const FLAT = BANDS.map(() => 0);

/** Saved actuators: { name: gains }. What else storage may hold is left out. */
function saved() {
  const found = Object.entries(recall("actuators", {}) ?? {});
  return new Map(found.filter(([, gains]) => Array.isArray(gains) && gains.length === BANDS.length
    && gains.every((gain) => Math.abs(gain) <= MOST_DB)));
}

function bandSlider(/** @type {BiquadFilterOptions} */ { frequency }, use) {
  const id = `band-${frequency}`;
  const input = element("input", { type: "range", id, min: -MOST_DB, max: MOST_DB, step: 1, value: 0 });
  const output = element("output", { for: id });
  input.addEventListener("input", use);
  const row = element("div", { class: "band" }, element("label", { for: id }, own.band(frequency)), input, output);
  const show = (gain_db) => {
    input.value = gain_db;
    output.textContent = own.gain(gain_db);
    input.setAttribute("aria-valuetext", own.gain(gain_db));
  };
  return { row, input, show };
}

export function startEqualiser(sound) {
  let gains_db = FLAT;
  const actuators = saved();
  const response = new Response();
  const state = element("span", { class: "state" });
  const use = element("input", { type: "checkbox", id: "equaliser-use" });
  const choice = element("select", { id: "actuator" });
  const name = element("input", { type: "text", id: "actuator-name", maxlength: 40, autocomplete: "off",
    "aria-label": own.save_name, placeholder: own.save_name });
  const keepButton = element("button", { type: "submit" }, own.save);
  const remove = element("button", { type: "button", class: "quiet" }, own.remove);
  const bands = BANDS.map((band) => bandSlider(band, () => {
    use.checked = true;
    set(bands.map(({ input }) => Number(input.value)));
  }));

  /** The name of the gains, or null. */
  const nameNow = () => [...actuators].find(([, gains]) => gains.every((gain, n) => gain === gains_db[n]))?.[0] ?? null;

  const show = () => {
    const flat = gains_db.every((gain) => gain === 0);
    const known = flat ? null : nameNow();
    const option = (value, text) => element("option", { value, selected: value === (known === null ? "" : `=${known}`) }, text);
    // A name may be anything, so that values of names have a mark.
    choice.replaceChildren(option("", flat ? own.flat : own.unsaved),
      ...(flat ? [] : [element("option", { value: "flat" }, own.flat)]),
      ...[...actuators.keys()].map((key) => option(`=${key}`, key)));
    remove.hidden = known === null;
    keepButton.disabled = flat;
    state.textContent = use.checked ? (flat ? own.flat : known ?? own.unsaved).toLowerCase() : own.equaliser_off;
    bands.forEach((band, n) => band.show(gains_db[n]));
    response.show(gains_db, use.checked);
  };
  const set = (gains) => {
    gains_db = gains;
    sound.equalise(use.checked ? gains_db : FLAT);
    show();
  };

  use.addEventListener("change", () => set(gains_db));
  choice.addEventListener("change", () => {
    const gains = choice.value.startsWith("=") ? actuators.get(choice.value.slice(1)) : FLAT;
    use.checked = gains !== FLAT;
    set(gains);
  });
  const keep = (said) => {
    remember("actuators", Object.fromEntries(actuators));
    announce(said);
    show();
  };
  remove.addEventListener("click", () => {
    const gone = nameNow();
    actuators.delete(gone);
    keep(own.removed(gone));
    choice.focus();
  });
  const save = element("form", { class: "save" }, name, keepButton);
  save.addEventListener("submit", (event) => {
    event.preventDefault();
    const called = name.value.trim();
    if (!called) return name.focus();
    // Two names for the same gains could not be told apart.
    actuators.delete(nameNow());
    actuators.set(called, gains_db);
    name.value = "";
    keep(own.saved(called));
  });

  const tones = tonesButton(sound, { bands: bands.map(({ input }) => input), mark: (hz) => response.mark(hz) });
  show();
  const details = element("details", { class: "more", id: "equaliser" },
    element("summary", {}, own.equaliser, state),
    element("div", { class: "inside" },
      element("div", { class: "choice" }, element("label", { for: "actuator" }, own.actuator), choice, remove),
      element("label", { class: "switch" }, use, own.use),
      response.element, element("div", { class: "bands" }, ...bands.map(({ row }) => row)), save, ...tones.elements));
  details.addEventListener("toggle", () => !details.open && tones.stop());
  return details;
}
