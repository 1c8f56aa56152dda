// What the words of the prompt were taken for: each with its role and what it moved, how certain the
// result is, what was corrected or not understood, and the nearest materials to go on with.

import { element, find } from "./dom.js";
import { texts } from "./texts.js";

const ATTRIBUTES = ["rough", "slippery", "hard"];
/** Smallest move that a word is coloured by, in steps of 100. */
const LEAST = 5;
/** Smallest second move that is shown. */
const LEAST_SECOND = 15;
const MOST_MATERIALS = 6;
/** Words that may be read as one. */
const MOST_JOINED = 3;
/** Roles of words that move nothing. */
const NOT_ENCODED = ["object", "denied", "tool", "left out"];

const plain = (word) => word.toLowerCase().replace(/[^\p{L}\p{N}-]/gu, "");

/**
 * The prompt's words in their order, each with the role of the reading that it is part of. The reading
 * has normalised words, names of several together, and what is left out at its end.
 */
export function wordsWithRoles({ words, reading = [], corrected }) {
  if (!words?.length) return reading.map(({ text, role }) => ({ word: text, role, moved: {} }));
  const joined = (text) => plain(text).replaceAll("-", "");
  const parts = reading.flatMap(({ text, role }) => text.split(/\s+/).map((part) => ({ part: joined(part), role })));
  const sought = words.map(({ word }) => joined(corrected?.said === plain(word) ? corrected.taken : word));
  const roles = sought.map(() => null);
  for (let n = 0; n < words.length; n++) {
    // A name may be read as one word that was written as several: cork board, corkboard.
    for (let count = 1; roles[n] === null && count <= MOST_JOINED && n + count <= words.length; count++) {
      const at = parts.findIndex(({ part }) => part === sought.slice(n, n + count).join(""));
      if (at >= 0) roles.fill(parts.splice(at, 1)[0].role, n, n + count);
    }
  }
  return words.map(({ word, ...moved }, n) => ({ word, role: roles[n], moved }));
}

function wordElement({ word, role, moved }) {
  const moves = ATTRIBUTES.map((name) => [name, moved[name] ?? 0])
    .filter(([, by]) => Math.abs(by) >= LEAST)
    .sort((a, b) => Math.abs(b[1]) - Math.abs(a[1]));
  const signed = (by) => `${by < 0 ? "−" : "+"}${Math.abs(by).toFixed(0)}`;
  const gone = role === null || NOT_ENCODED.includes(role);
  const shown = moves.filter(([, by], n) => n === 0 || (n === 1 && Math.abs(by) >= LEAST_SECOND));
  return element("li", { class: "word", "data-role": role ?? "unused", "data-moved": gone ? undefined : moves[0]?.[0] },
    element("span", { class: "said" }, word),
    element("span", { class: "role" }, role === null ? texts.reading.unused : (texts.reading.roles[role] ?? role)),
    ...shown.map(([name, by]) => element("span", { class: `move ${name}` }, `${name} ${signed(by)}`)));
}

/** Warnings of the command that no row shows. */
function notes({ warnings = [], corrected, not_understood = [], certainty_level }) {
  const shown = [corrected?.said, ...not_understood].filter(Boolean);
  const isShown = (text) => shown.some((word) => text.includes(word)) || (certainty_level === "guess" && text.startsWith("a guess")) ||
    (certainty_level === "no_contact" && text.startsWith("nothing in the prompt is touched"));
  return warnings.filter((text) => !isShown(text));
}

export function certaintyText({ certainty_level: level }) {
  return `${texts.reading.certainty[level] ?? level}: ${texts.reading.certainty_help[level] ?? ""}`;
}

export function showReading(compiled) {
  const panel = find("reading");
  panel.hidden = !compiled;
  if (!compiled) return panel.replaceChildren();
  const { certainty_level: level, certainty, corrected, not_understood = [], taken_as, prompt } = compiled;
  const row = (name, text) => [element("dt", {}, name), element("dd", {}, text)];
  const words = (text) => text.split(/\s+/).map(plain).filter(Boolean).join(" ");
  const rows = [
    ...(corrected ? row(texts.reading.rows.corrected, texts.reading.corrected(corrected.said, corrected.taken)) : []),
    ...(taken_as && words(taken_as) !== words(prompt ?? "") ? row(texts.reading.rows.taken, taken_as) : []),
    ...(not_understood.length ? row(texts.reading.rows.unread, not_understood.join(", ")) : []),
    ...notes(compiled).flatMap((text) => row(texts.reading.rows.note, text)),
  ];
  panel.scrollTop = 0;
  panel.replaceChildren(
    element("ul", { class: "words", "aria-label": texts.reading.words, title: texts.reading.words },
      ...wordsWithRoles(compiled).map(wordElement)),
    element("p", { class: "certainty", "data-level": level }, element("strong", {}, texts.reading.certainty[level] ?? level),
      " ", element("span", { class: "why" }, texts.reading.certainty_help[level] ?? ""), " ", element("span", { class: "small" }, texts.reading.share(certainty))),
    ...(rows.length ? [element("dl", { class: "rows" }, ...rows)] : []));
}

/** The nearest materials as buttons that compile their names. */
export function showNearest(texture, compile) {
  const panel = find("nearest");
  const nearest = texture?.compiled?.nearest?.filter(({ weight }) => weight >= 0.005).slice(0, MOST_MATERIALS) ?? [];
  if (nearest.length === 0) {
    const text = texture && !texture.compiled ? texts.nearest.opened : texts.nearest.none;
    return panel.replaceChildren(element("p", { class: "none" }, text));
  }
  const button = ({ name, weight }) => {
    const bar = element("span", { class: "share" });
    // Styles by script: the policy of the page forbids style attributes.
    bar.style.setProperty("--share", weight);
    return element("li", {}, element("button", { type: "button", class: "material", onclick: () => compile(name),
      title: texts.nearest.compile(name, (100 * weight).toFixed(0)) }, bar, element("span", {}, name),
    element("span", { class: "percent" }, texts.nearest.percent(weight))));
  };
  panel.replaceChildren(element("ul", { class: "materials" }, ...nearest.map(button)));
}
