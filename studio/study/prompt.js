// The step in which a person describes a surface, explores what is made of it, and may refine it.

import { busily, element } from "../page/dom.js";
import { paragraphs } from "./page.js";
import { Refusal } from "./server.js";
import { texts } from "./texts.js";
import { Trial } from "./trial.js";

export async function prompt(step, parts) {
  const { page, touch, server } = parts;
  const trial = new Trial(parts, step);
  let left = step.tries_left ?? step.tries;
  let tried = false;

  const input = element("input", { type: "text", id: "words", maxlength: 2000, autocomplete: "off", autocapitalize: "off",
    "aria-describedby": "said" });
  const button = element("button", { type: "submit" }, texts.prompt.try);
  const said = element("p", { id: "said", role: "status" });
  const words = element("form", { class: "words-form" }, element("label", { for: "words" }, texts.prompt.label), input, button);
  const content = [...paragraphs(step.text), words, said];
  const show = () => page.show({ heading: texts.prompt.heading, kind: "prompt", next: texts.done, touched: tried, content });
  const update = () => page.missing(tried ? trial.missing() : [texts.missing.prompt]);

  const explore = async (texture, words_tried) => {
    await trial.play(texture);
    const begins = !tried;
    tried = true;
    // The step was shown before; only the surface joins it.
    if (begins) page.join();
    said.textContent = [texts.prompt.made(words_tried), left > 0 ? "" : texts.prompt.last].join(" ").trim();
    if (left > 0) button.textContent = texts.prompt.refine(left);
    else for (const at of [input, button]) at.disabled = true;
    update();
  };

  const make = () => busily(button, async () => {
    const wanted = input.value.trim();
    if (!wanted) return (said.textContent = texts.prompt.empty);
    page.missing([texts.missing.prompt]);
    said.textContent = texts.prompt.making;
    try {
      const { texture, width_mm, tries_left } = await server.try(step.index, wanted);
      left = tries_left;
      await explore({ texture, width_mm }, wanted);
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      if (error.status === 409) return page.interrupt();
      said.textContent = [error.message, error.help].filter(Boolean).join(" ");
      update();
    }
  });
  words.addEventListener("submit", (event) => {
    event.preventDefault();
    make();
  });

  trial.changed = update;
  show();
  update();
  // After a reload the server says what was tried last.
  if (step.texture) await explore({ texture: step.texture, width_mm: step.width_mm }, step.prompt ?? "");
  return { answer: () => ({ response: {}, ...trial.counts() }), save: () => trial.save(), leave: () => touch.leave() };
}
