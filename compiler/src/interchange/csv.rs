//! A clip as a table: time, acceleration, and the part that the row belongs to.

use super::clip::Clip;
use std::fmt::Write as _;

/// Writes a clip; accelerations are floats that read back to the same bits.
pub(super) fn write(clip: &Clip) -> Vec<u8> {
    let mut text = "t_s,accel_m_s2,part\n".to_owned();
    let rate = f64::from(clip.rate_hz.max(1));
    for take in clip.strokes.iter().chain(&clip.taps) {
        for (n, x) in take.signal_m_s2.iter().enumerate() {
            let t_s = take.start_s + n as f64 / rate;
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{:.6},{},{}", t_s, *x as f32, take.label);
        }
    }
    text.into_bytes()
}
