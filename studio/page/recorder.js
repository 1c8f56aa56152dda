// The ticks of the renderer on their way to the page, many in a message.

/** Ticks of a message, a tenth of a second. */
const CHUNK_TICKS = 1600;

/** Posts ticks while it is `on`. */
export class Recorder {
  constructor(port) {
    this.port = port;
    this.on = false;
    this.count = 0;
  }

  add(session, first, ticks, positions_mm, columns, flags) {
    for (let n = 0; n < ticks; n++) {
      if (this.count === 0) {
        this.message = { type: "ticks", session, first: first + n,
          positions_mm: new Float32Array(3 * CHUNK_TICKS), columns: new Float32Array(9 * CHUNK_TICKS),
          flags: new Uint32Array(CHUNK_TICKS) };
      }
      const { message, count } = this;
      for (let k = 0; k < 3; k++) message.positions_mm[3 * count + k] = positions_mm[3 * n + k];
      for (let k = 0; k < 9; k++) message.columns[9 * count + k] = columns[9 * n + k];
      message.flags[count] = flags[n];
      this.count++;
      if (this.count === CHUNK_TICKS) this.flush();
    }
  }

  flush() {
    const { message, count } = this;
    if (count === 0) return;
    message.positions_mm = message.positions_mm.slice(0, 3 * count);
    message.columns = message.columns.slice(0, 9 * count);
    message.flags = message.flags.slice(0, count);
    this.port.postMessage(message, [message.positions_mm, message.columns, message.flags].map((array) => array.buffer));
    this.count = 0;
  }
}
