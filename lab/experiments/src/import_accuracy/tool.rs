//! A tool that is no rigid body: its resonance with the accelerometer, and taps on it in free air.

use asperity_recording::signal::resample::Clock;
use realfft::{RealFftPlanner, num_complex::Complex};
use std::str::FromStr;

/// Taps in free air: when the first one is, and the time to the next, s. A script begins with more than a
/// second in the air.
const FIRST_S: f64 = 0.3;
const NEXT_S: f64 = 0.2;
/// Most of them.
pub const MOST_FREE_TAPS: usize = 4;
/// A finger's pulse: half a sine, s and m/s², obliquely to the tool.
const PULSE_S: f64 = 0.0015;
const PULSE_M_S2: f64 = 30.0;
const DIRECTION: [f64; 3] = [0.48, 0.36, 0.8];
/// Time for which the signal is held before and after, so that a resonance has no edge, s.
const HELD_S: f64 = 1.0;

/// A mass on a spring between tip and accelerometer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonance {
    /// ω0/2π, Hz.
    pub freq_hz: f64,
    /// Quality.
    pub q: f64,
}

impl Resonance {
    /// Returns the accelerometer's response to the acceleration of the tip, by
    /// H = ω0²/(s² + ω0 s/Q + ω0²) at the frequencies of the whole signal.
    pub(super) fn felt(self, signal: &[f64], rate_hz: f64) -> Vec<f64> {
        let (Some(&first), Some(&last)) = (signal.first(), signal.last()) else {
            return Vec::new();
        };
        let held = (HELD_S * rate_hz) as usize;
        let mut whole = vec![first; held];
        whole.extend_from_slice(signal);
        // From the last value back to the first one, as the transform is periodic.
        whole.extend((0..held).map(|n| {
            let share = 0.5 - 0.5 * libm::cos(std::f64::consts::PI * n as f64 / held as f64);
            last + share * (first - last)
        }));
        let mut planner = RealFftPlanner::<f64>::new();
        let forward = planner.plan_fft_forward(whole.len());
        let inverse = planner.plan_fft_inverse(whole.len());
        let mut spectrum = forward.make_output_vec();
        let scale = 1.0 / whole.len() as f64;
        let step_hz = rate_hz * scale;
        forward
            .process(&mut whole, &mut spectrum)
            .expect("lengths of the plan");
        for (bin, x) in spectrum.iter_mut().enumerate() {
            let ratio = bin as f64 * step_hz / self.freq_hz;
            *x *= Complex::new(scale, 0.0) / Complex::new(1.0 - ratio * ratio, ratio / self.q);
        }
        spectrum[0].im = 0.0;
        if let (0, Some(end)) = (whole.len() % 2, spectrum.last_mut()) {
            end.im = 0.0;
        }
        inverse
            .process(&mut spectrum, &mut whole)
            .expect("lengths of the plan");
        whole[held..held + signal.len()].to_vec()
    }
}

impl FromStr for Resonance {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Vec<f64> = text
            .split(',')
            .filter_map(|part| part.trim().parse().ok())
            .collect();
        match numbers[..] {
            [freq_hz, q] if (20.0..=2000.0).contains(&freq_hz) && (0.5..=200.0).contains(&q) => {
                Ok(Self { freq_hz, q })
            }
            _ => Err("must be 20 to 2000 Hz and a Q of 0.5 to 200, such as 300,8".into()),
        }
    }
}

/// Taps the tool with a finger while it is in the air.
pub(super) fn add_free_taps(accel: &mut [Vec<f64>; 3], clock: Clock, count: usize) {
    for tap in 0..count.min(MOST_FREE_TAPS) {
        let begin_s = FIRST_S + NEXT_S * tap as f64;
        let first = clock.sample(begin_s).ceil() as usize;
        for n in first..first + (PULSE_S * clock.rate_hz) as usize {
            let phase = std::f64::consts::PI * (clock.time_s(n as f64) - begin_s) / PULSE_S;
            let pulse = PULSE_M_S2 * libm::sin(phase).max(0.0);
            for (axis, part) in accel.iter_mut().zip(DIRECTION) {
                if let Some(a) = axis.get_mut(n) {
                    *a += part * pulse;
                }
            }
        }
    }
}
