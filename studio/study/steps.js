// The steps of a study. Each builds its page and gives { answer, save, leave }: what is sent when the person goes on, what the
// server has to have before, and what ends with the step. A step without `answer` is the last.

import { element, find } from "../page/dom.js";
import { answers, field, slider, unanswered } from "./fields.js";
import { paragraphs } from "./page.js";
import { prompt } from "./prompt.js";
import { texts } from "./texts.js";
import { Trial } from "./trial.js";

const nothing = async () => {};
const simple = (answer) => ({ answer, save: nothing, leave: () => {} });

async function consent({ text, device }, { page }) {
  const sound = device ? [] : [element("p", {}, texts.consent.sound)];
  page.show({ heading: texts.consent.heading, kind: "consent", next: texts.begin,
    content: [...paragraphs(text), ...sound, element("p", {}, texts.consent.agree)] });
  return simple(() => ({ response: { agreed: true } }));
}

async function rating(step, parts) {
  const { page, touch } = parts;
  page.wait(texts.rating.loading);
  const trial = new Trial(parts, step);
  const update = () => page.missing([...trial.missing(), ...unanswered(fields)]);
  const fields = step.attributes.map((attribute) => slider({ ...attribute, least: 0, most: 100 }, update));
  await trial.play({});
  page.show({ heading: step.practice ? texts.rating.practice : texts.rating.heading, kind: "rating", next: texts.next, touched: true,
    content: fields.map(({ element }) => element) });
  trial.changed = update;
  update();
  return { answer: () => ({ response: answers(fields), ...trial.counts() }), save: () => trial.save(), leave: () => touch.leave() };
}

async function rest({ seconds, done, total }, { page }) {
  const clock = element("p", { class: "clock", role: "timer", "aria-label": texts.break.timer });
  page.show({ heading: texts.break.heading, kind: "break", next: texts.go_on,
    content: [element("p", {}, texts.break.text(done, total)), clock] });
  const until_ms = performance.now() + 1000 * seconds;
  const tick = () => {
    const left = Math.max(Math.ceil((until_ms - performance.now()) / 1000), 0);
    clock.textContent = texts.break.left(left);
    if (left > 0) return page.missing([texts.missing.wait]);
    clearInterval(timer);
    page.missing([], texts.break.over);
  };
  const timer = setInterval(tick, 200);
  tick();
  return { answer: () => ({ response: {} }), save: nothing, leave: () => clearInterval(timer) };
}

async function form({ heading, text, items }, { page }) {
  const update = () => page.missing(unanswered(fields));
  const fields = items.map((item) => field(item, update));
  page.show({ heading, kind: "form", next: texts.next, content: [...paragraphs(text), ...fields.map(({ element }) => element)] });
  update();
  return simple(() => ({ response: answers(fields) }));
}

async function end({ text }, { page, server }) {
  const begin = () => {
    server.forget();
    location.reload();
  };
  page.show({ heading: texts.end.heading, kind: "end", content: [...paragraphs(text),
    element("p", {}, element("button", { type: "button", class: "quiet", id: "other", onclick: begin }, texts.end.other))] });
  find("withdraw").hidden = true;
  return { answer: null, save: nothing, leave: () => {} };
}

export const STEPS = { consent, rating, break: rest, form, prompt, end };
