// What all figures look at: the kept ticks, the moment that is shown, the texture, a chosen point.

import { Playhead } from "./playhead.js";
import { COLUMN, FLAG, Ring } from "./ring.js";

export class Scope {
  constructor(tick_hz, history_s) {
    this.tick_hz = tick_hz;
    this.ring = new Ring(history_s * tick_hz);
    this.playhead = new Playhead(tick_hz);
    this.frozen = false;
    this.inspect = null;
    /** The `Models` of the texture. */
    this.models = null;
    /** { speed_mm_s, force_n, vertex } that pointer or keys chose in the plane. */
    this.chosen = null;
  }

  setTexture(inspect, models) {
    this.inspect = inspect;
    this.models = models;
    this.chosen = null;
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
    if (this.ring.add(message)) this.playhead.jump(this.ring.first);
  }

  /** Moves on to `now_s`; returns whether something else is shown, and whether more is to come. */
  advance(now_s) {
    const before = this.now;
    if (!this.frozen) this.playhead.advance(now_s, this.ring.first, this.ring.end);
    return { moved: this.now !== before, goes_on: !this.frozen && this.playhead.tick < this.ring.end };
  }

  freeze(on) {
    this.frozen = on;
    if (on) this.playhead.jump(this.ring.end);
  }

  /** While frozen, shows what was at a tick. */
  scroll(tick) {
    const { first, end } = this.ring;
    this.playhead.jump(Math.min(Math.max(Math.round(tick), first), end));
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
