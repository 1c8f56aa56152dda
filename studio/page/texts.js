// The texts of the page that change, in English; `index.html` has the others. Functions take what they name.

import { texts as plots } from "./plots/texts.js";
import { files } from "./texts/files.js";
import { chosen, gallery, own } from "./texts/gallery.js";
import { number } from "./texts/number.js";
import { device, output, sound } from "./texts/sound.js";
import { steer } from "./texts/steer.js";

export const texts = {
  plots,
  steer,
  sound,
  device,
  output,
  gallery,
  own,
  chosen,
  files,
  titled: (name) => `${name} – Asperity Studio`,
  edition: (version, library, project) => [library && `${library.name}, ${number(library.textures, 0)} textures`,
    project && `project ${project}`, version].filter(Boolean).join(" · "),

  theme: { auto: "Theme: system", light: "Theme: light", dark: "Theme: dark" },

  prompt: {
    compile: "Compile",
    compiling: "Compiling …",
    cancel: "Cancel",
    suggested: (count) => (count === 1 ? "1 suggestion" : `${count} suggestions`),
    none: "This page compiles no prompts: pick a texture in the gallery.",
    empty: "Describe a surface first, such as “wet ice”.",
    compiled: (name, certainty) => `Compiled “${name}”. ${certainty}`,
    examples: ["rough abrasive sheet with gritty particles", "wet ice", "cork board", "soft velvet", "brushed steel, slightly waxy"],
    invitation: "Describe a surface to see, hear and stroke it, or start with one of these:",
  },

  reading: {
    words: "What each word was taken for, and how far it moved the texture, in steps of 100",
    roles: {
      name: "material", number: "number", quality: "quality", degree: "degree", word: "word", object: "carries it", denied: "denied", tool: "tool",
      "left out": "left out",
    },
    unused: "not used",
    rows: { corrected: "Corrected", taken: "Taken as", unread: "Not understood", note: "Note" },
    corrected: (said, taken) => `“${said}” was taken as “${taken}”`,
    certainty: { known: "Known", close: "Close", guess: "A guess", no_contact: "Nothing touched" },
    certainty_help: {
      known: "The model knows this material.",
      close: "Its words lie near to what the model knows.",
      no_contact: "Nothing in the prompt is touched. Name a surface, or try one of the nearest materials.",
      guess: "The prompt is far from everything the model knows. Try one of the nearest materials.",
    },
    share: (share) => `${number(100 * share, 0)} % of sentences at this level feel like what they say is touched.`,
  },

  nearest: {
    none: "Compile a prompt to see what it lies near.",
    opened: "Neighbours are found for prompts; this texture was edited, mixed or opened.",
    compile: (name, percent) => `Compile “${name}”, ${percent} % of the texture`,
    percent: (share) => `${number(100 * share, 0)} %`,
  },

  history: {
    none: "None yet.",
    compile: (prompt) => `Compile “${prompt}” again`,
  },

  surface: {
    empty: "No texture yet",
    scale: (mm) => (mm >= 10 ? `${number(mm / 10, 0)} cm` : `${number(mm, mm < 1 ? 1 : 0)} mm`),
    kilobytes: (bytes) => `${number(bytes / 1000, 1)} kB`,
    rate: (hz) => `${number(hz, 0)} Hz`,
    rerated: (from_hz, to_hz) =>
      `Rerated from ${number(from_hz, 0)} to ${number(to_hz, 0)} Hz for this page; the file keeps ${number(from_hz, 0)} Hz`,
    // A right angle has two of these arrows, half of it one.
    axis: ([right, up]) => ["↔", "⤢", "↕", "⤡"][(Math.round((4 * Math.atan2(up, right)) / Math.PI) + 4) % 4],
    along: (level_db) => `along ${level_db < 0 ? "−" : "+"}${number(Math.abs(level_db), 1)} dB`,
    silent_along: "silent along it",
    along_title: (speed_ratio, mu_ratios) =>
      `Along it as across at ${number(speed_ratio, 2)} of the speed; μ × ${mu_ratios.map((ratio) => number(ratio, 2)).join(" and ")}`,
    plain: "This browser has no WebGL 2: the picture is shown without its relief.",
    no_picture: "The picture could not be loaded; the texture itself is complete.",
  },

  readout: {
    speed: "Speed", force: "Force", depth: "Depth", friction: "Friction", vibration: "Vibration",
    speed_unit: "mm/s", force_unit: "N", depth_unit: "mm", friction_unit: "N", vibration_unit: "m/s² RMS",
    none: "–",
    speed_text: (value) => number(value, 0),
    force_text: (value) => number(value, 2),
    depth_text: (value) => number(value, 1),
    vibration_text: (value) => number(value, 2),
  },

  command: { label: "Command that writes the same bytes" },
  copy: { copy: "Copy", copied: "Copied", selected: "Selected: copy it with Ctrl+C" },

  link: {
    label: "Link",
    about: "Paste it into any studio’s page, or put it behind the address of an exported one with the compiler: it makes the same bytes there.",
    about_name: "Opens a page of this library with this texture.",
    none: "What comes from a file has no link: pass the asset on.",
    not_opened: (why) => `The link was not opened: ${why}`,
    other: (name) => `“${name}” has other bytes here than where the link was copied.`,
    other_help: "That was another version of Asperity.",
    no_compiler: "This page has no compiler, which the link needs.",
    no_compiler_help: "Paste it into the page of “asperity studio”.",
    unknown: (name) => `the library has no texture “${name}”`,
    unknown_help: "Start the studio with the library that the link was copied of.",
  },

  hand: {
    force_text: (newtons) => `${number(newtons, 1)} N`,
    from_slider: "From this slider; Shift doubles it.",
    from_pressure: (full_n) => `From your pen’s pressure, up to ${number(full_n, 1)} N; the slider serves keys.`,
    paths: { circle: "Circles", line: "To and fro", tap: "Taps" },
    speed_text: (mm_s) => `${number(mm_s, 0)} mm/s`,
    start: "Start the hand",
    stop: "Stop the hand",
    constant: "This pen reports no changing pressure, so the force comes from the slider.",
    constant_help: "Check that the tablet’s driver passes pressure on, or set the force with the slider, the wheel or Shift.",
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

  exported: {
    gone: "The web server of this page does not answer. What is loaded keeps playing.",
    gone_help: "Check the connection. This page tries again every three seconds.",
    missing: (path) => `The file ${path} of this page is missing.`,
    missing_help: "Copy the folder that “asperity studio --export” wrote to the web server again, all of it.",
  },

  offline: {
    loading: (mb, of) => `Loading the compiler: ${number(mb, 0)} of ${number(of, 0)} MB …`,
    failed: (why) => `The compiler of this page has failed: ${why}`,
    failed_help: "Try again, which loads it anew. What is not saved of this session can be made again by the same steps.",
    version: (module, page) => `its version is ${module}, that of the page ${page}`,
  },

  project: {
    not_read: (why) => `The project cannot be read, and nothing is kept now: ${why}`,
    not_kept: (why) => `The project is not kept: ${why}`,
    reload: "Reload",
  },

  notices: { dismiss: "Dismiss" },
  broken: "Something in this page failed.",
  broken_help: "Reload the page; textures are compiled again from their prompts.",
};
