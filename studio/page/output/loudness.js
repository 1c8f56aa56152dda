// How loud a texture is, and by how much it is turned up or down so that all are equally loud: the power of its vibration
// above 40 Hz in the standard stroke, 100 mm/s under 1 N, as `rough_db` of `asperity inspect` has it. Sound only: forces,
// ticks and files stay as they are.

/** Level that all textures are brought to, dB re 1 m/s². */
export const TARGET_DB = 4;
/** No texture is this much louder than the one before it, unless a person asked for it, dB. */
export const MOST_UP_DB = 6;
/** What hardly vibrates is turned up by no more, dB: taps would be far louder than strokes. */
const MOST_TRIM_DB = 30;

/** Level of the texture's vibration, dB re 1 m/s²; `null` where it has none. */
export const levelOf = (texture) => texture?.inspect.attributes.rough_db ?? null;

/**
 * What turns a texture to the target, dB. Sliders begin at `base`, whose trim they keep, so that rougher is heard as
 * stronger, but not by more than `MOST_UP_DB`.
 */
export function trimOf(texture, base = texture) {
  const [own_db, base_db] = [texture, base].map(levelOf);
  if (own_db === null) return 0;
  const trim_db = Math.min(TARGET_DB - (base_db ?? own_db), TARGET_DB + MOST_UP_DB - own_db);
  return Math.min(Math.max(trim_db, -MOST_TRIM_DB), MOST_TRIM_DB);
}

/** What turns the textures that play, one after the other. */
export class Loudness {
  /** What plays is turned up or down by this, dB. */
  trim_db = 0;
  #equal = true;
  #texture = null;
  #base = null;
  /** Level of what was played last, as strong as it is, dB. */
  #level_db = TARGET_DB - MOST_UP_DB;

  /** Makes all textures equally loud, or leaves each as strong as it is. */
  balance(equal) {
    this.#equal = equal;
    this.#level_db = levelOf(this.#texture) ?? this.#level_db;
    this.#trim();
  }

  /**
   * Takes the next texture, whose sliders began at `base`: whether it is turned up from the one before, and by how much the
   * level has to go down for it, dB. Where textures are as strong as they are, none comes as a shock.
   */
  play(texture, base) {
    this.#texture = texture;
    this.#base = base;
    const level_db = levelOf(texture);
    const louder_db = level_db === null ? 0 : level_db - this.#level_db - MOST_UP_DB;
    this.#level_db = level_db ?? this.#level_db;
    const before_db = this.trim_db;
    this.#trim();
    return { rises: this.trim_db > before_db, louder_db: this.#equal ? 0 : Math.max(louder_db, 0) };
  }

  #trim() {
    this.trim_db = this.#equal && this.#texture ? trimOf(this.#texture, this.#base) : 0;
  }
}
