//! Grey pictures of heights, and what their numbers tell.

use super::Raster;
use crate::heights::{HeightField, ends};
use asperity_io::diagnostic::Fault;

/// Differences of red, green and blue up to this are grey, as parts of the range.
const GREY: f32 = 1.5 / 255.0;
/// Different numbers up to which a map counts as stored in steps.
const FEW: usize = 256;
/// Numbers that are looked at for outliers, and how many times their range an outlier is away.
const SAMPLED: usize = 20_000;
const FAR: f32 = 100.0;
const FILL: &str = "fill the holes of the scan, as its software can";

/// The grey of every pixel, if all are grey.
pub(super) fn grey(raster: &Raster) -> Result<Vec<f32>, Fault> {
    finite(raster)?;
    if raster.channels == 1 {
        return Ok(raster.samples.clone());
    }
    let pixels = || raster.samples.chunks_exact(3);
    if pixels().all(|p| (p[0] - p[1]).abs() <= GREY && (p[1] - p[2]).abs() <= GREY) {
        return Ok(pixels().map(|p| p[1]).collect());
    }
    let what = "a picture in colours, such as a photograph or a base colour, shows no heights";
    Err(Fault::new(
        what,
        "give the height map (displacement) of the material, in grey, or its normal map",
    ))
}

pub(super) fn range(samples: &[f32]) -> f32 {
    let (low, high) = ends(samples);
    high - low
}

/// The step of whole numbers that take few values; `None` for many, and for one.
pub(super) fn step(samples: &[f32]) -> Option<f64> {
    let mut values: Vec<f32> = Vec::new();
    for sample in samples {
        if let Err(at) = values.binary_search_by(|value| value.total_cmp(sample)) {
            if values.len() == FEW {
                return None;
            }
            values.insert(at, *sample);
        }
    }
    let steps = values.windows(2).map(|pair| f64::from(pair[1] - pair[0]));
    let step = steps.min_by(f64::total_cmp)?;
    let lowest = f64::from(*values.first()?);
    let whole = |value: &f32| {
        let steps = (f64::from(*value) - lowest) / step;
        (steps - steps.round()).abs() < 0.1
    };
    (f64::from(range(samples)) < 1.01 * FEW as f64 * step && values.iter().all(whole))
        .then_some(step)
}

pub(super) fn skewness(field: &HeightField) -> f64 {
    let rms = field.rms_um();
    let cubes: f64 = field
        .heights_um()
        .iter()
        .map(|h| f64::from(*h).powi(3))
        .sum();
    if rms > 0.0 {
        cubes / field.heights_um().len() as f64 / rms.powi(3)
    } else {
        0.0
    }
}

/// Refuses a floating-point picture whose lowest or highest number is far from all others: it marks what was not measured.
pub(super) fn without_marks(samples: &[f32]) -> Result<(), Fault> {
    let mut some: Vec<f32> = samples
        .iter()
        .step_by((samples.len() / SAMPLED).max(1))
        .copied()
        .collect();
    some.sort_by(f32::total_cmp);
    let part = |share: f64| some[((some.len() - 1) as f64 * share) as usize];
    let (low, high) = (part(0.1), part(0.9));
    let far = |value: f32| (value - low).abs().min((value - high).abs()) > FAR * (high - low);
    let (lowest, highest) = ends(samples);
    let mark = [lowest, highest]
        .into_iter()
        .find(|end| far(*end) && high > low);
    match mark {
        None => Ok(()),
        Some(mark) => {
            let what = format!("its number {mark} is far from all others, as marks of holes are");
            Err(Fault::new(what, FILL))
        }
    }
}

/// Refuses numbers that are none, and pixels that are not there.
pub(super) fn finite(raster: &Raster) -> Result<(), Fault> {
    if raster.is_transparent {
        let what = "some of its pixels are transparent, and have no height";
        return Err(Fault::new(
            what,
            "fill the holes, and save it without alpha",
        ));
    }
    if let Some(at) = raster.samples.iter().position(|sample| !sample.is_finite()) {
        let bad = raster
            .samples
            .iter()
            .filter(|sample| !sample.is_finite())
            .count();
        let pixel = at / raster.channels;
        // Of the file, of which this may be the middle.
        let left = (raster.whole[0] - raster.width) / 2;
        let top = (raster.whole[1] - raster.height()) / 2;
        let what = format!(
            "{bad} of its numbers are no heights (NaN or infinite), the first in row {}, column {}",
            top + pixel / raster.width + 1,
            left + pixel % raster.width + 1
        );
        return Err(Fault::new(what, FILL));
    }
    Ok(())
}
