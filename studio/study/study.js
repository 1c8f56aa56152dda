// The entry of the participant's page: joins, and goes from step to step until the end.

import { find, notify, withdraw } from "../page/dom.js";
import { Page, paragraphs } from "./page.js";
import { Refusal, Server } from "./server.js";
import { STEPS } from "./steps.js";
import { texts } from "./texts.js";
import { Touch } from "./touch.js";
import { startWithdrawal } from "./withdrawal.js";

const server = new Server();
const touch = new Touch(server);
const page = new Page(() => touch.wake());
const parts = { server, touch, page };

const broken = () => notify("broken", { text: texts.server.broken, help: texts.server.broken_help });
addEventListener("error", broken);
addEventListener("unhandledrejection", broken);

let silent = false;
server.on("silence", () => {
  if (silent) return;
  silent = true;
  notify("server", { text: texts.server.silent, help: texts.server.silent_help,
    action: { label: texts.server.retry, run: () => server.retry() } });
});
server.on("answer", () => {
  silent = false;
  withdraw("server");
});

/** Says why the server refuses, and resolves when the person wants to try again. */
const refused = ({ message, help }) => new Promise((done) => notify("refused", { text: message, help,
  action: { label: texts.server.refused_again, run: () => {
    withdraw("refused");
    done(undefined);
  } } }));

/** Takes part, or says why not; whether it is so. */
async function joined() {
  page.wait(texts.join.connecting);
  for (;;) {
    try {
      await server.join();
      return true;
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      if (error.status === 409) {
        page.close(texts.join.full, texts.join.full_text);
        return false;
      }
      if (error.status === 403 && server.known) {
        page.show({ heading: texts.join.unknown, kind: "consent", content: paragraphs(texts.join.unknown_text), next: texts.begin });
        await page.pressed();
        server.forget();
      } else await refused(error);
    }
  }
}

/** A browser lets nothing sound that nobody has clicked in since the page was loaded. */
async function woken(step) {
  if (!["rating", "prompt"].includes(step.kind) || !touch.asleep) return true;
  page.show({ heading: texts.resume.heading, kind: "consent", content: paragraphs(texts.resume.text), next: texts.go_on });
  return page.pressed();
}

/** Sends an answer once; whether the step is over. The same answer may be sent again where it is not. */
async function sent(step, shown) {
  const answer = { index: step.index, rt_ms: Math.round(performance.now() - page.shown_ms), ...shown.answer() };
  page.sending(true);
  try {
    await shown.save();
    await server.answer(answer);
    return true;
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    if (error.status === 409) {
      // An answer that was sent again may have reached the server the first time.
      if (!error.retried) notify("elsewhere", { text: texts.server.elsewhere, help: texts.server.elsewhere_help, done: true });
      return true;
    }
    notify("refused", { text: error.message, help: error.help });
    page.sending(false);
    return false;
  }
}

/** Goes through a step; whether another one follows. */
async function through(step) {
  touch.begin(step);
  page.place(step);
  find("withdraw").hidden = false;
  if (!(await woken(step))) return true;
  const shown = await STEPS[step.kind](step, parts);
  if (!shown.answer) return false;
  try {
    while (await page.pressed()) {
      for (const key of ["refused", "elsewhere"]) withdraw(key);
      if (await sent(step, shown)) break;
    }
  } finally {
    await shown.leave();
  }
  return true;
}

async function run() {
  if (!(await joined())) return;
  for (let goes_on = true; goes_on;) {
    try {
      goes_on = await through(await server.step());
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      // Who is not known any more may begin anew.
      if (error.status !== 403) await refused(error);
      else if (!(await joined())) return;
    }
  }
}

startWithdrawal(parts);
run();
