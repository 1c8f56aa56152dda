// The positions of a session's ticks on their way to the server, in parts, one after the other.

/** Ticks of a part: 4 s. */
const PART_TICKS = 64_000;

export class Log {
  #send;
  /** What waits to be sent: the number of its first tick, and arrays of positions. */
  #first = 0;
  #count = 0;
  #arrays = [];
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
  }

  /** Takes a message of ticks. */
  add({ positions_mm }) {
    const ticks = positions_mm.length / 3;
    if (this.#count + ticks > PART_TICKS) this.#part();
    this.#arrays.push(positions_mm);
    this.#count += ticks;
  }

  /** Sends what is left; resolves when the server has all, and fails as a part did. */
  async finish() {
    this.#part();
    await this.#sent;
    if (this.#failure) throw this.#failure;
  }

  #part() {
    if (this.#count === 0) return;
    const [first, blob] = [this.#first, new Blob(this.#arrays)];
    this.#first += this.#count;
    this.#count = 0;
    this.#arrays = [];
    this.#sent = this.#sent.then(() => this.#failure || this.#send(first, blob)).catch((error) => (this.#failure = error));
  }
}
