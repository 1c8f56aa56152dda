// The files that a texture can be taken away as, in groups, and what they are called.

import { texts } from "../texts.js";

const GROUPS = {
  own: ["asp", "json"],
  see: ["png", "normal.png", "height.png", "plot.png"],
  hear: ["listen.wav", "export.wav", "export.csv"],
  tools: ["export.hjif", "export.hmpg", "export.ahap", "export.haptic", "export.gltf"],
  code: ["export.c", "export.h", "export.rs"],
};
/** What follows the name of the texture's own file, where the ending alone would not tell. */
const SUFFIXES = { "normal.png": " normal.png", "height.png": " height.png", "plot.png": " plot.png", "export.wav": " acceleration.wav",
  "export.csv": " acceleration.csv", "listen.wav": ".wav" };

/** { group: [{ ending, suffix, label, purpose }] }, of `about`. */
export function kindsOf({ exports, files, opens }) {
  const known = new Set(Object.values(GROUPS).flat());
  const offered = new Map(exports.map((entry) => [entry.ending, entry]));
  const kind = (ending) => {
    const [label, purpose] = texts.files.kinds[ending] ?? texts.files.other(offered.get(ending).format);
    return { ending, suffix: SUFFIXES[ending] ?? `.${offered.get(ending)?.file_ending ?? ending}`, label, purpose };
  };
  const isThere = (ending) => (files && !opens ? files.includes(ending) : !ending.startsWith("export.") || offered.has(ending));
  const others = [...offered.keys()].filter((ending) => !known.has(ending));
  return Object.fromEntries(Object.entries({ ...GROUPS, tools: [...GROUPS.tools, ...others] }).map(([group, endings]) =>
    [group, endings.filter(isThere).map(kind)]));
}

/** The name of such a file: `wet ice.asp` gives `wet ice.png`. */
export const fileName = ({ file }, suffix) => file.replace(/\.asp$/, "") + suffix;
