// What all figures look at: the kept ticks, the moment that is shown, the texture, a chosen point.

import { COLUMN, FLAG, Ring } from "./ring.js";

// Messages bring a tenth of a second at once; the playhead runs through them at the pace of the clock, so that nothing jumps.
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

/** What can be scrolled back to and saved, s. */
const HISTORY_S = 30;

export class Scope {
  inspect = null;
  /** The `Models` of the texture. */
  models = null;
  /** { speed_mm_s, force_n, vertex } that pointer or keys chose in the plane. */
  chosen = null;

  constructor(tick_hz) {
    this.begin(tick_hz);
  }

  /** Forgets all ticks; those of another rate follow. */
  begin(tick_hz) {
    this.tick_hz = tick_hz;
    this.ring = new Ring(HISTORY_S * tick_hz);
    this.playhead = new Playhead(tick_hz);
    this.frozen = false;
  }

  setTexture(inspect, models) {
    Object.assign(this, { inspect, models, chosen: null });
  }

  /** The tick after the last one shown. */
  get now() {
    return Math.floor(this.playhead.tick);
  }

  ticks(seconds) {
    return Math.round(seconds * this.tick_hz);
  }

  add(message) {
    // What is frozen stays. A table has no gaps, so the run that follows begins anew.
    if (this.frozen) return;
    if (this.ring.add(message)) this.playhead.tick = this.ring.first;
  }

  /** Moves on to `now_s`; returns whether something else is shown, and whether more is to come. */
  advance(now_s) {
    const before = this.now;
    if (!this.frozen) this.playhead.advance(now_s, this.ring.first, this.ring.end);
    return { moved: this.now !== before, goes_on: !this.frozen && this.playhead.tick < this.ring.end };
  }

  freeze(on) {
    this.frozen = on;
    if (on) this.playhead.tick = this.ring.end;
  }

  /** While frozen, shows what was at a tick. */
  scroll(tick) {
    const { first, end } = this.ring;
    this.playhead.tick = Math.min(Math.max(Math.round(tick), first), end);
  }

  /** The hand at the tick shown: null before the first one. */
  get hand() {
    const tick = this.now - 1;
    if (!this.ring.has(tick)) return null;
    return { ...this.ring.query(tick), touches: (this.ring.flagsAt(tick) & FLAG.contact) !== 0 };
  }

  /** Acceleration of tick `tick`, m/s²: vibration and tap, as the sound has them. */
  acceleration(tick) {
    const mass_kg = this.inspect?.gains.effective_mass_kg;
    const tap_m_s2 = mass_kg > 0 ? this.ring.at(tick, COLUMN.tap_n) / mass_kg : 0;
    return this.ring.at(tick, COLUMN.vib_m_s2) + tap_m_s2;
  }
}
