// Which tick the plots show. Messages bring a tenth of a second at once; the playhead runs through
// them at the pace of the clock, so that nothing jumps.

/** How far it keeps behind the newest tick, s: a message, and some jitter. */
const LAG_S = 0.13;
/** Farther behind, it jumps, s. */
const FARTHEST_S = 0.5;
/** Change of pace for each second that the lag is off. */
const CORRECTION = 2;

export class Playhead {
  constructor(tick_hz) {
    this.tick_hz = tick_hz;
    this.tick = 0;
    this.clock_s = undefined;
  }

  /** Goes to a tick at once. */
  jump(tick) {
    this.tick = tick;
  }

  /** The tick to show at `now_s` of ticks `[first, end)`; it stops at the newest one. */
  advance(now_s, first, end) {
    const passed_s = this.clock_s === undefined ? 0 : Math.max(0, now_s - this.clock_s);
    this.clock_s = now_s;
    const lag_s = (end - this.tick) / this.tick_hz;
    if (lag_s > FARTHEST_S || lag_s < 0) {
      this.tick = end - LAG_S * this.tick_hz;
    } else {
      const pace = Math.max(0.5, 1 + CORRECTION * (lag_s - LAG_S));
      this.tick += passed_s * this.tick_hz * pace;
    }
    this.tick = Math.min(Math.max(this.tick, first), end);
    return this.tick;
  }
}
