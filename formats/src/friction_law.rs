//! The law of friction over speed, a part of FRIC in version 2: factors of μ.

use crate::{
    error::FormatError,
    limits,
    wire::{Reader, u16_at},
};

/// Codes of a millimetre per second.
const PER_MM_S: f32 = 16.0;
/// Codes of a factor of 1.
const PER_ONE: f32 = 8192.0;
/// Bytes of a point.
const POINT_LEN: usize = 4;

/// Dependence of μ on speed: piecewise linear between points, constant below the first and above
/// the last. Friction at a speed is μ times the interpolated factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionLaw<'a> {
    points: &'a [u8],
}

/// A point of a law, as it is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct LawPoint {
    /// Speed, 1/16 mm/s.
    pub speed_code: u16,
    /// Factor of μ, 1/8192.
    pub factor_code: u16,
}

impl LawPoint {
    /// The point nearest to a speed, mm/s, 0 to 4095.9, and a factor, 0 to 7.9999. `None` outside
    /// these ranges and for values that are not finite.
    #[must_use]
    pub fn nearest(speed_mm_s: f64, factor: f64) -> Option<Self> {
        let code = |value: f64, scale: f32| {
            let rounded = value * f64::from(scale) + 0.5;
            // A cast truncates.
            (value >= 0.0 && rounded < 65536.0).then_some(rounded as u16)
        };
        Some(Self {
            speed_code: code(speed_mm_s, PER_MM_S)?,
            factor_code: code(factor, PER_ONE)?,
        })
    }

    /// Tangential speed, mm/s, exact in f32.
    #[must_use]
    pub fn speed_mm_s(self) -> f32 {
        f32::from(self.speed_code) / PER_MM_S
    }

    /// Factor of μ, exact in f32.
    #[must_use]
    pub fn factor(self) -> f32 {
        f32::from(self.factor_code) / PER_ONE
    }
}

impl<'a> FrictionLaw<'a> {
    /// Reads a law; `mu` is the μ that its factors multiply.
    #[inline(never)]
    pub(crate) fn parse(reader: &mut Reader<'a>, mu: f32) -> Result<Self, FormatError> {
        let count = usize::from(reader.u8("friction.law.count")?);
        if !(limits::MIN_LAW_POINTS..=limits::MAX_LAW_POINTS).contains(&count) {
            return Err(FormatError::invalid(
                "friction.law.count",
                0,
                count as f64,
                "2 to 8",
            ));
        }
        let law = Self {
            points: reader.bytes("friction.law.points", POINT_LEN * count)?,
        };
        let mut last = None;
        for (index, point) in law.points().enumerate() {
            if last >= Some(point.speed_code) {
                return Err(FormatError::invalid(
                    "friction.law.speed_mm_s",
                    index,
                    f64::from(point.speed_mm_s()),
                    "speeds must ascend",
                ));
            }
            last = Some(point.speed_code);
            if mu * point.factor() > limits::MAX_MU {
                return Err(FormatError::invalid(
                    "friction.law.factor",
                    index,
                    f64::from(point.factor()),
                    "μ times the factor must be 10 at most",
                ));
            }
        }
        Ok(law)
    }

    /// The points, 2 to 8, in ascending order of speed.
    pub fn points(&self) -> impl ExactSizeIterator<Item = LawPoint> + use<'a> {
        self.points.chunks_exact(POINT_LEN).map(|point| LawPoint {
            speed_code: u16_at(point, 0),
            factor_code: u16_at(point, 2),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_within_half_a_step_and_the_ends_are_refused() {
        for step in 0..4000 {
            let (speed, factor) = (f64::from(step) * 1.0237, f64::from(step) * 0.001_999);
            let point = LawPoint::nearest(speed, factor).unwrap();
            assert!((f64::from(point.speed_mm_s()) - speed).abs() <= 0.5 / 16.0);
            assert!((f64::from(point.factor()) - factor).abs() <= 0.5 / 8192.0);
        }
        let largest = LawPoint::nearest(4_095.968_749, 7.999_938).unwrap();
        assert_eq!((largest.speed_code, largest.factor_code), (65535, 65535));
        for (speed, factor) in [
            (-0.01, 1.0),
            // Half a step above the largest, to the bit.
            (4_095.968_75, 1.0),
            (4096.0, 1.0),
            (f64::NAN, 1.0),
            (f64::INFINITY, 1.0),
            (1.0, -1e-9),
            (1.0, 8.0),
            (1.0, f64::NAN),
        ] {
            assert_eq!(LawPoint::nearest(speed, factor), None, "{speed} {factor}");
        }
    }
}
