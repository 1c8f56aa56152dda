//! Pictures of heights and of normals: what they say, and what has to be guessed.

mod grey;
mod material;
mod normal_map;
mod profile;
mod raster;

pub use material::{Material, all};
pub use normal_map::Convention;
pub use profile::profile;
pub use raster::Raster;

use crate::heights::{HeightField, SIDE};
use asperity_io::diagnostic::Fault;

/// Points further apart than this give strokes of 20 mm/s nothing above 30 Hz, mm.
const COARSEST_MM: f64 = 1.0 / 3.0;
/// Skewness from which crests are so narrow that the map may show depths.
const CRESTED: f64 = 1.0;
/// A difference of a pixel's sides that is said.
const UNEQUAL: f64 = 0.01;
const DEEPEST_MM: f64 = 100.0;
/// Points of the wave at which heights give way to normals, and how many times shorter and longer waves tell their depths.
const CROSSING: f64 = 32.0;
const AROUND: f64 = 2.0;
/// A difference of a stated depth from that of the normals that is said, dB.
const CONTRADICTED_DB: f64 = 3.0;

/// The size of a map, which no picture says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// Width of the map, mm; `None` for profiles that state it.
    pub width_mm: Option<f64>,
    /// Height of white above black, or of the highest point above the lowest in floating point, mm; negative where white
    /// is low.
    pub depth_mm: Option<f64>,
}

/// The pictures of a surface, of the same size, one at least.
#[derive(Debug, Clone, Default)]
pub struct Pictures {
    /// Its heights.
    pub height: Option<Raster>,
    /// Its normals.
    pub normal: Option<Raster>,
    /// Where green points to in these, if it is known.
    pub convention: Option<Convention>,
}

/// A map as heights.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightMap {
    /// The heights, levelled; of 1 mm from black to white where [`Self::has_depth`] is false.
    pub field: HeightField,
    /// True if the depth was stated, or follows from normals.
    pub has_depth: bool,
    /// True for a profile, which says nothing of other directions.
    pub is_profile: bool,
    /// Pixels of the picture.
    pub pixels: [usize; 2],
    /// Findings that the user should know.
    pub notes: Vec<String>,
}

impl Pictures {
    /// One picture, of heights or, by its colours, of normals.
    #[must_use]
    pub fn of(raster: Raster, convention: Option<Convention>) -> Self {
        let (height, normal) = match normal_map::is_normal_map(&raster) {
            true => (None, Some(raster)),
            false => (Some(raster), None),
        };
        Self {
            height,
            normal,
            convention,
        }
    }

    /// The heights that they show.
    ///
    /// # Errors
    /// [`Fault`] for a size that no map has, pictures that show no heights or are of two sizes, and those too coarse to
    /// vibrate.
    pub fn heights(&self, size: &Size) -> Result<HeightMap, Fault> {
        size.check()?;
        let (height, normal) = (self.height.as_ref(), self.normal.as_ref());
        let none = || {
            let what = "there is no picture of heights or normals";
            Fault::new(what, "give a height map or a normal map")
        };
        let raster = height.or(normal).ok_or_else(none)?;
        if let Some(other) = normal.filter(|other| other.whole != raster.whole) {
            let ([columns, rows], [x, y]) = (raster.whole, other.whole);
            let what = format!("heights have {columns} × {rows} pixels, normals {x} × {y}");
            return Err(Fault::new(what, "scale both to the same size"));
        }
        let pitch_mm = size
            .pitch_mm(raster)
            .map_err(|fault| fault.at(&raster.file))?;
        let mut notes = raster.notes.clone();
        if (raster.aspect - 1.0).abs() > UNEQUAL {
            notes.push(format!(
                "its pixels are {:.3} times as high as wide, as the file says",
                raster.aspect
            ));
        }
        let field = match height {
            Some(raster) => {
                let found = by_heights(raster, pitch_mm, size.depth_mm, &mut notes);
                Some(found.map_err(|fault| fault.at(&raster.file))?)
            }
            None => None,
        };
        let by_normals = match (normal, size.depth_mm, &field) {
            (None, ..) => None,
            (_, Some(_), None) => {
                let what = "a normal map says its own depth";
                let fault = Fault::new(what, "leave it out, or give the height map as well");
                return Err(fault.field("depth_mm").usage());
            }
            (Some(raster), ..) => {
                let found = self.by_normals(raster, pitch_mm, &mut notes);
                Some(found.map_err(|fault| fault.at(&raster.file))?)
            }
        };
        let has_depth = size.depth_mm.is_some() || by_normals.is_some();
        let field = match (field, by_normals) {
            (Some(low), Some(high)) => joined(&low, &high, size.depth_mm.is_some(), &mut notes),
            (Some(field), None) | (None, Some(field)) => field,
            (None, None) => return Err(none()),
        };
        let field = field.levelled();
        if height.is_some() && grey::skewness(&field) > CRESTED {
            notes.push("narrow crests rise from a wide ground; if the map shows depths, state a negative --depth-mm".into());
        }
        let whole_mm = [0, 1].map(|axis| raster.whole[axis] as f64 * pitch_mm[axis]);
        let field = field.bounded();
        let [x, y] = [field.width(), field.height()];
        let kept_mm = [
            x as f64 * field.pitch_mm()[0],
            y as f64 * field.pitch_mm()[1],
        ];
        if kept_mm[0] < 0.99 * whole_mm[0] || kept_mm[1] < 0.99 * whole_mm[1] {
            notes.push(format!("of the map, its middle was read, {x} × {y} points"));
        }
        Ok(HeightMap {
            field,
            has_depth,
            is_profile: false,
            pixels: raster.whole,
            notes,
        })
    }

    fn by_normals(
        &self,
        raster: &Raster,
        pitch_mm: [f64; 2],
        notes: &mut Vec<String>,
    ) -> Result<HeightField, Fault> {
        grey::finite(raster)?;
        if !normal_map::is_normal_map(raster) {
            let what = "the picture of normals has other colours than a normal map";
            return Err(Fault::new(
                what,
                "give a normal map in tangent space, mostly blue",
            ));
        }
        let points = raster.width * raster.height();
        let flat =
            HeightField::new(raster.width, pitch_mm, vec![0.0; points]).ok_or_else(unheld)?;
        let (field, convention, found) = normal_map::heights(raster, &flat, self.convention);
        if let (Some(stated), Some(found)) = (self.convention, found)
            && stated != found
        {
            notes.push(format!(
                "green is taken as `--normal {}`, though with {} the slopes would belong to a surface",
                stated.name(),
                found.name()
            ));
        }
        if self.convention.is_none() {
            let name = convention.name();
            notes.push(match found.is_some() {
                true => format!("green is taken as `--normal {name}`, for with it the slopes belong to a surface"),
                false => format!("green is taken as `--normal {name}`; the picture does not tell"),
            });
        }
        Ok(field)
    }
}

impl Size {
    /// Checks what is stated.
    ///
    /// # Errors
    /// [`Fault`] for a width or a depth that no map has.
    pub fn check(&self) -> Result<(), Fault> {
        let width_mm = self.width_mm.unwrap_or(1.0);
        if !(width_mm.is_finite() && (0.1..=10_000.0).contains(&width_mm)) {
            let what = format!("{width_mm} mm is no width of a map");
            let remedy = "state how wide the surface is that the picture shows, 0.1 to 10000 mm";
            return Err(Fault::new(what, remedy).field("width_mm").usage());
        }
        let depth_mm = self.depth_mm.unwrap_or(1.0);
        if !(depth_mm.is_finite() && depth_mm != 0.0 && depth_mm.abs() <= DEEPEST_MM) {
            let what = format!("{depth_mm} mm is no depth of a map");
            let remedy = "state how high white lies above black, in mm, up to 100; negative where white is low";
            return Err(Fault::new(what, remedy).field("depth_mm").usage());
        }
        Ok(())
    }

    /// Distance of the pixels in x and in y, mm.
    fn pitch_mm(&self, raster: &Raster) -> Result<[f64; 2], Fault> {
        let (columns, rows) = (raster.width, raster.height());
        if columns.min(rows) < SIDE.0 {
            let least = SIDE.0;
            let what = format!("{columns} × {rows} pixels; at least {least} × {least} are needed");
            return Err(Fault::new(what, "give a larger map"));
        }
        let width_mm = self.width_mm.ok_or_else(no_width)?;
        let whole = raster.whole[0];
        let pitch_mm = width_mm / whole as f64;
        fine_enough(pitch_mm.max(pitch_mm * raster.aspect), width_mm, whole)?;
        Ok([pitch_mm, pitch_mm * raster.aspect])
    }
}

fn no_width() -> Fault {
    let remedy =
        "state how wide the surface is that the picture shows, in mm, with --width-mm or width_mm";
    Fault::new("no picture says its width", remedy)
        .field("width_mm")
        .usage()
}

/// Refuses points too far apart for any vibration.
fn fine_enough(coarsest_mm: f64, width_mm: f64, columns: usize) -> Result<(), Fault> {
    if coarsest_mm <= COARSEST_MM {
        return Ok(());
    }
    let what = format!(
        "points {coarsest_mm:.2} mm apart are too coarse: strokes of 20 mm/s meet nothing above 30 Hz"
    );
    let most_mm = width_mm * COARSEST_MM / coarsest_mm;
    let fewest = (columns as f64 * coarsest_mm / COARSEST_MM).ceil();
    let remedy = format!(
        "give a map of at least {fewest} points a row, or the true width if it is {most_mm:.0} mm or less"
    );
    Err(Fault::new(what, remedy).field("width_mm"))
}

fn unheld() -> Fault {
    let what = "heights beyond what a number holds";
    Fault::new(what, "state a --depth-mm that the surface has")
}

/// The heights of a grey picture, without the noise of its steps.
fn by_heights(
    raster: &Raster,
    pitch_mm: [f64; 2],
    depth_mm: Option<f64>,
    notes: &mut Vec<String>,
) -> Result<HeightField, Fault> {
    let samples = grey::grey(raster)?;
    if raster.largest.is_none() {
        grey::without_marks(&samples)?;
    }
    let scale_um = 1e3
        * match (depth_mm, raster.largest) {
            (Some(depth_mm), Some(_)) => depth_mm,
            (depth_mm, None) => {
                depth_mm.unwrap_or(1.0) / f64::from(grey::range(&samples)).max(1e-30)
            }
            (None, Some(_)) => 1.0,
        };
    let heights = samples.iter().map(|h| (f64::from(*h) * scale_um) as f32);
    let field = HeightField::new(raster.width, pitch_mm, heights.collect()).ok_or_else(unheld)?;
    let field = field.levelled();
    let Some(step) = raster.largest.and_then(|_| grey::step(&samples)) else {
        return Ok(field);
    };
    let step_um = (step * scale_um).abs();
    let finer = match raster.largest {
        Some(255) => "; 16 bits keep fine relief",
        _ => "",
    };
    notes.push(match depth_mm {
        Some(_) => format!(
            "heights are stored in steps of {step_um:.3} µm, whose noise was filtered out{finer}"
        ),
        None => format!(
            "heights are stored in {:.0} steps, whose noise was filtered out{finer}",
            1.0 / step
        ),
    });
    Ok(field.smoothed(step_um))
}

/// Long waves of the heights and short ones of the normals, which also tell the depth where none is stated.
fn joined(
    low: &HeightField,
    high: &HeightField,
    is_stated: bool,
    notes: &mut Vec<String>,
) -> HeightField {
    let (mut long, mut short) = (low.plane(), high.plane());
    let per_mm = low.step_per_mm();
    let crossing_per_mm = 1.0 / (CROSSING * low.pitch_mm()[0].max(low.pitch_mm()[1]));
    let away = |[x, y]: [f64; 2]| libm::hypot(x * per_mm[0], y * per_mm[1]) / crossing_per_mm;
    let (mut in_heights, mut in_normals, mut inner) = (0.0, 0.0, 0.0);
    for ((periods, halves, a), (_, _, b)) in long.waves_mut().zip(short.waves_mut()) {
        if (1.0 / AROUND..AROUND).contains(&away(periods)) {
            in_heights += halves * a.norm_sqr();
            in_normals += halves * b.norm_sqr();
            inner += halves * (*a * b.conj()).re;
        }
    }
    let ratio = if in_heights > 0.0 {
        (in_normals / in_heights).sqrt()
    } else {
        1.0
    };
    let scale = if is_stated {
        1.0
    } else {
        libm::copysign(ratio, inner)
    };
    let apart_db = 20.0 * libm::log10(ratio.max(1e-9));
    if is_stated && (apart_db.abs() > CONTRADICTED_DB || inner < 0.0) {
        notes.push(format!(
            "the normals are those of a relief {ratio:.2} times as deep as stated{}",
            if inner < 0.0 {
                ", and turned inside out"
            } else {
                ""
            }
        ));
    }
    for ((periods, _, a), (_, _, b)) in long.waves_mut().zip(short.waves_mut()) {
        let share = 1.0 / (1.0 + away(periods).powi(4));
        *a = *a * (share * scale) + *b * (1.0 - share);
    }
    low.of_plane(long)
}
