//! The force that a calibration plays: a sweep with equal energy in every band, within bounds.

use core::f64::consts::TAU;

/// A logarithmic sweep up and down, faded in and out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sweep {
    /// Servo rate, Hz.
    pub rate_hz: f64,
    /// Lowest frequency, Hz.
    pub from_hz: f64,
    /// Highest frequency, Hz, below half the rate.
    pub to_hz: f64,
    /// Amplitude, N.
    pub amplitude_n: f64,
    /// Duration, s.
    pub seconds: f64,
}

impl Sweep {
    /// A sweep over what a hand feels, at a rate.
    #[must_use]
    pub fn standard(rate_hz: f64, amplitude_n: f64) -> Self {
        Self {
            rate_hz,
            from_hz: 20.0,
            to_hz: 0.48 * rate_hz,
            amplitude_n,
            seconds: 20.0,
        }
    }

    /// The force of every period, N. No force exceeds the amplitude, and the first and last are 0.
    #[must_use]
    pub fn force_n(&self) -> Vec<f64> {
        let count = (self.seconds * self.rate_hz) as usize;
        let octaves = libm::log2(self.to_hz / self.from_hz);
        let mut phase = 0.0;
        (0..count)
            .map(|n| {
                let part = n as f64 / count as f64;
                // Up in the first half, down in the second.
                let height = 1.0 - libm::fabs(2.0 * part - 1.0);
                let fade = (part.min(1.0 - part) * 40.0).min(1.0);
                let force_n = self.amplitude_n * fade * libm::sin(phase);
                phase = (phase + TAU * self.from_hz * libm::exp2(octaves * height) / self.rate_hz)
                    % TAU;
                force_n
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_stays_within_its_bounds() {
        let sweep = Sweep::standard(1000.0, 0.3);
        let force = sweep.force_n();
        assert_eq!(force.len(), 20_000);
        assert!(force.iter().all(|x| x.abs() <= 0.3));
        assert!(force[0] == 0.0 && force[19_999].abs() < 0.01);
        let energy: f64 = force.iter().map(|x| x * x).sum::<f64>() / 20_000.0;
        assert!((energy - 0.045).abs() < 0.005, "{energy}");
    }
}
