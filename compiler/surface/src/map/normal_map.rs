//! Normal maps: the slopes that their colours say, integrated to heights.

use super::Raster;
use crate::{heights::HeightField, plane::Plane};
use rustfft::num_complex::Complex;
use std::{f64::consts::TAU, str::FromStr};

/// Least part of a normal that points out of the surface: steeper slopes are taken as this steep.
const LEAST_OUTWARDS: f32 = 0.1;
/// Curl of the other convention over that of the better one from which the map decides.
const CLEAR: f64 = 1.5;

/// The direction of green.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convention {
    /// Green points up, as OpenGL has it.
    Gl,
    /// Green points down, as DirectX has it.
    Dx,
}

impl FromStr for Convention {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "gl" => Ok(Self::Gl),
            "dx" => Ok(Self::Dx),
            _ => Err("`gl` or `dx`".into()),
        }
    }
}

impl Convention {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gl => "gl",
            Self::Dx => "dx",
        }
    }
}

/// Returns true if most pixels are directions of length 1 that point out of the surface.
pub(super) fn is_normal_map(raster: &Raster) -> bool {
    let unit = |pixel: &[f32]| {
        let square: f32 = pixel.iter().map(|c| (2.0 * c - 1.0).powi(2)).sum();
        pixel[2] > 0.5 && (0.8..1.2).contains(&square)
    };
    let pixels = raster.samples.chunks_exact(3);
    let units = pixels.clone().filter(|pixel| unit(pixel)).count();
    raster.channels == 3 && 10 * units > 9 * pixels.len()
}

/// Transforms of the slopes in x and down the rows, by red and by green as DirectX has it.
fn slopes(raster: &Raster) -> [Plane; 2] {
    [0, 1].map(|channel| {
        let slope = |pixel: &[f32]| {
            let outwards = (2.0 * pixel[2] - 1.0).max(LEAST_OUTWARDS);
            f64::from(-(2.0 * pixel[channel] - 1.0) / outwards)
        };
        let mut slopes: Vec<f64> = raster.samples.chunks_exact(3).map(slope).collect();
        let mean = slopes.iter().sum::<f64>() / slopes.len() as f64;
        slopes.iter_mut().for_each(|slope| *slope -= mean);
        Plane::of(raster.width, &mut slopes)
    })
}

/// The heights of a normal map on the points of `field`, µm, the convention that was taken, and that which the slopes show,
/// if they do: those of a surface have no curl (Frankot and Chellappa, 1988).
pub(super) fn heights(
    raster: &Raster,
    field: &HeightField,
    stated: Option<Convention>,
) -> (HeightField, Convention, Option<Convention>) {
    let [mut in_x, mut in_y] = slopes(raster);
    let per_mm = field.step_per_mm();
    let wave_vector = |[x, y]: [f64; 2]| [x * per_mm[0], y * per_mm[1]];
    let (mut dx_curl, mut gl_curl) = (0.0, 0.0);
    for ((periods, halves, a), (_, _, b)) in in_x.waves_mut().zip(in_y.waves_mut()) {
        let [x, y] = wave_vector(periods);
        let weight = halves / (x * x + y * y).max(f64::MIN_POSITIVE);
        dx_curl += weight * (*a * y - *b * x).norm_sqr();
        gl_curl += weight * (*a * y + *b * x).norm_sqr();
    }
    let found = if dx_curl * CLEAR < gl_curl {
        Convention::Dx
    } else {
        Convention::Gl
    };
    let is_clear = dx_curl.max(gl_curl) > CLEAR * dx_curl.min(gl_curl);
    let convention = stated.unwrap_or(found);
    let down = match convention {
        Convention::Dx => 1.0,
        Convention::Gl => -1.0,
    };
    for ((periods, _, a), (_, _, b)) in in_x.waves_mut().zip(in_y.waves_mut()) {
        let [x, y] = wave_vector(periods);
        let square = x * x + y * y;
        *a = if square > 0.0 {
            // Slopes are those of mm over mm, heights in µm.
            (*a * x + *b * (down * y)) * Complex::new(0.0, -1e3 / (TAU * square))
        } else {
            Complex::default()
        };
    }
    let heights = in_x.inverse().into_iter().map(|h| h as f32).collect();
    (
        field.with_heights(heights),
        convention,
        is_clear.then_some(found),
    )
}
