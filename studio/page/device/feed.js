// Ticks of the servo loop behind the server. The next ones are asked for when the last ones are dealt
// with, so that a page that is slow skips ticks and never falls behind.

import { Events } from "../events.js";

/** At most so often, ms: a frame shows no more. */
const LEAST_MS = 30;
/** Rest after a failure, ms. */
const RETRY_MS = 2000;

const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
const nextFrame = () => new Promise((done) => requestAnimationFrame(done));

/**
 * Emits "news" of the server and "ticks" for the plots as those of the worklet; "silence" with the error where the server does
 * not answer, and with null when it does again.
 */
export class Feed extends Events {
  /** Ticks that the page did not get. */
  lost = 0;
  #server;
  /** Each run of the loop begins with tick 0, which is another session of the plots. */
  #session = -1;
  #last = Infinity;

  constructor(server) {
    super();
    this.#server = server;
  }

  /** Asks until the loop is over. */
  async run() {
    let after;
    for (let ended = false; !ended;) {
      // A page that nobody sees gets no frame, and so asks for nothing.
      await nextFrame();
      const began_ms = performance.now();
      try {
        const news = await this.#server.deviceTicks(after);
        ({ next: after, ended } = news);
        this.lost += news.lost;
        this.emit("silence", null);
        this.emit("news", news);
        for (const run of news.ticks.runs) this.emit("ticks", this.#message(run));
      } catch (error) {
        this.emit("silence", error);
        await sleep(RETRY_MS);
      }
      await sleep(Math.max(0, LEAST_MS - (performance.now() - began_ms)));
    }
  }

  #message({ first, positions_mm, columns, flags, wakeup_us }) {
    if (first < this.#last) this.#session--;
    this.#last = first + flags.length;
    return { type: "ticks", session: this.#session, first, wakeup_us, positions_mm: Float32Array.from(positions_mm),
      columns: Float32Array.from(columns), flags: Uint32Array.from(flags) };
  }
}
