// What the sound is for. A mode prepares what the renderer gives for ears or actuators, and says where it goes.

/** Corners of what fingers feel and voice coils play, Hz. */
export const LOW_HZ = 20;
export const HIGH_HZ = 500;
/** Pole pairs of a Butterworth filter of the fourth order. */
const FOURTH_ORDER = [0.541196, 1.306563];
/** By how much the mode for headphones raises every component, Hz. */
export const SHIFT_HZ = 250;

/** `start_db`: the level that a mode begins with; `channels`: those that play, of a device with that many at least. */
export const MODES = {
  plain: { start_db: -6 },
  ear: { start_db: -6 },
  coil: { start_db: -50 },
  dualsense: { start_db: -50, channels: [2, 3] },
};

/** Channels of a DualSense. */
export const CHANNELS = 4;

/** The nodes between the renderer and the drive. */
export function stagesOf(name, context) {
  const filter = (type, frequency, q) => new BiquadFilterNode(context, { type, frequency, Q: 20 * Math.log10(q) });
  const passes = (type, frequency) => FOURTH_ORDER.map((q) => filter(type, frequency, q));
  switch (name) {
    case "ear":
      return [...passes("highpass", LOW_HZ), new AudioWorkletNode(context, "shift",
        { outputChannelCount: [1], processorOptions: { shift_hz: SHIFT_HZ } })];
    case "coil":
    case "dualsense":
      return [...passes("highpass", LOW_HZ), ...passes("lowpass", HIGH_HZ)];
    default:
      return [];
  }
}
