//! A field of heights on a rectangular grid.

use crate::plane::Plane;

/// Fewest and most points along a side.
pub const SIDE: (usize, usize) = (16, 2048);
/// Points finer than this tell nothing more, for a contact with all but the hardest averages over more, mm.
const FINEST_MM: f64 = 0.02;

/// Heights in rows from the top of the surface down, each from left to right.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightField {
    width: usize,
    pitch_mm: [f64; 2],
    heights_um: Vec<f32>,
}

impl HeightField {
    /// A field of `width` columns with points `pitch_mm` apart, in x and in y; `None` unless the rows are whole, there are
    /// at least [`SIDE`] points each way, and all is finite.
    #[must_use]
    pub fn new(width: usize, pitch_mm: [f64; 2], heights_um: Vec<f32>) -> Option<Self> {
        let whole = width >= SIDE.0 && heights_um.len().is_multiple_of(width);
        let field = Self {
            width,
            pitch_mm,
            heights_um,
        };
        let spaced = pitch_mm
            .iter()
            .all(|pitch| pitch.is_finite() && *pitch > 0.0);
        let finite = field.heights_um.iter().all(|height| height.is_finite());
        (whole && field.height() >= SIDE.0 && spaced && finite).then_some(field)
    }

    /// Columns.
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub const fn height(&self) -> usize {
        self.heights_um.len() / self.width
    }

    /// Distance of the points in x and in y, mm.
    #[must_use]
    pub const fn pitch_mm(&self) -> [f64; 2] {
        self.pitch_mm
    }

    /// Spatial frequency of one period over the field in x and in y, 1/mm.
    #[must_use]
    pub(crate) fn step_per_mm(&self) -> [f64; 2] {
        let [x, y] = self.pitch_mm;
        [
            1.0 / (self.width as f64 * x),
            1.0 / (self.height() as f64 * y),
        ]
    }

    /// The heights, µm, row by row from the top.
    #[must_use]
    pub fn heights_um(&self) -> &[f32] {
        &self.heights_um
    }

    /// A field of the same points with other heights, µm.
    pub(crate) fn with_heights(&self, heights_um: Vec<f32>) -> Self {
        Self {
            width: self.width,
            pitch_mm: self.pitch_mm,
            heights_um,
        }
    }

    /// The lowest and the highest of the heights, µm.
    #[must_use]
    pub fn ends_um(&self) -> (f32, f32) {
        ends(&self.heights_um)
    }

    /// The transform of the heights.
    pub(crate) fn plane(&self) -> Plane {
        let mut heights: Vec<f64> = self.heights_um.iter().map(|h| f64::from(*h)).collect();
        Plane::of(self.width, &mut heights)
    }

    /// The field of the same points that a transform of heights, µm, stands for.
    pub(crate) fn of_plane(&self, plane: Plane) -> Self {
        self.with_heights(plane.inverse().into_iter().map(|h| h as f32).collect())
    }

    /// The field so many times as high.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = self
            .heights_um
            .iter()
            .map(|h| (f64::from(*h) * factor) as f32);
        self.with_heights(scaled.collect())
    }

    /// Root mean square of the heights, µm.
    #[must_use]
    pub fn rms_um(&self) -> f64 {
        let squares: f64 = self
            .heights_um
            .iter()
            .map(|h| f64::from(*h) * f64::from(*h))
            .sum();
        (squares / self.heights_um.len() as f64).sqrt()
    }

    /// The heights without the plane that fits them best.
    #[must_use]
    pub fn levelled(&self) -> Self {
        let (columns, rows) = (self.width, self.height());
        let centred = |n: usize, count: usize| n as f64 - 0.5 * (count as f64 - 1.0);
        let square = |count: usize| (count * count - 1) as f64 / 12.0;
        let (mut mean, mut in_x, mut in_y) = (0.0, 0.0, 0.0);
        for (y, row) in self.heights_um.chunks_exact(columns).enumerate() {
            let (mut sum, mut moment) = (0.0, 0.0);
            for (x, height) in row.iter().enumerate() {
                sum += f64::from(*height);
                moment += f64::from(*height) * centred(x, columns);
            }
            mean += sum;
            in_x += moment;
            in_y += sum * centred(y, rows);
        }
        let count = self.heights_um.len() as f64;
        let (mean, in_x) = (mean / count, in_x / count / square(columns));
        let in_y = in_y / count / square(rows);
        let levelled = self.heights_um.iter().enumerate().map(|(n, height)| {
            let plane =
                mean + in_x * centred(n % columns, columns) + in_y * centred(n / columns, rows);
            (f64::from(*height) - plane) as f32
        });
        self.with_heights(levelled.collect())
    }

    /// Some of the points, evenly, so that at most `most` are left along a side.
    #[must_use]
    pub fn thinned(&self, most: usize) -> Self {
        let by = self.width.max(self.height()).div_ceil(most.max(SIDE.0));
        let rows = self.heights_um.chunks_exact(self.width).step_by(by);
        let heights_um: Vec<f32> = rows
            .flat_map(|row| row.iter().step_by(by))
            .copied()
            .collect();
        Self {
            width: self.width.div_ceil(by),
            pitch_mm: self.pitch_mm.map(|pitch| pitch * by as f64),
            heights_um,
        }
    }

    /// The field as far as a tip can tell it from the whole: points are averaged until they are 0.02 mm apart, and of a field
    /// that is larger than [`SIDE`] then, its middle is taken.
    #[must_use]
    pub fn bounded(self) -> Self {
        let by = self
            .pitch_mm
            .map(|pitch| ((FINEST_MM / pitch) as usize).max(1));
        let (columns, rows) = (self.width / by[0], self.height() / by[1]);
        if by == [1, 1] && columns <= SIDE.1 && rows <= SIDE.1 || columns.min(rows) < SIDE.0 {
            return self;
        }
        let (wide, high) = (columns.min(SIDE.1), rows.min(SIDE.1));
        let (left, top) = ((columns - wide) / 2 * by[0], (rows - high) / 2 * by[1]);
        let share = 1.0 / (by[0] * by[1]) as f32;
        let mut heights_um = Vec::with_capacity(wide * high);
        for y in 0..high {
            let from = top + y * by[1];
            for x in 0..wide {
                let at = left + x * by[0];
                let cell = (from..from + by[1])
                    .flat_map(|row| &self.heights_um[row * self.width + at..][..by[0]]);
                heights_um.push(share * cell.sum::<f32>());
            }
        }
        Self {
            width: wide,
            pitch_mm: [0, 1].map(|axis| self.pitch_mm[axis] * by[axis] as f64),
            heights_um,
        }
    }
}

/// The least and the greatest of numbers.
pub(crate) fn ends(numbers: &[f32]) -> (f32, f32) {
    let wider = |(low, high): (f32, f32), n: &f32| (low.min(*n), high.max(*n));
    numbers.iter().fold((f32::MAX, f32::MIN), wider)
}
