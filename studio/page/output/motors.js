// Motors that are no loudspeakers: a gamepad's rumble and a phone's vibration follow the level of what is rendered.

import { element } from "../dom.js";
import { texts } from "../texts.js";

const STEP_MS = 40;
/** An effect lasts until the next one has come for sure, ms. */
const LASTS_MS = 120;
/** RMS at which a rumble motor runs fully, m/s². */
const FULL_M_S2 = 5;
/** RMS from which a phone vibrates, m/s². */
const NOTICED_M_S2 = 0.3;

/** Gamepads that can rumble and have shown themselves by a button. */
export const gamepads = () => [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad?.vibrationActuator?.playEffect);

/** Whether this is a device with a motor; browsers of desks have the function too. */
export const hasVibration = () => "vibrate" in navigator && matchMedia("(any-pointer: coarse)").matches;

/** Calls `drive` with the RMS below and above the crossover, m/s², while it is on, and `rest` when it ends. */
class Motor {
  #timer = null;

  drive(_low_m_s2, _high_m_s2) {}

  rest() {}

  constructor(sound) {
    this.sound = sound;
  }

  set on(on) {
    clearInterval(this.#timer);
    this.#timer = on ? setInterval(() => this.#step(), STEP_MS) : null;
    if (!on) this.rest();
  }

  #step() {
    const { state, chain } = this.sound;
    this.drive(...(state === "on" ? chain.felt() : [0, 0]));
  }
}

export class Rumble extends Motor {
  #runs = false;

  drive(low_m_s2, high_m_s2) {
    const [strongMagnitude, weakMagnitude] = [low_m_s2, high_m_s2].map((rms) => Math.min(rms / FULL_M_S2, 1));
    const runs = strongMagnitude > 0.005 || weakMagnitude > 0.005;
    if (!runs) return this.#runs && this.rest();
    this.#runs = true;
    const effect = { startDelay: 0, duration: LASTS_MS, strongMagnitude, weakMagnitude };
    // A gamepad that is just unplugged refuses.
    for (const { vibrationActuator } of gamepads()) vibrationActuator.playEffect("dual-rumble", effect).catch(() => {});
  }

  rest() {
    this.#runs = false;
    for (const { vibrationActuator } of gamepads()) vibrationActuator.reset?.().catch(() => {});
  }
}

export class Vibration extends Motor {
  #runs = false;

  drive(low_m_s2, high_m_s2) {
    if (Math.hypot(low_m_s2, high_m_s2) > NOTICED_M_S2) {
      this.#runs = true;
      navigator.vibrate(LASTS_MS);
    } else this.rest();
  }

  rest() {
    if (this.#runs) navigator.vibrate(0);
    this.#runs = false;
  }
}

// Gamepad and phone in the panel: a switch for each that can work here, else a line that says why not.
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
