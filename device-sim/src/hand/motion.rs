//! Motions of a simulated hand.

use std::fmt;

/// A motion of a script. The surface is the plane z = 0, normal +z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// Move through the air to hover over a point.
    Approach {
        /// Target position, m.
        to_m: [f64; 3],
        /// Duration, s.
        duration_s: f64,
    },
    /// Strike the surface and come back up.
    Tap {
        /// Speed at which the surface is met, m/s.
        speed_m_s: f64,
    },
    /// Raise the normal force to a peak and lower it again, without moving.
    Press {
        /// Largest normal force, N.
        force_n: f64,
        /// Duration, s.
        duration_s: f64,
    },
    /// Slide in a straight line at constant speed.
    Stroke {
        /// Target position in the plane, m.
        to_m: [f64; 2],
        /// Speed between the ramps, m/s.
        speed_m_s: f64,
        /// Normal force, N.
        force_n: f64,
    },
    /// Slide back and forth along x, sinusoidally.
    Scrub {
        /// Half the stroke, m.
        amplitude_m: f64,
        /// Cycles a second, Hz.
        frequency_hz: f64,
        /// Number of cycles.
        cycles: f64,
        /// Normal force, N.
        force_n: f64,
    },
    /// Slide along an arc with a minimum-jerk profile, from rest to rest, while the force changes.
    Sweep {
        /// Target position in the plane, m.
        to_m: [f64; 2],
        /// Sagitta of the arc, positive to the left of the chord, m.
        bow_m: f64,
        /// Duration, s.
        duration_s: f64,
        /// Normal force at its end, N; it begins with the force of the motion before.
        force_n: f64,
    },
    /// Slide in ellipses, from rest to rest, while the force changes.
    Loop {
        /// Radius along x, where the centre lies, m.
        radius_m: f64,
        /// Radius along y over that along x.
        aspect: f64,
        /// Number of revolutions.
        turns: f64,
        /// Duration, s.
        duration_s: f64,
        /// Normal force at its end, N; it begins with the force of the motion before.
        force_n: f64,
    },
    /// Rest on the surface.
    Rest {
        /// Normal force, N.
        force_n: f64,
        /// Duration, s.
        duration_s: f64,
    },
    /// Leave the surface.
    Lift {
        /// Final height, m.
        height_m: f64,
        /// Duration, s.
        duration_s: f64,
    },
}

impl Motion {
    /// The motion's name.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Approach { .. } => "approach",
            Self::Tap { .. } => "tap",
            Self::Press { .. } => "press",
            Self::Stroke { .. } => "stroke",
            Self::Scrub { .. } => "scrub",
            Self::Sweep { .. } => "sweep",
            Self::Loop { .. } => "loop",
            Self::Rest { .. } => "rest",
            Self::Lift { .. } => "lift",
        }
    }
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        match *self {
            Self::Approach { .. } | Self::Lift { .. } => Ok(()),
            Self::Tap { speed_m_s } => write!(f, " {:.0} mm/s", speed_m_s * 1e3),
            Self::Press { force_n, .. }
            | Self::Sweep { force_n, .. }
            | Self::Loop { force_n, .. }
            | Self::Rest { force_n, .. } => {
                write!(f, " {force_n:.1} N")
            }
            Self::Stroke {
                speed_m_s, force_n, ..
            } => {
                write!(f, " {:.0} mm/s {force_n:.1} N", speed_m_s * 1e3)
            }
            Self::Scrub {
                frequency_hz,
                force_n,
                ..
            } => {
                write!(f, " {frequency_hz:.1} Hz {force_n:.1} N")
            }
        }
    }
}
