//! Scripted motions over the plane z = 0: everyday use and extreme cases.

use asperity_runtime::Sample;

/// A motion as a pure function of the tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// 5 mm above the surface.
    Hover,
    /// At rest in contact.
    Rest,
    /// A stroke inside the grid.
    Stroke,
    /// A stroke faster and harder than the grid.
    Beyond,
    /// Back and forth at 2 Hz.
    Scrub,
    /// A tap every 100 ms.
    Taps,
    /// Every sample is NaN.
    NotANumber,
    /// Every third sample is stale.
    Stale,
}

impl Motion {
    /// Every motion with its name.
    pub const ALL: [(Self, &'static str); 8] = [
        (Self::Hover, "hover"),
        (Self::Rest, "rest"),
        (Self::Stroke, "stroke"),
        (Self::Beyond, "beyond"),
        (Self::Scrub, "scrub"),
        (Self::Taps, "taps"),
        (Self::NotANumber, "nan"),
        (Self::Stale, "stale"),
    ];

    /// The device sample of a tick at 1 kHz.
    #[must_use]
    pub fn sample(self, tick: u32) -> Sample {
        self.sample_at(tick, 1)
    }

    /// The device sample of a tick at `ratio` kHz.
    #[must_use]
    pub fn sample_at(self, tick: u32, ratio: u32) -> Sample {
        let t_s = (tick % 60_000) as f32 * (1e-3 / ratio as f32);
        let stroke = |speed_m_s: f32, depth_m: f32| {
            // A circle keeps a constant speed inside the workspace.
            let angle = speed_m_s / 0.05 * t_s;
            Sample::at([0.05 * angle.cos(), 0.05 * angle.sin(), -depth_m])
        };
        match self {
            Self::Hover => Sample::at([0.0, 0.0, 5e-3]),
            Self::Rest => Sample::at([0.0, 0.0, -2e-3]),
            Self::Stroke => stroke(0.12, 2.4e-3),
            Self::Beyond => stroke(0.6, 12e-3),
            Self::Scrub => Sample::at([0.03 * (12.566 * t_s).sin(), 0.0, -3e-3]),
            Self::Taps => Sample::at([0.0, 0.0, 4e-3 * (62.83 * t_s).cos() + 2e-3]),
            Self::NotANumber => Sample::at([f32::NAN; 3]),
            Self::Stale if tick.is_multiple_of(3) => Sample::STALE,
            Self::Stale => stroke(0.12, 2.4e-3),
        }
    }
}
