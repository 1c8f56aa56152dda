//! The power of heights by wave vector.

use crate::{heights::HeightField, plane::Plane};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Power of heights by wave vector, half of the plane.
#[derive(Debug, Clone)]
pub struct WaveSpectrum {
    /// Step of the wave vector in x and in y, 1/mm.
    step_per_mm: [f64; 2],
    columns: usize,
    /// µm² a wave vector, rows of y from 0 up and then from the most negative.
    power_um2: Vec<f32>,
    nyquist_per_mm: f64,
}

/// Power of heights along a direction.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSpectrum {
    /// Step of the spatial frequency, 1/mm.
    pub step_per_mm: f64,
    /// µm² a step, from 0.
    pub power_um2: Vec<f64>,
}

impl WaveSpectrum {
    /// The spectrum of a field under a Hann window; its sum is the variance.
    #[must_use]
    pub fn of(field: &HeightField) -> Self {
        let (width, height) = (field.width(), field.height());
        let [in_x, in_y] = [width, height].map(hann);
        let square = |window: &[f64]| window.iter().map(|w| w * w).sum::<f64>();
        let scale = 1.0 / (square(&in_x) * square(&in_y) * (width * height) as f64);
        let rows = field.heights_um().chunks_exact(width).zip(&in_y);
        let mut windowed: Vec<f64> = rows
            .flat_map(|(row, y)| {
                row.iter()
                    .zip(&in_x)
                    .map(move |(h, x)| f64::from(*h) * x * y)
            })
            .collect();
        let mut plane = Plane::of(width, &mut windowed);
        let waves = plane.waves_mut();
        let power_um2 = waves.map(|(_, halves, wave)| (scale * halves * wave.norm_sqr()) as f32);
        let power_um2 = power_um2.collect();
        let pitch = field.pitch_mm();
        Self {
            step_per_mm: field.step_per_mm(),
            columns: width / 2 + 1,
            power_um2,
            nyquist_per_mm: 0.5 / pitch[0].max(pitch[1]),
        }
    }

    /// Highest spatial frequency that the field has in every direction, 1/mm.
    #[must_use]
    pub const fn nyquist_per_mm(&self) -> f64 {
        self.nyquist_per_mm
    }

    /// Every wave vector with its power.
    fn waves(&self) -> impl Iterator<Item = ([f64; 2], f64)> + '_ {
        let rows = self.power_um2.len() / self.columns;
        let rows_of = self.power_um2.chunks_exact(self.columns).enumerate();
        rows_of.flat_map(move |(y, row)| {
            let y = if 2 * y > rows {
                y as f64 - rows as f64
            } else {
                y as f64
            };
            // Rows run down the surface, y up.
            let k_y = -y * self.step_per_mm[1];
            row.iter().enumerate().map(move |(x, power)| {
                let k_x = x as f64 * self.step_per_mm[0];
                ([k_x, k_y], f64::from(*power))
            })
        })
    }

    /// The direction across which strokes vibrate most, rad from x to y, −π/2 to π/2: of the second moments of the power times
    /// k⁴, as accelerations have them at any one speed.
    #[must_use]
    pub fn across_rad(&self) -> f64 {
        let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
        for ([x, y], power) in self.waves() {
            let weight = power * (x * x + y * y);
            xx += weight * x * x;
            yy += weight * y * y;
            xy += weight * x * y;
        }
        let angle = 0.5 * libm::atan2(2.0 * xy, xx - yy);
        angle.clamp(-FRAC_PI_2, FRAC_PI_2)
    }

    /// The spectrum that a stroke in a direction, rad from x to y, meets.
    #[must_use]
    pub fn along(&self, direction_rad: f64) -> LineSpectrum {
        let (sin, cos) = (libm::sin(direction_rad), libm::cos(direction_rad));
        let step_per_mm = self.step_per_mm[0].min(self.step_per_mm[1]);
        let steps = (self.nyquist_per_mm / step_per_mm) as usize;
        let mut power_um2 = vec![0.0; steps + 1];
        for ([x, y], power) in self.waves() {
            let at = (cos * x + sin * y).abs() / step_per_mm;
            let (below, above) = (at as usize, at as usize + 1);
            if above > steps {
                continue;
            }
            let share = at - below as f64;
            power_um2[below] += (1.0 - share) * power;
            power_um2[above] += share * power;
        }
        LineSpectrum {
            step_per_mm,
            power_um2,
        }
    }
}

impl LineSpectrum {
    /// The mean of two spectra of the same field.
    #[must_use]
    pub fn mean(&self, other: &Self) -> Self {
        let pairs = self.power_um2.iter().zip(&other.power_um2);
        Self {
            step_per_mm: self.step_per_mm,
            power_um2: pairs.map(|(a, b)| 0.5 * (a + b)).collect(),
        }
    }
}

fn hann(count: usize) -> Vec<f64> {
    let phase = |n: usize| TAU * (n as f64 + 0.5) / count as f64;
    (0..count)
        .map(|n| 0.5 - 0.5 * libm::cos(phase(n)))
        .collect()
}
