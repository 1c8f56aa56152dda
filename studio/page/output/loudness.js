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
