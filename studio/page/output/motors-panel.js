// Gamepad and phone in the panel: a switch for each that can work here, else a line that says why not.

import { element } from "../dom.js";
import { texts } from "../texts.js";
import { gamepads, hasVibration, Rumble, Vibration } from "./motors.js";

const own = texts.output;

export function startMotors(sound) {
  const motors = { rumble: new Rumble(sound), vibration: new Vibration(sound) };
  const on = { rumble: false, vibration: false };
  const state = element("span", { class: "state" });
  const inside = element("div", { class: "inside" });
  const line = (text) => element("p", { class: "small" }, text);

  const turn = (name, wanted) => {
    on[name] = wanted;
    motors[name].on = wanted;
    state.textContent = own.more_state(on.rumble || on.vibration);
  };
  const option = (name, label, about) => element("div", {},
    element("label", { class: "switch" },
      element("input", { type: "checkbox", id: name, checked: on[name],
        onchange: ({ target }) => turn(name, target.checked) }), label),
    line(about));

  const show = () => {
    const pads = gamepads();
    // A gamepad that comes back is not shaken unasked.
    if (pads.length === 0 && on.rumble) turn("rumble", false);
    const names = pads.map(({ id }) => id).join(", ");
    const nothing = globalThis.GamepadHapticActuator ? own.no_rumble : own.no_gamepads;
    inside.replaceChildren(pads.length > 0 ? option("rumble", own.rumble(names), own.rumble_about) : line(nothing),
      hasVibration() ? option("vibration", own.vibrate, own.vibrate_about) : line(own.no_vibrate),
      ...(pads.length > 0 || hasVibration() ? [line(own.needs_sound)] : []));
  };
  for (const name of ["gamepadconnected", "gamepaddisconnected"]) addEventListener(name, show);
  turn("rumble", false);
  show();
  return element("details", { class: "more", id: "motors" }, element("summary", {}, own.more, state), inside);
}
