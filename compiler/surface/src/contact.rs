//! A tip on a surface: its contact averages heights, and it rolls over the crests of what is left.

use crate::{heights::HeightField, plane::Plane, stylus::Support, wave_spectrum::WaveSpectrum};
use std::{f64::consts::TAU, str::FromStr};

/// Contact of a real tip over Hertz's: with it, measured profiles vibrate in the median within 2 dB as strongly as measured
/// strokes over materials of their names do (`training/corpus/tests/measured.rs`).
const CONTACT_FACTOR: f64 = 2.0;
/// Depth that a tip sinks below the height at which it would roll, as a part of its indentation. Found with the simulation of
/// `device-sim/tests/dragged_tip.rs`, which an eighth to a half fit alike.
const SINKS: f64 = 0.25;

/// A round tip: `stylus`, `fingertip` or `needle` as a text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// Its radius, mm.
    pub radius_mm: f64,
    /// Its own indentation modulus, MPa, in series with the surface's.
    pub modulus_mpa: f64,
}

impl Tip {
    /// A steel ball of 3.2 mm, as the strokes that the stylus is calibrated on were made with.
    pub const STYLUS: Self = Self {
        radius_mm: 1.6,
        modulus_mpa: f64::INFINITY,
    };
    /// A fingertip; nobody has confirmed it.
    pub const FINGERTIP: Self = Self {
        radius_mm: 6.0,
        modulus_mpa: 0.2,
    };
    /// A steel needle; nobody has confirmed it.
    pub const NEEDLE: Self = Self {
        radius_mm: 0.1,
        ..Self::STYLUS
    };

    /// Radius of the contact on a flat surface, mm: Hertz's, ∛(3FR/4E), times a factor.
    #[must_use]
    pub fn contact_mm(&self, support: &Support) -> f64 {
        let modulus_mpa = 1.0 / (1.0 / support.modulus_mpa + 1.0 / self.modulus_mpa);
        CONTACT_FACTOR * libm::cbrt(0.75 * support.force_n * self.radius_mm / modulus_mpa)
    }

    /// The heights at which the tip rolls over a field without sinking in: its dilation by the paraboloid r²/2R, which is the
    /// ball where the surface is less steep than about 30°.
    fn rolling(&self, field: &HeightField) -> Vec<f32> {
        let heights = field.heights_um();
        let (low, high) = field.ends_um();
        let sags = field
            .pitch_mm()
            .map(|pitch_mm| self.sags_um(pitch_mm, high - low));
        let width = field.width();
        let mut in_rows = heights.to_vec();
        for (out, row) in (in_rows.chunks_exact_mut(width)).zip(heights.chunks_exact(width)) {
            for (by, sag) in sags[0].iter().enumerate().take(width - 1) {
                raise(&mut out[by + 1..], row, *sag);
                raise(out, &row[by + 1..], *sag);
            }
        }
        let mut rolling = in_rows.clone();
        for (by, sag) in sags[1].iter().enumerate().take(field.height() - 1) {
            let offset = (by + 1) * width;
            raise(&mut rolling[offset..], &in_rows, *sag);
            raise(&mut rolling, &in_rows[offset..], *sag);
        }
        rolling
    }

    /// Heights of the tip above its lowest point at 1, 2, … points from it, as far as a relief of this range can touch it.
    fn sags_um(&self, pitch_mm: f64, range_um: f32) -> Vec<f32> {
        let sag =
            |n: i32| (1e3 * (f64::from(n) * pitch_mm).powi(2) / (2.0 * self.radius_mm)) as f32;
        (1..).map(sag).take_while(|sag| *sag < range_um).collect()
    }
}

impl FromStr for Tip {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "stylus" => Ok(Self::STYLUS),
            "fingertip" => Ok(Self::FINGERTIP),
            "needle" => Ok(Self::NEEDLE),
            _ => Err("`stylus`, `fingertip` or `needle`".into()),
        }
    }
}

fn raise(heights: &mut [f32], by: &[f32], sag: f32) {
    for (height, other) in heights.iter_mut().zip(by) {
        *height = height.max(other - sag);
    }
}

/// A field that tips are stroked over.
pub struct Contact {
    field: HeightField,
    plane: Plane,
}

impl Contact {
    /// A contact with a levelled field.
    #[must_use]
    pub fn with(field: &HeightField) -> Self {
        Self {
            plane: field.plane(),
            field: field.clone(),
        }
    }

    /// Number of the points of the field.
    #[must_use]
    pub fn points(&self) -> f64 {
        self.field.heights_um().len() as f64
    }

    /// Power of the heights themselves.
    #[must_use]
    pub fn bare(&self) -> WaveSpectrum {
        WaveSpectrum::of(&self.field)
    }

    /// The heights that a tip follows: the field, averaged over the contact, and raised to where the tip touches two flanks at
    /// once, less what it sinks in.
    #[must_use]
    pub fn followed(&self, tip: &Tip, support: &Support) -> HeightField {
        let contact_mm = tip.contact_mm(support);
        let mut plane = self.plane.clone();
        let per_mm = self.field.step_per_mm();
        for ([x, y], _, wave) in plane.waves_mut() {
            let k_per_mm = libm::hypot(x * per_mm[0], y * per_mm[1]);
            *wave *= disc_power(k_per_mm, contact_mm).sqrt();
        }
        let averaged = self.field.of_plane(plane);
        let indentation_um = 1e3 * contact_mm * contact_mm / (2.0 * tip.radius_mm);
        let sunk_um = (SINKS * indentation_um) as f32;
        let mut followed = tip.rolling(&averaged);
        for (height, bare) in followed.iter_mut().zip(averaged.heights_um()) {
            *height = bare.max(*height - sunk_um);
        }
        self.field.with_heights(followed)
    }
}

/// Returns the power transmission of an average over a disc of a radius, mm, on heights of a spatial frequency, 1/mm:
/// `(1 + x²/2 + 0.62 x⁶)^(−1/2)` with x = 2πkr has both ends of `(2J₁(x)/x)²` without its zeros, which no real contact has.
#[must_use]
pub fn disc_power(k_per_mm: f64, radius_mm: f64) -> f64 {
    let x = TAU * k_per_mm * radius_mm;
    let square = x * x;
    1.0 / (1.0 + 0.5 * square + 0.62 * square * square * square).sqrt()
}
