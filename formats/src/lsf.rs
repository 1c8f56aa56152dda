//! Line spectral frequencies as sixteen-bit fractions of π.

use core::f64::consts::PI;

/// Codes of half a turn.
const HALF_TURN: f64 = 65536.0;

/// A line spectral frequency ω = π · code / 65536, with 0 < ω < π.
///
/// One step is 4.8e-5 rad, 7.6 mHz at a sample rate of 1 kHz.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct LsfCode(u16);

impl LsfCode {
    /// The code nearest to `omega_rad`, at least one step inside (0, π); `None`
    /// for a value that is not finite or not in [0, π].
    #[must_use]
    pub fn from_rad(omega_rad: f64) -> Option<Self> {
        if !(0.0..=PI).contains(&omega_rad) {
            return None;
        }
        // A cast truncates and saturates; the value is not negative.
        let nearest = (omega_rad / PI * HALF_TURN + 0.5) as u16;
        Some(Self(nearest.max(1)))
    }

    /// ω in rad.
    #[must_use]
    pub fn to_rad(self) -> f64 {
        f64::from(self.0) / HALF_TURN * PI
    }

    /// The stored bits, 1..=65535 in a valid asset.
    #[must_use]
    pub const fn to_bits(self) -> u16 {
        self.0
    }

    /// The frequency of stored bits.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    /// ω / π, exact in f32.
    #[must_use]
    pub fn half_turns(self) -> f32 {
        f32::from(self.0) / HALF_TURN as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_is_within_half_a_step_of_its_angle() {
        for step in 1..10_000 {
            let omega_rad = f64::from(step) / 10_000.0 * PI;
            let code = LsfCode::from_rad(omega_rad).unwrap();
            assert!(
                (code.to_rad() - omega_rad).abs()
                    <= PI / 65536.0 * 0.500_001 + PI / 65536.0 * f64::from(step == 9_999)
            );
        }
    }

    #[test]
    fn the_ends_stay_inside() {
        assert_eq!(LsfCode::from_rad(0.0).unwrap().to_bits(), 1);
        assert_eq!(LsfCode::from_rad(PI).unwrap().to_bits(), 65535);
        assert_eq!(LsfCode::from_rad(f64::NAN), None);
        assert_eq!(LsfCode::from_rad(-0.1), None);
        assert_eq!(LsfCode::from_rad(f64::INFINITY), None);
    }
}
