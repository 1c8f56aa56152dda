//! Pictures of heights: what they say, and what has to be guessed.

mod raster;

pub use raster::Raster;

use crate::heights::{HeightField, SIDE};
use asperity_io::diagnostic::Fault;

/// Points further apart than this give strokes of 20 mm/s nothing above 30 Hz, mm.
const COARSEST_MM: f64 = 1.0 / 3.0;
/// Differences of red, green and blue up to this are grey, as parts of the range.
const GREY: f32 = 1.5 / 255.0;
/// Different numbers up to which a map counts as stored in steps.
const FEW: usize = 256;
/// Skewness from which crests are so narrow that the map may show depths.
const CRESTED: f64 = 1.0;
/// A difference of a pixel's sides that is said.
const UNEQUAL: f64 = 0.01;
const DEEPEST_MM: f64 = 100.0;

/// The size of a map, which no picture says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// Width of the map, mm.
    pub width_mm: f64,
    /// Height of white above black, or of the highest point above the lowest in floating point, mm; negative where white
    /// is low.
    pub depth_mm: Option<f64>,
}

/// A map as heights.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightMap {
    /// The heights, levelled; without a depth in the size, of 1 mm from black to white.
    pub field: HeightField,
    /// Pixels of the picture.
    pub pixels: [usize; 2],
    /// Findings that the user should know.
    pub notes: Vec<String>,
}

impl HeightMap {
    /// The heights of a picture.
    ///
    /// # Errors
    /// [`Fault`] for a size that no map has, a picture that cannot be read or does not show heights, and one too coarse
    /// to vibrate.
    pub fn read(bytes: &[u8], size: &Size) -> Result<Self, Fault> {
        size.check()?;
        let raster = Raster::read(bytes)?;
        let samples = grey(&raster)?;
        let (columns, rows) = (raster.width, raster.height());
        if columns.min(rows) < SIDE.0 {
            let what = format!(
                "{columns} × {rows} pixels; at least {0} × {0} are needed",
                SIDE.0
            );
            return Err(Fault::new(what, "give a larger map"));
        }
        let pitch_mm = size.width_mm / columns as f64;
        let coarsest_mm = pitch_mm.max(pitch_mm * raster.aspect);
        if coarsest_mm > COARSEST_MM {
            let what = format!(
                "points {coarsest_mm:.2} mm apart are too coarse: strokes of 20 mm/s meet nothing above 30 Hz"
            );
            let most_mm = size.width_mm * COARSEST_MM / coarsest_mm;
            let fewest = (columns as f64 * coarsest_mm / COARSEST_MM).ceil();
            let remedy = format!(
                "give a map of at least {fewest} pixels a row, or the true width if it is {most_mm:.0} mm or less"
            );
            return Err(Fault::new(what, remedy).field("--width-mm"));
        }
        let scale_um = 1e3
            * match (size.depth_mm, raster.largest) {
                (Some(depth_mm), Some(_)) => depth_mm,
                (Some(depth_mm), None) => depth_mm / f64::from(range(&samples)).max(1e-30),
                (None, _) => 1.0,
            };
        let mut notes = Vec::new();
        let heights = samples.iter().map(|h| (f64::from(*h) * scale_um) as f32);
        let pitches = [pitch_mm, pitch_mm * raster.aspect];
        let field = HeightField::new(columns, pitches, heights.collect()).ok_or_else(|| {
            let what = "heights beyond what a number holds";
            Fault::new(what, "state a --depth-mm that the surface has")
        })?;
        if (raster.aspect - 1.0).abs() > UNEQUAL {
            notes.push(format!(
                "its pixels are {:.3} times as high as wide, as the file says",
                raster.aspect
            ));
        }
        if raster.is_coded {
            notes.push("the file says that its numbers are coded for a screen (sRGB); they are taken as heights as they are: save it as linear data if that is wrong".into());
        }
        let mut field = field.levelled();
        if let Some(step) = raster.largest.and_then(|_| step(&samples)) {
            let step_um = (step * scale_um).abs();
            notes.push(format!(
                "heights are stored in steps of {step_um:.3} µm, whose noise was filtered out; 16 bits keep fine relief"
            ));
            field = field.smoothed(step_um);
        }
        if skewness(&field) > CRESTED {
            notes.push("narrow crests rise from a wide ground; if the map shows depths, state a negative --depth-mm".into());
        }
        let field = field.bounded();
        let whole = [columns, rows];
        if [0, 1].iter().any(|&axis| {
            let kept = [field.width(), field.height()][axis] as f64 * field.pitch_mm()[axis];
            kept < 0.99 * whole[axis] as f64 * pitches[axis]
        }) {
            let [x, y] = [field.width(), field.height()];
            notes.push(format!("of the map, its middle was read, {x} × {y} points"));
        }
        Ok(Self {
            field,
            pixels: whole,
            notes,
        })
    }
}

impl Size {
    fn check(&self) -> Result<(), Fault> {
        if !(self.width_mm.is_finite() && (0.1..=10_000.0).contains(&self.width_mm)) {
            let what = format!("{} mm is no width of a map", self.width_mm);
            let remedy = "state how wide the surface is that the picture shows, 0.1 to 10000 mm";
            return Err(Fault::new(what, remedy).field("--width-mm").usage());
        }
        let depth_mm = self.depth_mm.unwrap_or(1.0);
        if !(depth_mm.is_finite() && depth_mm != 0.0 && depth_mm.abs() <= DEEPEST_MM) {
            let what = format!("{depth_mm} mm is no depth of a map");
            let remedy = "state how high white lies above black, in mm, up to 100; negative where white is low";
            return Err(Fault::new(what, remedy).field("--depth-mm").usage());
        }
        Ok(())
    }
}

/// The grey of every pixel, if all are grey.
fn grey(raster: &Raster) -> Result<Vec<f32>, Fault> {
    if let Some(at) = raster.samples.iter().position(|sample| !sample.is_finite()) {
        let bad = raster
            .samples
            .iter()
            .filter(|sample| !sample.is_finite())
            .count();
        let pixel = at / raster.channels;
        let what = format!(
            "{bad} of its numbers are no heights (NaN or infinite), the first in row {}, column {}",
            pixel / raster.width + 1,
            pixel % raster.width + 1
        );
        return Err(Fault::new(
            what,
            "fill the holes of the scan, as its software can",
        ));
    }
    if raster.channels == 1 {
        return Ok(raster.samples.clone());
    }
    let pixels = || raster.samples.chunks_exact(3);
    if pixels().all(|p| (p[0] - p[1]).abs() <= GREY && (p[1] - p[2]).abs() <= GREY) {
        return Ok(pixels().map(|p| p[1]).collect());
    }
    let what = if is_normal_map(raster) {
        "its colours are those of a normal map, not of heights"
    } else {
        "a picture in colours, such as a photograph or a base colour, shows no heights"
    };
    Err(Fault::new(
        what,
        "give the height map (displacement) of the material, in grey",
    ))
}

/// Returns true if most pixels are directions of length 1 that point out of the surface.
fn is_normal_map(raster: &Raster) -> bool {
    let unit = |pixel: &[f32]| {
        let square: f32 = pixel.iter().map(|c| (2.0 * c - 1.0).powi(2)).sum();
        pixel[2] > 0.5 && (0.8..1.2).contains(&square)
    };
    let pixels = raster.samples.chunks_exact(3);
    let units = pixels.clone().filter(|pixel| unit(pixel)).count();
    10 * units > 9 * pixels.len()
}

fn range(samples: &[f32]) -> f32 {
    let ends = samples.iter().fold((f32::MAX, f32::MIN), |(low, high), h| {
        (low.min(*h), high.max(*h))
    });
    ends.1 - ends.0
}

/// The step of whole numbers that take few values; `None` for many, and for one.
fn step(samples: &[f32]) -> Option<f64> {
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

fn skewness(field: &HeightField) -> f64 {
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
