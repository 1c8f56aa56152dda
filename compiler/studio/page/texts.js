// Every text of the page, in English, but those of the plots, which have a file of their own. Functions take what they name.

import { texts as plots } from "./plots/texts.js";

const number = (value, digits) =>
  value.toLocaleString("en", { minimumFractionDigits: digits, maximumFractionDigits: digits }).replace("-", "−");

export const texts = {
  plots,
  live: "Live plots",
  title: "Asperity Studio",
  titled: (name) => `${name} – Asperity Studio`,
  edition: (version, library) => (library ? `${library.name}, ${library.textures} textures · ${version}` : version),

  theme: { auto: "Theme: system", light: "Theme: light", dark: "Theme: dark" },

  prompt: {
    title: "Prompt",
    label: "Describe a surface",
    placeholder: "rough abrasive sheet with gritty particles",
    compile: "Compile",
    compiling: "Compiling …",
    hint: "↑ brings earlier prompts",
    suggestions: "Known materials and qualities",
    suggested: (count) => (count === 1 ? "1 suggestion" : `${count} suggestions`),
    empty: "Describe a surface first, such as “wet ice”.",
    compiled: (name, certainty) => `Compiled “${name}”. ${certainty}`,
    examples: ["rough abrasive sheet with gritty particles", "wet ice", "cork board", "soft velvet", "brushed steel, slightly waxy"],
    invitation: "Describe a surface to see, hear and stroke it, or start with one of these:",
  },

  reading: {
    label: "What the words were taken for",
    words: "What each word was taken for, and how far it moved the texture, in steps of 100",
    roles: {
      name: "material", number: "number", quality: "quality", degree: "degree", word: "word", "left out": "left out",
    },
    unused: "not used",
    rows: { corrected: "Corrected", taken: "Taken as", unread: "Not understood", note: "Note" },
    corrected: (said, taken) => `“${said}” was taken as “${taken}”`,
    certainty: { known: "Known", close: "Close", guess: "A guess" },
    certainty_help: {
      known: "The model knows this material.",
      close: "Its words lie near to what the model knows.",
      guess: "The prompt is far from everything the model knows. Try one of the nearest materials.",
    },
    share: (share) => `${number(100 * share, 0)} % of prompt pairs at this level come out in the order a person rated them.`,
  },

  nearest: {
    title: "Nearest materials",
    none: "Compile a prompt to see what it lies near.",
    opened: "This texture was opened from a file, not compiled from words.",
    compile: (name, percent) => `Compile “${name}”, ${percent} % of the texture`,
    percent: (share) => `${number(100 * share, 0)} %`,
  },

  history: {
    title: "Earlier prompts",
    forget: "Forget all",
    none: "None yet.",
    compile: (prompt) => `Compile “${prompt}” again`,
  },

  surface: {
    empty: "No texture yet",
    label: "Surface to stroke",
    hint: "Drag to stroke, press to tap; the wheel zooms, or changes the force while you press. "
      + "Keys: arrows stroke, Space presses, Shift doubles the force, + − 0 zoom.",
    zoom: "Zoom",
    zoom_in: "Zoom in",
    zoom_out: "Zoom out",
    zoom_reset: "Reset",
    scale: (mm) => (mm >= 10 ? `${number(mm / 10, 0)} cm` : `${number(mm, mm < 1 ? 1 : 0)} mm`),
    kilobytes: (bytes) => `${number(bytes / 1000, 1)} kB`,
    rate: (hz) => `${number(hz, 0)} Hz`,
    rerated: (from_hz, to_hz) =>
      `Rerated from ${number(from_hz, 0)} to ${number(to_hz, 0)} Hz for this page; the file keeps ${number(from_hz, 0)} Hz`,
    plain: "This browser has no WebGL 2: the picture is shown without its relief.",
    no_picture: "The picture could not be loaded; the texture itself is complete.",
  },

  readout: {
    speed: "Speed", force: "Force", friction: "Friction", vibration: "Vibration",
    speed_unit: "mm/s", force_unit: "N", friction_unit: "N", vibration_unit: "m/s² RMS",
    none: "–",
    speed_text: (value) => number(value, 0),
    force_text: (value) => number(value, 2),
    vibration_text: (value) => number(value, 2),
  },

  command: { label: "Command that writes the same bytes", copy: "Copy", copied: "Copied", selected: "Selected: copy it with Ctrl+C" },

  feel: {
    title: "How it feels",
    none: "Nothing is loaded.",
    axes: { rough: "Rough", slippery: "Slippery", hard: "Hard" },
    of_100: (place) => number(place, 0),
    place: (name, place, physical) => `${name}: ${number(place, 0)} of 100 (${physical})`,
    rough: (db) => `${number(db, 1)} dB`,
    slippery: (mu) => `μ ${number(mu, 2)}`,
    hard: (hz) => `${number(hz, 0)} Hz`,
    undefined: "not defined",
    about: "0–100: 5th–95th percentile of materials",
  },

  hand: {
    title: "Hand",
    force: "Force",
    force_text: (newtons) => `${number(newtons, 1)} N`,
    from_slider: "From this slider; Shift doubles it.",
    from_pressure: (full_n) => `From your pen’s pressure, up to ${number(full_n, 1)} N; the slider serves keys.`,
    auto: "Let a hand move by itself",
    paths: { circle: "Circles", line: "To and fro", tap: "Taps" },
    speed: "Speed",
    speed_text: (mm_s) => `${number(mm_s, 0)} mm/s`,
    start: "Start the hand",
    stop: "Stop the hand",
    constant: "This pen reports no changing pressure, so the force comes from the slider.",
    constant_help: "Check that the tablet’s driver passes pressure on, or set the force with the slider, the wheel or Shift.",
  },

  sound: {
    title: "Sound",
    start: "Start sound",
    starting: "Starting …",
    stop: "Stop sound",
    off: "Off; a touch of the surface starts it.",
    latency: (ms) => `latency ${number(ms, 0)} ms`,
    level: "Level",
    level_text: (db) => `${db > 0 ? "+" : db < 0 ? "−" : ""}${number(Math.abs(db), 0)} dB`,
    meter: "Output level in dB of full scale",
    meter_text: (db) => (db <= -60 ? "silent" : `peak −${number(Math.abs(db), 0)} dBFS`),
    limiting: "limiting",
    device: "Output",
    default_device: "System default",
    device_number: (number) => `Output ${number}`,
    find_devices: "Find devices …",
    find_help: "Browsers name sound devices only to pages that may use the microphone. Allow it once; nothing is recorded.",
    no_choice: "System default (this browser has no choice)",
    denied: "The browser did not allow access to the list of sound devices.",
    denied_help: "Allow the microphone for this address in the browser’s site settings, or change the default device of the system.",
    lost: (name) => `The sound device “${name}” is gone; playing on the system’s default.`,
    lost_help: "Plug it in again and choose it under Sound.",
    sink_failed: (name) => `The sound device “${name}” cannot be used.`,
    sink_help: "Another program may hold it. Close that, or choose another device.",
    suspended: "The browser has paused the sound.",
    suspended_help: "Browsers start sound only after a click or a key, and some wait for a sound device.",
    resume: "Resume",
    failed: "The sound has stopped: its renderer failed.",
    failed_help: "Restart it. If it fails again, reload the page; the texture files are not affected.",
    no_device: "No sound device answered.",
    no_device_help: "Connect one, or check the system’s sound settings, then start again.",
    wrong_rate: (hz) => `This browser plays at ${number(hz, 0)} Hz only; the renderer needs 48,000 Hz.`,
    wrong_rate_help: "Use a current Chromium, Firefox or Safari.",
    no_worklet: "This browser has no AudioWorklet.",
    no_worklet_help: "Open the page by the address that the terminal printed, in a current Chromium, Firefox or Safari.",
    restart: "Restart sound",
    refused: (status) => `The renderer refused this texture (${status}).`,
    refused_help: "Compile it again. If that does not help, please report the command shown under the surface.",
  },

  server: {
    gone: "The studio’s server does not answer. What is loaded keeps playing.",
    gone_help: "Run “asperity studio” again if it has ended. This page tries again every three seconds.",
    retry: "Try now",
    other_run: "This address belongs to a studio that has ended.",
    other_run_help: "Open the address that “asperity studio” printed last.",
    unreadable: "The server’s answer could not be read.",
    unreadable_help: "Page and program may be of different versions: reload the page.",
  },

  notices: { dismiss: "Dismiss" },
  broken: "Something in this page failed.",
  broken_help: "Reload the page; textures are compiled again from their prompts.",
};
