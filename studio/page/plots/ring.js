// The last ticks of a session: what memory holds of them, in typed arrays that never grow.
//
// A tick keeps its number. Ticks of another session, or after a gap, begin a new run, since a table
// has one row a tick. Least and greatest values of blocks of ticks are kept for long views.

/** What a tick's nine numbers are, in the order of the worklet and of `asperity render`. */
export const COLUMNS = ["depth_mm", "speed_mm_s", "normal_force_n", "vib_m_s2", "tap_n", "friction_n", "fx_n", "fy_n", "fz_n"];
export const WIDTH = COLUMNS.length;
export const COLUMN = Object.fromEntries(COLUMNS.map((name, k) => [name, k]));
/** The bits of `flags` that are looked at (`runtime/src/events.rs`). */
export const FLAG = { contact: 1 };
/** Ticks of a block. */
export const BLOCK = 64;

export class Ring {
  /** Keeps `ticks` ticks, rounded up to whole blocks. */
  constructor(ticks) {
    this.blocks = Math.ceil(ticks / BLOCK);
    this.capacity = this.blocks * BLOCK;
    this.columns = new Float32Array(WIDTH * this.capacity);
    this.positions_mm = new Float32Array(3 * this.capacity);
    this.flags = new Uint32Array(this.capacity);
    this.least = new Float32Array(WIDTH * this.blocks);
    this.greatest = new Float32Array(WIDTH * this.blocks);
    this.session = undefined;
    /** The first tick of the run that is kept, and the one after the last. */
    this.first = 0;
    this.end = 0;
  }

  /** Copies ticks from a kept one on, `most` of them or up to where the arrays begin again, as a message for `add`. */
  part(from, most) {
    const slot = from % this.capacity;
    const count = Math.min(most, this.end - from, this.capacity - slot);
    const cut = (array, width) => array.slice(width * slot, width * (slot + count));
    return {
      session: this.session,
      first: from,
      positions_mm: cut(this.positions_mm, 3),
      columns: cut(this.columns, WIDTH),
      flags: cut(this.flags, 1),
    };
  }

  /** Takes a `ticks` message of the worklet. Returns whether a new run begins. */
  add({ session, first, positions_mm, columns, flags }) {
    const begins = session !== this.session || first !== this.end;
    if (begins) [this.session, this.first, this.end] = [session, first, first];
    // Of more than fits, the end.
    const ticks = flags.length;
    for (let from = Math.max(0, ticks - this.capacity); from < ticks;) {
      const tick = first + from;
      const slot = tick % this.capacity;
      const count = Math.min(ticks - from, this.capacity - slot);
      this.columns.set(columns.subarray(WIDTH * from, WIDTH * (from + count)), WIDTH * slot);
      this.positions_mm.set(positions_mm.subarray(3 * from, 3 * (from + count)), 3 * slot);
      this.flags.set(flags.subarray(from, from + count), slot);
      this.#summarise(slot, count, tick === this.first);
      from += count;
    }
    this.end = first + ticks;
    // Whole blocks only, because the newest ticks have begun the block of the oldest ones.
    const oldest = BLOCK * Math.ceil((this.end - this.capacity) / BLOCK);
    this.first = Math.max(this.first, oldest);
    return begins;
  }

  /** Takes ticks into the extremes of their blocks. The first one of a block, or of a run, begins it. */
  #summarise(slot, count, begins) {
    const { columns, least, greatest } = this;
    for (let n = slot; n < slot + count; n++) {
      const to = WIDTH * Math.floor(n / BLOCK);
      const anew = n % BLOCK === 0 || (begins && n === slot);
      for (let k = 0; k < WIDTH; k++) {
        const x = columns[WIDTH * n + k];
        if (anew || x < least[to + k]) least[to + k] = x;
        if (anew || x > greatest[to + k]) greatest[to + k] = x;
      }
    }
  }

  /** Whether a tick is kept. */
  has(tick) {
    return tick >= this.first && tick < this.end;
  }

  /** A number of a tick that is kept. */
  at(tick, column) {
    return this.columns[WIDTH * (tick % this.capacity) + column];
  }

  /** Speed and force of a tick, for which a model is asked. */
  query(tick) {
    return { speed_mm_s: this.at(tick, COLUMN.speed_mm_s), force_n: this.at(tick, COLUMN.normal_force_n) };
  }

  flagsAt(tick) {
    return this.flags[tick % this.capacity];
  }

  position(tick, axis) {
    return this.positions_mm[3 * (tick % this.capacity) + axis];
  }

  /** Ticks `[from, to)` as far as they are kept. */
  kept(from, to) {
    const begin = Math.min(Math.max(Math.ceil(from), this.first), this.end);
    return [begin, Math.max(begin, Math.min(Math.floor(to), this.end))];
  }

  /** The least and the greatest value in the blocks that `[from, to)` meets; null without ticks. */
  extremes(column, from, to) {
    const [begin, end] = this.kept(from, to);
    if (begin === end) return null;
    let [low, high] = [Infinity, -Infinity];
    for (let block = Math.floor(begin / BLOCK); block * BLOCK < end; block++) {
      const at = WIDTH * (block % this.blocks) + column;
      if (this.least[at] < low) low = this.least[at];
      if (this.greatest[at] > high) high = this.greatest[at];
    }
    return [low, high];
  }

  /** Mean, and root of the mean square, of a column over the ticks kept of `[from, to)`. */
  moments(column, from, to) {
    const [begin, end] = this.kept(from, to);
    let [sum, squares] = [0, 0];
    for (let tick = begin; tick < end; tick++) {
      const x = this.at(tick, column);
      sum += x;
      squares += x * x;
    }
    const count = Math.max(end - begin, 1);
    return { mean: sum / count, rms: Math.sqrt(squares / count) };
  }
}
