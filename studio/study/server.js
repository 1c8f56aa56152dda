// The study's server. While it does not answer, a call waits and is made again, so that nothing is lost.

import { recall, remember } from "../page/dom.js";
import { Events } from "../page/events.js";
import { texts } from "./texts.js";

const RETRY_MS = 3000;
/** A call that takes longer counts as unanswered, ms. */
const PATIENCE_MS = 30_000;
/** One browser may take part in several studies. */
const KEY = `study${location.pathname}`;

/** The server refused; `message` and `help` are its texts. `retried` where an earlier attempt may have reached it. */
export class Refusal extends Error {
  help; status; retried;

  constructor(message, help, status, retried = false) {
    super(message);
    Object.assign(this, { help, status, retried });
  }
}

/** Emits "silence" when a call was not answered, and "answer" when one was. */
export class Server extends Events {
  #me = recall(KEY, null);
  /** What ends the rests of calls that wait. */
  #resting = new Set();

  /** Whether this browser has been here before. */
  get known() {
    return this.#me !== null;
  }

  /** Takes part: anew, or as who this browser was. */
  async join() {
    const { me } = await this.#post("api/join", this.#me ? { me: this.#me } : {});
    this.#me = me;
    remember(KEY, me);
  }

  /** The next `join` is another participant's. */
  forget() {
    this.#me = null;
    remember(KEY, null);
  }

  async step() {
    return parsed(await this.#ask(this.#mine("api/step")));
  }

  try(index, prompt) {
    return this.#post(this.#mine("api/try"), { index, prompt });
  }

  answer(answer) {
    return this.#post(this.#mine("api/answer"), answer);
  }

  withdraw() {
    return this.#post(this.#mine("api/withdraw"), {});
  }

  /** A part of a session's log, from its tick `first` on. */
  async log(index, first, body) {
    await this.#ask(this.#mine("api/log", { index, first }),
      { method: "POST", headers: { "Content-Type": "application/octet-stream" }, body });
  }

  /** A file of the page or of a texture, an ArrayBuffer. */
  file(name) {
    return this.#ask(name);
  }

  async picture(name) {
    return new Blob([await this.#ask(name)], { type: "image/png" });
  }

  /** What the device did from the number `after` on. */
  async deviceTicks(after) {
    return parsed(await this.#ask(`api/device/ticks${after === undefined ? "" : `?after=${after}`}`));
  }

  /** Makes all calls that wait at once. */
  retry() {
    for (const end of this.#resting) end();
  }

  #mine(path, more = {}) {
    return `${path}?${new URLSearchParams({ me: this.#me, ...more })}`;
  }

  async #post(path, value) {
    return parsed(await this.#ask(path,
      { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(value) }));
  }

  /** The bytes of an answer, however long it takes. */
  async #ask(path, options = {}) {
    for (let retried = false; ; retried = true) {
      const answer = await once(path, options);
      if (answer) {
        this.emit("answer");
        if (answer.ok) return answer.bytes;
        const { error = texts.server.unreadable, help = texts.server.unreadable_help } = tried(answer.bytes);
        throw new Refusal(error, help, answer.status, retried);
      }
      this.emit("silence");
      await new Promise((done) => {
        const end = () => {
          clearTimeout(timer);
          this.#resting.delete(end);
          done(undefined);
        };
        const timer = setTimeout(end, RETRY_MS);
        this.#resting.add(end);
      });
    }
  }
}

/** One attempt: { ok, status, bytes }; null where the server does not answer, or is in trouble itself. */
async function once(path, options) {
  try {
    const signal = AbortSignal.timeout(PATIENCE_MS);
    const response = await fetch(new URL(path, document.baseURI), { ...options, signal });
    const { ok, status } = response;
    return status >= 500 ? null : { ok, status, bytes: await response.arrayBuffer() };
  } catch {
    return null;
  }
}

function parsed(bytes) {
  try {
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    throw new Refusal(texts.server.unreadable, texts.server.unreadable_help, 200);
  }
}

/** What a refusal says; without the study's server there may be no JSON. */
function tried(bytes) {
  try {
    return parsed(bytes) ?? {};
  } catch {
    return {};
  }
}
