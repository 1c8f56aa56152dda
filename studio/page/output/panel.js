// What the sound is made for: the mode, what it does, and the test of a device's channels.

import { element, find } from "../dom.js";
import { texts } from "../texts.js";
import { startEqualiser } from "./equaliser-panel.js";
import { CHANNELS, HIGH_HZ, LOW_HZ, MODES, SHIFT_HZ } from "./modes.js";
import { startMotors } from "./motors.js";
import { CHANNEL_S, testChannels } from "./tones.js";

const own = texts.output;
const about = { plain: own.about.plain, ear: own.about.ear(SHIFT_HZ), coil: own.about.coil(LOW_HZ, HIGH_HZ),
  dualsense: own.about.dualsense(LOW_HZ, HIGH_HZ) };

/** A button that plays a burst on each channel and names the one that plays. */
function channelTest(sound) {
  const named = element("p", { class: "small", role: "status" });
  const button = element("button", { type: "button" }, own.test);
  const group = element("div", { class: "channel-test" }, button, named);
  /** The chain that is tested. */
  let tested = null;
  const show = () => {
    const { chain, state, mode } = sound;
    group.hidden = !MODES[mode].channels || (chain !== null && !chain.fits);
    if (tested && tested === chain) return;
    tested = null;
    button.disabled = state !== "on" || chain.mode !== mode;
    named.textContent = state === "on" ? "" : own.test_start;
  };
  button.addEventListener("click", async () => {
    const { chain } = sound;
    tested = chain;
    button.disabled = true;
    const name = (n) => tested === chain && (named.textContent = own.channel(n + 1, own.channels[n]));
    for (let n = 0; n < CHANNELS; n++) setTimeout(name, 1000 * n * CHANNEL_S, n);
    await testChannels(chain);
    tested = null;
    show();
  });
  return { group, show };
}

/** `setLevel` moves the slider of the level. */
export function startOutput({ sound, setLevel }) {
  const select = element("select", { id: "mode" },
    ...Object.keys(MODES).map((name) => element("option", { value: name }, own.modes[name])));
  select.value = sound.mode;
  const text = element("p", { class: "small", id: "mode-text", role: "status" });
  const test = channelTest(sound);
  const show = () => {
    const { chain, mode } = sound;
    const silent = chain && chain.mode === mode && !chain.fits;
    text.replaceChildren(...(silent
      ? [element("strong", {}, own.few_channels(chain.context.destination.maxChannelCount)), " ", own.few_channels_help]
      : [about[mode]]));
    test.show();
  };
  select.addEventListener("change", () => {
    sound.use(select.value);
    setLevel(sound.level_db);
    show();
  });
  sound.on("state", show);
  find("output").replaceChildren(
    element("div", { class: "choice" }, element("label", { for: "mode" }, own.mode), select), text, test.group,
    startEqualiser(sound), startMotors(sound));
  show();
}
