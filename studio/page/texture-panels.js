// What the page says about the texture: the prompt's reading, its neighbours, its facts, and its command lines.

import { announce, copy, element, find } from "./dom.js";
import { Prompt } from "./prompt.js";
import { certaintyText, showNearest, showReading } from "./reading.js";
import { texts } from "./texts.js";

/** Textures whose prompts are known: more than a session has. */
const MOST_PROMPTED = 256;

/** An arrow along the ribs, the grain or the nap, and what a stroke along it meets. */
function axisBadge({ axis, power_ratio, speed_ratio, mu_forward, mu_backward }) {
  const level_db = 10 * Math.log10(power_ratio) - 20 * Math.log10(speed_ratio);
  const mu = mu_forward.toFixed(2) === mu_backward.toFixed(2) ? [mu_forward] : [mu_forward, mu_backward];
  const along = power_ratio > 0 ? texts.surface.along(level_db) : texts.surface.silent_along;
  const title = texts.surface.along_title(speed_ratio, mu);
  return element("span", { class: "badge", id: "axis", title }, `${texts.surface.axis(axis)} ${along}`);
}

function showFacts(texture) {
  find("surface-title").textContent = texture?.name ?? texts.surface.empty;
  if (!texture) return;
  document.title = texts.titled(texture.name);
  const { asset_bytes, model_rate_hz, worklet_rate_hz } = texture;
  const direction = texture.inspect?.direction;
  const rerated = worklet_rate_hz !== model_rate_hz;
  find("facts").replaceChildren(
    element("span", {}, `${texts.surface.kilobytes(asset_bytes)} · ${texts.surface.rate(model_rate_hz)}`),
    ...(direction ? [" ", axisBadge(direction)] : []),
    ...(rerated ? [" ", element("span", { class: "badge" }, texts.surface.rerated(model_rate_hz, worklet_rate_hz))] : []));
}

/** The command lines that write the bytes of what is shown. */
function showCommand(texture) {
  const panel = find("command");
  panel.hidden = !texture?.command;
  if (panel.hidden) return panel.replaceChildren();
  const code = element("code", { tabindex: "0", "aria-label": texts.command.label }, texture.command);
  const button = element("button", { type: "button", class: "quiet", onclick: () => copy(button, texture.command, code) }, texts.copy.copy);
  panel.replaceChildren(element("span", { class: "small" }, texts.command.label), code, button);
}

function invite(compile) {
  find("invitation").replaceChildren(element("p", {}, texts.prompt.invitation),
    ...texts.prompt.examples.map((example) => element("button", { type: "button", onclick: () => compile(example) }, example)));
}

export function startTexturePanels({ state, loader }) {
  const prompt = new Prompt((text) => loader.compile(text), () => loader.cancel());
  invite(prompt.compile);
  showNearest(null, prompt.compile);

  // Sliders and words keep to the prompt that they began with, by the names of textures.
  const prompted = new Map();
  loader.on("shown", ({ texture, how }) => {
    if (texture.compiled) prompted.set(texture.id, texture);
    else if (!prompted.has(texture.id)) {
      const base = how.entry?.base ?? how.base ?? how.of;
      prompted.set(texture.id, prompted.get(base?.id) ?? (base?.compiled && base));
    }
    if (prompted.size > MOST_PROMPTED) prompted.delete(prompted.keys().next().value);
    const from = prompted.get(texture.id) ?? texture;
    showReading(from.compiled);
    showNearest(from, prompt.compile);
    if (how.kind === "undo" && from.compiled) prompt.bring(from.compiled.prompt);
    if (how.kind !== "prompt" || how.begins) return;
    prompt.accept(how.prompt);
    announce(texts.prompt.compiled(texture.name, texture.compiled ? certaintyText(texture.compiled) : ""));
  });
  loader.on("refused", ({ refusal, how }) => how?.kind === "prompt" && prompt.refuse(refusal));

  state.on(["busy"], ({ busy }) => (prompt.busy = busy?.kind === "prompt"));
  state.on(["about"], ({ about }) => {
    if (!about) return;
    prompt.words = about.words;
    if (!about.prompts) prompt.withdraw();
    find("edition").textContent = texts.edition(about.version, about.library, about.project);
  });
  state.on(["texture"], ({ texture }) => {
    find("invitation").hidden = texture !== null;
    showFacts(texture);
    showCommand(texture);
  });
}
