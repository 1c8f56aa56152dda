//! The phases of the session over the plane z = 0, at 1 kHz.

use asperity_runtime::Sample;

/// Ticks of each phase.
pub const PHASE_TICKS: u32 = 1000;

/// Behaviour of the stylus, or of the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// 5 mm above the surface.
    Hover,
    /// A tap every 100 ms.
    Taps,
    /// At rest, 2 mm deep.
    Rest,
    /// 120 mm/s, 2.4 mm deep.
    Stroke,
    /// From rest to 300 mm/s while the depth goes up and down: across the whole grid.
    Sweep,
    /// Faster and harder than the grid.
    Beyond,
    /// Back and forth at 2 Hz.
    Scrub,
    /// Runs of NaN, infinities and positions out of reach within a stroke.
    NotFinite,
    /// Every third sample stale, then runs of five.
    Stale,
    /// Periods missed, 1 to 7 in a row.
    Missed,
    /// Every sample is NaN.
    Lost,
    /// A stroke after the loss: restart and ramp.
    Recovery,
}

impl Phase {
    /// Every phase, in the order of the session.
    pub const ALL: [Self; 12] = [
        Self::Hover,
        Self::Taps,
        Self::Rest,
        Self::Stroke,
        Self::Sweep,
        Self::Beyond,
        Self::Scrub,
        Self::NotFinite,
        Self::Stale,
        Self::Missed,
        Self::Lost,
        Self::Recovery,
    ];

    /// The phase in a word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hover => "hover",
            Self::Taps => "taps",
            Self::Rest => "rest",
            Self::Stroke => "stroke",
            Self::Sweep => "sweep",
            Self::Beyond => "beyond",
            Self::Scrub => "scrub",
            Self::NotFinite => "not-finite",
            Self::Stale => "stale",
            Self::Missed => "missed",
            Self::Lost => "lost",
            Self::Recovery => "recovery",
        }
    }

    /// The device sample of the phase's tick `n`.
    #[must_use]
    pub fn sample(self, n: u32) -> Sample {
        match self {
            Self::Hover => Sample::at([0.0, 0.0, 5e-3]),
            Self::Taps => Sample::at([0.0, 0.0, 2e-3 + 4e-3 * wave(n, 100)]),
            Self::Rest => Sample::at([0.0, 0.0, -2e-3]),
            Self::Stroke | Self::Recovery => stroke(n, 0.12e-3, 2.4e-3),
            Self::Sweep => {
                let n_f = n as f32;
                // Constant acceleration from 0 to 300 mm/s.
                let x = 0.15e-6 * n_f * n_f;
                Sample::at([x, 0.0, -4.0e-3 - 3.9e-3 * wave(n, 130)])
            }
            Self::Beyond => stroke(n, 0.6e-3, 12e-3),
            Self::Scrub => Sample::at([0.03 * wave(n, 500), 1e-3 * wave(n, 170), -3e-3]),
            Self::NotFinite if n % 50 < n / 50 % 6 => bad(n),
            Self::Stale if n < 500 && n.is_multiple_of(3) => Sample::STALE,
            Self::Stale if n >= 500 && n % 40 < 5 => Sample::STALE,
            Self::Missed if n.is_multiple_of(29) => Sample {
                elapsed_ticks: 2 + n / 29 % 7,
                ..stroke(n, 0.12e-3, 2.4e-3)
            },
            Self::NotFinite | Self::Stale | Self::Missed => stroke(n, 0.12e-3, 2.4e-3),
            Self::Lost => Sample::at([f32::NAN; 3]),
        }
    }
}

/// A straight stroke: metres a tick, depth in metres.
fn stroke(n: u32, step_m: f32, depth_m: f32) -> Sample {
    let along = step_m * n as f32;
    Sample::at([0.8 * along, -0.6 * along, -depth_m])
}

fn bad(n: u32) -> Sample {
    let (value, axis) = match n % 4 {
        0 => (f32::NAN, 0),
        1 => (f32::INFINITY, 1),
        2 => (f32::NEG_INFINITY, 2),
        _ => (1e30, 0),
    };
    let mut sample = stroke(n, 0.12e-3, 2.4e-3);
    sample.position_m[axis] = value;
    sample
}

/// A sine drawn with two parabolas, period in ticks, from −1 to 1.
fn wave(n: u32, period: u32) -> f32 {
    let u = (n % period) as f32 / period as f32;
    if u < 0.5 {
        16.0 * u * (0.5 - u)
    } else {
        -16.0 * (u - 0.5) * (1.0 - u)
    }
}
