//! AHAP, the Apple Haptic and Audio Pattern: continuous and transient events, and controls of intensity and
//! sharpness that apply to all events: parameters, which are steps, and curves of at most 16 points.
//!
//! An intensity is the square root of an amplitude, as the players of NiceVibrations have it. A
//! sharpness s is 65 Hz + 235 Hz·s, as the reference software of MPEG has it; Apple states neither.
//!
//! | file | holds |
//! |---|---|
//! | `write` | a clip as an AHAP |
//! | `document` | the shape of a file; of what is not used, only that it is JSON |
//! | `control` | intensity or sharpness over time |
//! | `notes` | what is read otherwise than it was meant, in one line a kind |
//! | `read` | what a file plays |

mod control;
mod document;
mod notes;
#[cfg(test)]
mod player;
mod read;
#[cfg(test)]
mod tests;
mod write;

pub(crate) use read::read;
pub(super) use write::write;

const CONTINUOUS: &str = "HapticContinuous";
const TRANSIENT: &str = "HapticTransient";
const INTENSITY: &str = "HapticIntensity";
const SHARPNESS: &str = "HapticSharpness";
const INTENSITY_CONTROL: &str = "HapticIntensityControl";
const SHARPNESS_CONTROL: &str = "HapticSharpnessControl";
/// Longest continuous event, s.
const EVENT_S: f64 = 30.0;
