// The choice of the sound device, where the browser offers one.

import { element, find, notify, withdraw } from "./dom.js";
import { texts } from "./texts.js";

const select = find("device");

async function outputs() {
  const devices = (await navigator.mediaDevices?.enumerateDevices?.()) ?? [];
  // Nameless ones are there only to say that there are some.
  return devices.filter(({ kind, deviceId, label }) => kind === "audiooutput" && deviceId && deviceId !== "default" && label);
}

async function list(sound) {
  const found = await outputs();
  const option = ({ deviceId, label }, n) => element("option", { value: deviceId }, label || texts.sound.device_number(n + 1));
  select.replaceChildren(element("option", { value: "" }, texts.sound.default_device), ...found.map(option));
  select.value = found.some(({ deviceId }) => deviceId === sound.sink) ? sound.sink : "";
  return found;
}

/** Lists the devices; a browser that always plays on the system's default says so instead. */
export async function startDevices(sound) {
  const button = find("find-devices");
  if (!("setSinkId" in (globalThis.AudioContext?.prototype ?? {}))) {
    select.replaceChildren(element("option", { value: "" }, texts.sound.no_choice));
    select.disabled = true;
    button.hidden = true;
    return;
  }
  button.title = texts.sound.find_help;
  button.hidden = (await list(sound)).length > 0;

  select.addEventListener("change", async () => {
    const name = select.selectedOptions[0].textContent;
    withdraw("device");
    if (await sound.choose(select.value)) return;
    select.value = "";
    notify("device", { text: texts.sound.sink_failed(name), help: texts.sound.sink_help });
  });

  button.addEventListener("click", async () => {
    withdraw("device");
    try {
      if (navigator.mediaDevices.selectAudioOutput) await navigator.mediaDevices.selectAudioOutput();
      else (await navigator.mediaDevices.getUserMedia({ audio: true })).getTracks().forEach((track) => track.stop());
      button.hidden = (await list(sound)).length > 0;
      select.focus();
    } catch {
      notify("device", { text: texts.sound.denied, help: texts.sound.denied_help });
    }
  });

  navigator.mediaDevices?.addEventListener("devicechange", async () => {
    const name = select.selectedOptions[0]?.textContent;
    const lost = sound.sink && !(await outputs()).some(({ deviceId }) => deviceId === sound.sink);
    if (lost) {
      await sound.choose("");
      notify("device", { text: texts.sound.lost(name), help: texts.sound.lost_help });
    }
    await list(sound);
  });
}
