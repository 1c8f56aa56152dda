//! GRID: AR or ARMA models over the speed–force plane.

use crate::{
    error::{FormatError, in_range},
    limits,
    lsf::LsfCode,
    wire::{Reader, f16_at, f32_at},
};

pub(crate) const VERTEX_LEN: usize = 12;

/// The numerator B(z) of every model of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numerator {
    /// B = 1.
    None,
    /// B = 1 + z⁻¹, not normalised.
    Nyquist,
    /// B monic, given by its LSFs, with a gain.
    Lsf,
}

/// Kind of a vertex: a measured operating point, or one that closes the grid at its border.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VertexKind {
    /// A measured or generated operating point.
    Interior,
    /// An edge model.
    Edge,
}

/// A vertex of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Tangential speed, mm/s.
    pub speed_mm_s: f32,
    /// Normal force, N.
    pub force_n: f32,
    /// Standard deviation of the excitation before numerator and gain, m/s².
    pub sigma_m_s2: f32,
    /// Index into the model table; edge vertices may share an interior model.
    pub model: u8,
    /// Interior or edge.
    pub kind: VertexKind,
}

/// An entry of the model table.
#[derive(Debug, Clone, Copy)]
pub struct Model<'a> {
    lsf: &'a [u8],
    ma_lsf: &'a [u8],
    /// Gain of the numerator; 1 unless [`Numerator::Lsf`].
    pub gain: f32,
}

impl<'a> Model<'a> {
    /// LSFs of A(z), strictly ascending.
    pub fn lsf(&self) -> impl ExactSizeIterator<Item = LsfCode> + use<'a> {
        codes(self.lsf)
    }

    /// [`Model::lsf`] as stored, little-endian, for those who take several at once.
    #[inline]
    #[must_use]
    pub fn stored_lsf(&self) -> &'a [[u8; 2]] {
        stored(self.lsf)
    }

    /// [`Model::ma_lsf`] as stored.
    #[inline]
    #[must_use]
    pub fn stored_ma_lsf(&self) -> &'a [[u8; 2]] {
        stored(self.ma_lsf)
    }

    /// LSFs of B(z), ascending; empty unless [`Numerator::Lsf`].
    pub fn ma_lsf(&self) -> impl ExactSizeIterator<Item = LsfCode> + use<'a> {
        codes(self.ma_lsf)
    }
}

/// Codes as they are stored.
#[inline]
fn stored(bytes: &[u8]) -> &[[u8; 2]] {
    bytes.as_chunks().0
}

fn codes(bytes: &[u8]) -> impl ExactSizeIterator<Item = LsfCode> + use<'_> {
    let codes = stored(bytes).iter();
    codes.map(|&pair| LsfCode::from_bits(u16::from_le_bytes(pair)))
}

/// The grid: models at vertices, joined by triangles that tile the rectangle
/// `[0, max_speed_mm_s] × [0, max_force_n]`.
#[derive(Debug, Clone, Copy)]
pub struct Grid<'a> {
    sample_rate_hz: f32,
    ar_order: usize,
    ma_order: usize,
    numerator: Numerator,
    max_speed_mm_s: f32,
    max_force_n: f32,
    models: &'a [u8],
    vertices: &'a [[u8; VERTEX_LEN]],
    triangles: &'a [[u8; 3]],
}

impl<'a> Grid<'a> {
    pub(crate) fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let mut reader = Reader::new(bytes);
        let sample_rate_hz = in_range(
            "grid.sample_rate_hz",
            0,
            reader.f32("grid.sample_rate_hz")?,
            limits::SAMPLE_RATE_HZ,
            "100 Hz to 200 kHz",
        )?;
        let mut count = |field, range: core::ops::RangeInclusive<usize>, rule| {
            let value = usize::from(reader.u8(field)?);
            if range.contains(&value) {
                Ok(value)
            } else {
                Err(FormatError::invalid(field, 0, value as f64, rule))
            }
        };
        let numerator = match count("grid.numerator", 0..=2, "0 none, 1 Nyquist, 2 LSF")? {
            0 => Numerator::None,
            1 => Numerator::Nyquist,
            _ => Numerator::Lsf,
        };
        let ar_order = count("grid.ar_order", 1..=limits::MAX_ORDER, "1 to 24")?;
        let ma_orders = if numerator == Numerator::Lsf {
            1..=limits::MAX_ORDER
        } else {
            0..=0
        };
        let ma_order = count("grid.ma_order", ma_orders, "1 to 24 with MA LSFs, else 0")?;
        let models = count("grid.model_count", 1..=limits::MAX_VERTICES, "1 to 64")?;
        let vertices = count("grid.vertex_count", 3..=limits::MAX_VERTICES, "3 to 64")?;
        let triangles = count("grid.triangle_count", 1..=limits::MAX_TRIANGLES, "1 to 128")?;
        count("grid.reserved", 0..=0, "must be 0")?;
        count("grid.reserved", 0..=0, "must be 0")?;

        let mut grid = Self {
            sample_rate_hz,
            ar_order,
            ma_order,
            numerator,
            max_speed_mm_s: 0.0,
            max_force_n: 0.0,
            models: &[],
            vertices: &[],
            triangles: &[],
        };
        grid.models = reader.bytes("grid.models", models * grid.model_len())?;
        let records = reader.bytes("grid.vertices", vertices * VERTEX_LEN)?;
        grid.vertices = records.as_chunks().0;
        let records = reader.bytes("grid.triangles", triangles * 3)?;
        grid.triangles = records.as_chunks().0;
        reader.finish("grid")?;
        grid.check_models()?;
        grid.check_vertices()?;
        grid.check_triangles()?;
        Ok(grid)
    }

    #[inline]
    const fn model_len(&self) -> usize {
        let gain = if matches!(self.numerator, Numerator::Lsf) {
            2
        } else {
            0
        };
        (self.ar_order + self.ma_order) * 2 + gain
    }

    fn check_models(&self) -> Result<(), FormatError> {
        for (index, model) in self.models().enumerate() {
            in_range(
                "grid.model.gain",
                index,
                model.gain,
                (0.0, limits::MAX_GAIN),
                "0 to 1e4",
            )?;
            let gap = limits::MIN_LSF_GAP_CODES;
            let last = model.stored_lsf().last();
            let last = last.map(|&code| u16::from_le_bytes(code));
            let last = last.filter(|&last| last > gap.wrapping_neg());
            if let Some(code) = first_too_low(model.stored_lsf(), 0, gap).or(last) {
                return Err(FormatError::invalid(
                    "grid.model.lsf",
                    index,
                    f64::from(code),
                    "LSF codes must ascend by 100 or more, and stay 100 from both ends",
                ));
            }
            // Zeros may lie on the unit circle, so equal neighbours are allowed.
            if let Some(code) = first_too_low(model.stored_ma_lsf(), 1, 0) {
                return Err(FormatError::invalid(
                    "grid.model.ma_lsf",
                    index,
                    f64::from(code),
                    "MA LSF codes must not descend and are at least 1",
                ));
            }
        }
        Ok(())
    }

    fn check_vertices(&mut self) -> Result<(), FormatError> {
        let models = self.models().len();
        for (index, record) in self.vertices.iter().enumerate() {
            let speed = in_range(
                "grid.vertex.speed_mm_s",
                index,
                f32_at(record, 0),
                (0.0, limits::MAX_SPEED_MM_S),
                "0 to 1e4 mm/s",
            )?;
            let force = in_range(
                "grid.vertex.force_n",
                index,
                f32_at(record, 4),
                (0.0, limits::MAX_FORCE_N),
                "0 to 1e3 N",
            )?;
            in_range(
                "grid.vertex.sigma_m_s2",
                index,
                f16_at(record, 8),
                (0.0, limits::MAX_SIGMA_M_S2),
                "0 to 1e4 m/s²",
            )?;
            if usize::from(record[10]) >= models {
                return Err(FormatError::invalid(
                    "grid.vertex.model",
                    index,
                    f64::from(record[10]),
                    "must be an index of the model table",
                ));
            }
            if record[11] > 1 {
                return Err(FormatError::invalid(
                    "grid.vertex.kind",
                    index,
                    f64::from(record[11]),
                    "0 interior, 1 edge",
                ));
            }
            self.max_speed_mm_s = self.max_speed_mm_s.max(speed);
            self.max_force_n = self.max_force_n.max(force);
        }
        for (field, extent) in [
            ("grid.max_speed_mm_s", self.max_speed_mm_s),
            ("grid.max_force_n", self.max_force_n),
        ] {
            let range = (limits::MIN_EXTENT, f32::MAX);
            in_range(
                field,
                0,
                extent,
                range,
                "the grid must reach at least 0.001",
            )?;
        }
        Ok(())
    }

    /// Indices are in range, and the areas add up to the rectangle's. The compiler sees to it that
    /// triangles do not overlap. A query of an overlapping grid would still be a convex mixture,
    /// hence stable.
    fn check_triangles(&self) -> Result<(), FormatError> {
        let count = self.vertices.len();
        let mut area = 0.0;
        for (index, &triangle) in self.triangles.iter().enumerate() {
            let [a, b, c] = triangle;
            if let Some(out) = triangle.iter().find(|&&v| usize::from(v) >= count) {
                return Err(FormatError::invalid(
                    "grid.triangle",
                    index,
                    f64::from(*out),
                    "must be an index of a vertex",
                ));
            }
            if a == b || b == c || a == c {
                return Err(FormatError::invalid(
                    "grid.triangle",
                    index,
                    f64::from(a),
                    "needs three different vertices",
                ));
            }
            let at = |v: u8| {
                let (speed, force) = self.place(usize::from(v)).unwrap_or_default();
                (f64::from(speed), f64::from(force))
            };
            let ((x0, y0), (x1, y1), (x2, y2)) = (at(a), at(b), at(c));
            let twice = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
            area += if twice < 0.0 { -twice } else { twice } / 2.0;
        }
        let rectangle = f64::from(self.max_speed_mm_s) * f64::from(self.max_force_n);
        let difference = area - rectangle;
        if !(rectangle > 0.0 && difference < 1e-3 * rectangle && -difference < 1e-3 * rectangle) {
            return Err(FormatError::invalid(
                "grid.triangle.area",
                0,
                area,
                "the triangles must tile the rectangle from (0, 0) to the largest speed and force",
            ));
        }
        Ok(())
    }

    /// Sample rate of every model, Hz.
    #[must_use]
    pub const fn sample_rate_hz(&self) -> f32 {
        self.sample_rate_hz
    }

    /// Order of A(z), 1..=24.
    #[must_use]
    pub const fn ar_order(&self) -> usize {
        self.ar_order
    }

    /// Number of MA LSFs, 0 unless [`Numerator::Lsf`].
    #[must_use]
    pub const fn ma_order(&self) -> usize {
        self.ma_order
    }

    /// The numerator of every model.
    #[must_use]
    pub const fn numerator(&self) -> Numerator {
        self.numerator
    }

    /// Largest speed of a vertex, mm/s.
    #[must_use]
    pub const fn max_speed_mm_s(&self) -> f32 {
        self.max_speed_mm_s
    }

    /// Largest force of a vertex, N.
    #[must_use]
    pub const fn max_force_n(&self) -> f32 {
        self.max_force_n
    }

    /// The model table.
    pub fn models(&self) -> impl ExactSizeIterator<Item = Model<'a>> + use<'a> {
        let grid = *self;
        self.models
            .chunks_exact(self.model_len())
            .map(move |record| grid.model_of(record))
    }

    /// Returns a single model of the table without reading the others.
    #[inline]
    #[must_use]
    pub fn model(&self, index: usize) -> Option<Model<'a>> {
        record(self.models, index, self.model_len()).map(|record| self.model_of(record))
    }

    #[inline]
    fn model_of(&self, record: &'a [u8]) -> Model<'a> {
        let (lsf_len, ma_len) = (self.ar_order * 2, self.ma_order * 2);
        Model {
            lsf: record.get(..lsf_len).unwrap_or_default(),
            ma_lsf: record.get(lsf_len..lsf_len + ma_len).unwrap_or_default(),
            gain: if self.numerator == Numerator::Lsf {
                f16_at(record, lsf_len + ma_len)
            } else {
                1.0
            },
        }
    }

    /// Speed (mm/s) and force (N) of one vertex, without a look at the others.
    #[inline]
    #[must_use]
    pub fn place(&self, vertex: usize) -> Option<(f32, f32)> {
        let record = self.vertices.get(vertex)?;
        Some((f32_at(record, 0), f32_at(record, 4)))
    }

    /// The vertices, in stored order.
    #[inline]
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = Vertex> + use<'a> {
        self.vertices.iter().map(vertex)
    }

    /// The triangles, three vertex indices each, any orientation.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [u8; 3]> + use<'a> {
        self.triangles.iter().copied()
    }

    /// [`Grid::triangles`] as stored, for those who take them in another order.
    #[must_use]
    pub const fn stored_triangles(&self) -> &'a [[u8; 3]] {
        self.triangles
    }
}

/// The first code that is not at least `gap` above the one before it. The very first is compared
/// with `floor`.
fn first_too_low(codes: &[[u8; 2]], floor: u16, gap: u16) -> Option<u16> {
    let code = |&pair: &[u8; 2]| u16::from_le_bytes(pair);
    let (first, others) = codes.split_first()?;
    // By how much a code is too low. The sum ends at 65535, and whether the last code leaves its
    // gap there is the caller's check.
    let missing = |code: u16, floor: u16| floor.saturating_add(gap).saturating_sub(code);
    // Gathered side by side, without a branch for each code, because nearly all are high enough.
    let gather = |all, (above, below)| all | missing(code(above), code(below));
    let all = others.iter().zip(codes).fold(0, gather);
    if all | missing(code(first), floor) == 0 {
        return None;
    }
    let floors = core::iter::once(floor).chain(codes.iter().map(code));
    let mut pairs = codes.iter().map(code).zip(floors);
    pairs.find_map(|(code, floor)| (missing(code, floor) > 0).then_some(code))
}

/// Record `index` of a table of records of `len` bytes.
#[inline]
pub(crate) fn record(table: &[u8], index: usize, len: usize) -> Option<&[u8]> {
    let start = index.checked_mul(len)?;
    table.get(start..start.checked_add(len)?)
}

#[inline]
fn vertex(record: &[u8; VERTEX_LEN]) -> Vertex {
    let [.., model, kind] = *record;
    Vertex {
        speed_mm_s: f32_at(record, 0),
        force_n: f32_at(record, 4),
        sigma_m_s2: f16_at(record, 8),
        model,
        kind: if kind == 0 {
            VertexKind::Interior
        } else {
            VertexKind::Edge
        },
    }
}
