// The positions of a session's ticks on their way to the server, in parts, one after the other.

/** Ticks of a part: 4 s. */
const PART_TICKS = 64_000;

export class Log {
  #send;
  /** What waits to be sent: the number of its first tick, and arrays of positions. */
  #first = 0;
  #count = 0;
  #arrays = [];
  /** What was sent of the session. */
  #parts = [];
  #sent = Promise.resolve();
  #failure = null;

  /** `send(first, blob)` takes the positions from the tick `first` on: little-endian f32, as every machine with a browser has them. */
  constructor(send) {
    this.#send = send;
  }

  /** A session begins: what was kept of another one is void. */
  begin() {
    this.#first = this.#count = 0;
    this.#arrays = [];
    this.#parts = [];
    this.#failure = null;
  }

  /** Takes a message of ticks. */
  add({ positions_mm }) {
    const ticks = positions_mm.length / 3;
    if (this.#count + ticks > PART_TICKS) this.#part();
    this.#arrays.push(positions_mm);
    this.#count += ticks;
  }

  /** Sends what is left; resolves when the server has all. */
  async finish() {
    this.#part();
    await this.#sent;
    if (!this.#failure) return;
    // The server may have lost what it had: it was started again, or another tab has opened the step.
    for (const part of this.#parts) await this.#send(...part);
    this.#failure = null;
  }

  #part() {
    if (this.#count === 0) return;
    const part = [this.#first, new Blob(this.#arrays)];
    this.#parts.push(part);
    this.#first += this.#count;
    this.#count = 0;
    this.#arrays = [];
    this.#sent = this.#sent.then(() => this.#failure || this.#send(...part)).catch((error) => (this.#failure = error));
  }
}
