//! Writing an asset into a caller's buffer.

use crate::{
    asset::Asset,
    checksum::crc32,
    contact::{Adhesion, Drag, Imprint, Relaxation, SpringPoint},
    coupling::Coupling,
    direction::Direction,
    error::{EncodeError, FormatError},
    friction::Anchor,
    friction_law::LawPoint,
    grid::{Numerator, Vertex, VertexKind},
    header::{
        self, ENTRY_LEN, FIXED_LEN, HAPTIC, MAGIC, VERSION_WITH_LAW, VERSION_WITH_OPTIONAL,
        VERSION_WITHOUT_LAW,
    },
    lsf::LsfCode,
    provenance::Provenance,
    taps::FULL_SCALE,
    wire::Writer,
};

/// Everything an asset is made of, already quantised where the format asks for it.
#[derive(Debug, Clone, Copy)]
pub struct AssetParts<'a> {
    /// Name, 1 to 64 bytes.
    pub name: &'a str,
    /// The grid.
    pub grid: GridParts<'a>,
    /// The tap bank.
    pub taps: TapParts<'a>,
    /// Friction.
    pub friction: FrictionParts<'a>,
    /// Wall and gains.
    pub coupling: Coupling,
    /// The contact law of a material that gives way; with one the asset is of version 3.
    pub contact: Option<ContactParts<'a>>,
    /// The direction of ribs, a grain or a nap; with one the asset is of version 3.
    pub direction: Option<Direction>,
    /// Where the texture comes from.
    pub provenance: Option<Provenance<'a>>,
    /// PNG.
    pub preview_png: Option<&'a [u8]>,
}

/// The grid to be written.
#[derive(Debug, Clone, Copy)]
pub struct GridParts<'a> {
    /// Sample rate of every model, Hz.
    pub sample_rate_hz: f32,
    /// Order of A(z).
    pub ar_order: usize,
    /// Number of MA LSFs, 0 unless [`Numerator::Lsf`].
    pub ma_order: usize,
    /// The numerator B(z) of every model.
    pub numerator: Numerator,
    /// Distinct models.
    pub models: &'a [ModelParts<'a>],
    /// Vertices; σ is rounded to binary16.
    pub vertices: &'a [Vertex],
    /// Vertex indices.
    pub triangles: &'a [[u8; 3]],
}

/// A distinct model.
#[derive(Debug, Clone, Copy)]
pub struct ModelParts<'a> {
    /// `ar_order` codes.
    pub lsf: &'a [LsfCode],
    /// `ma_order` codes.
    pub ma_lsf: &'a [LsfCode],
    /// Gain, written only with [`Numerator::Lsf`], rounded to binary16.
    pub gain: f32,
}

/// The tap bank to be written.
#[derive(Debug, Clone, Copy)]
pub struct TapParts<'a> {
    /// Sample rate of every trace, Hz.
    pub sample_rate_hz: f32,
    /// Impact speed (m/s) and accelerations (m/s²) of each trace, one length.
    pub traces: &'a [(f32, &'a [f32])],
}

/// Friction to be written.
#[derive(Debug, Clone, Copy)]
pub struct FrictionParts<'a> {
    /// Coefficient of kinetic friction.
    pub mu: f32,
    /// Its anchors.
    pub anchors: &'a [Anchor<'a>],
    /// Points of its law over speed, 2 to 8; none for friction that does not depend on speed. With
    /// a law the asset is of version 2.
    pub law: &'a [LawPoint],
}

/// A contact law to be written; see [`ContactLaw`](crate::ContactLaw).
#[derive(Debug, Clone, Copy, Default)]
pub struct ContactParts<'a> {
    /// λ, s/m.
    pub damping_s_m: f32,
    /// The Maxwell branch.
    pub relaxation: Relaxation,
    /// What does not spring back.
    pub imprint: Imprint,
    /// What raises the limit of friction.
    pub drag: Drag,
    /// The pull at release.
    pub adhesion: Adhesion,
    /// Points of the spring's shape, 0 to 6.
    pub spring: &'a [SpringPoint],
}

/// Writes an asset into `out` and returns its length.
///
/// What was written is parsed again before it is returned, so a success is a
/// valid asset. The same parts give the same bytes.
///
/// # Errors
/// [`EncodeError`] for a small buffer, lists that do not match, or parts that a
/// reader would reject.
pub fn encode(parts: &AssetParts<'_>, out: &mut [u8]) -> Result<usize, EncodeError> {
    let ancillary =
        usize::from(parts.provenance.is_some()) + usize::from(parts.preview_png.is_some());
    let optional = usize::from(parts.contact.is_some()) + usize::from(parts.direction.is_some());
    let sections = HAPTIC.len() + optional + ancillary;
    let table_end = FIXED_LEN + sections * ENTRY_LEN;
    let mut table = Table {
        entry: FIXED_LEN,
        section: table_end,
    };

    let mut writer = Writer::new(out, table_end);
    writer.bytes(parts.name.as_bytes())?;
    table.close(out, header::NAME, table_end + parts.name.len())?;
    let end = write_grid(&parts.grid, Writer::new(out, table.section))?;
    table.close(out, header::GRID, end)?;
    let end = write_taps(&parts.taps, Writer::new(out, table.section))?;
    table.close(out, header::TAPS, end)?;
    let end = write_friction(&parts.friction, Writer::new(out, table.section))?;
    table.close(out, header::FRICTION, end)?;
    let end = write_coupling(&parts.coupling, Writer::new(out, table.section))?;
    table.close(out, header::COUPLING, end)?;
    if let Some(contact) = &parts.contact {
        let end = write_contact(contact, Writer::new(out, table.section))?;
        table.close(out, header::CONTACT, end)?;
    }
    if let Some(direction) = &parts.direction {
        let end = write_direction(direction, Writer::new(out, table.section))?;
        table.close(out, header::AXIS, end)?;
    }
    let haptic_len = table.section;
    if let Some(provenance) = &parts.provenance {
        let place = out.get_mut(table.section..).unwrap_or_default();
        let used = postcard::to_slice(provenance, place)
            .map_err(|_| EncodeError::Metadata)?
            .len();
        table.close(out, header::PROVENANCE, table.section + used)?;
    }
    if let Some(png) = parts.preview_png {
        let mut writer = Writer::new(out, table.section);
        writer.bytes(png)?;
        let end = writer.position();
        table.close(out, header::PREVIEW, end)?;
    }

    let total_len = table.section;
    let mut writer = Writer::new(out, 0);
    writer.bytes(&MAGIC)?;
    writer.u16(if optional > 0 {
        VERSION_WITH_OPTIONAL
    } else if parts.friction.law.is_empty() {
        VERSION_WITHOUT_LAW
    } else {
        VERSION_WITH_LAW
    })?;
    writer.u8(sections as u8)?;
    writer.u8(0)?;
    writer.u32(total_len as u32)?;
    writer.u32(haptic_len as u32)?;
    let crc = crc32(&[
        out.get(..16).unwrap_or_default(),
        out.get(FIXED_LEN..table_end).unwrap_or_default(),
    ]);
    Writer::new(out, 16).u32(crc)?;
    Asset::parse(out.get(..total_len).unwrap_or_default())?;
    Ok(total_len)
}

/// Fills the section table as sections are closed.
struct Table {
    entry: usize,
    section: usize,
}

impl Table {
    fn close(&mut self, out: &mut [u8], tag: [u8; 4], end: usize) -> Result<(), EncodeError> {
        let body = out.get(self.section..end).unwrap_or_default();
        let (len, crc) = (body.len() as u32, crc32(&[body]));
        let mut writer = Writer::new(out, self.entry);
        writer.bytes(&tag)?;
        writer.u32(len)?;
        writer.u32(crc)?;
        self.entry = writer.position();
        self.section = end;
        Ok(())
    }
}

fn expect(
    field: &'static str,
    index: usize,
    found: usize,
    expected: usize,
) -> Result<(), EncodeError> {
    if found == expected {
        Ok(())
    } else {
        Err(EncodeError::Count {
            field,
            index,
            found,
            expected,
        })
    }
}

/// A count that must fit one byte; readers enforce the tighter limits.
fn byte(field: &'static str, count: usize) -> Result<u8, EncodeError> {
    u8::try_from(count).map_err(|_| EncodeError::Count {
        field,
        index: 0,
        found: count,
        expected: 255,
    })
}

fn write_grid(grid: &GridParts<'_>, mut writer: Writer<'_>) -> Result<usize, EncodeError> {
    writer.f32(grid.sample_rate_hz)?;
    writer.u8(match grid.numerator {
        Numerator::None => 0,
        Numerator::Nyquist => 1,
        Numerator::Lsf => 2,
    })?;
    writer.u8(byte("grid.ar_order", grid.ar_order)?)?;
    writer.u8(byte("grid.ma_order", grid.ma_order)?)?;
    writer.u8(byte("grid.models", grid.models.len())?)?;
    writer.u8(byte("grid.vertices", grid.vertices.len())?)?;
    writer.u8(byte("grid.triangles", grid.triangles.len())?)?;
    writer.u16(0)?;
    for (index, model) in grid.models.iter().enumerate() {
        expect("grid.model.lsf", index, model.lsf.len(), grid.ar_order)?;
        expect(
            "grid.model.ma_lsf",
            index,
            model.ma_lsf.len(),
            grid.ma_order,
        )?;
        for code in model.lsf.iter().chain(model.ma_lsf) {
            writer.u16(code.to_bits())?;
        }
        if grid.numerator == Numerator::Lsf {
            writer.f16(model.gain)?;
        }
    }
    for vertex in grid.vertices {
        writer.f32(vertex.speed_mm_s)?;
        writer.f32(vertex.force_n)?;
        writer.f16(vertex.sigma_m_s2)?;
        writer.u8(vertex.model)?;
        writer.u8(match vertex.kind {
            VertexKind::Interior => 0,
            VertexKind::Edge => 1,
        })?;
    }
    for triangle in grid.triangles {
        writer.bytes(triangle)?;
    }
    Ok(writer.position())
}

fn write_taps(taps: &TapParts<'_>, mut writer: Writer<'_>) -> Result<usize, EncodeError> {
    let samples = taps.traces.first().map_or(0, |(_, trace)| trace.len());
    writer.f32(taps.sample_rate_hz)?;
    writer.u8(byte("taps.traces", taps.traces.len())?)?;
    writer.u8(0)?;
    writer.u16(u16::try_from(samples).unwrap_or(u16::MAX))?;
    for (index, (speed_m_s, trace)) in taps.traces.iter().enumerate() {
        expect("taps.trace", index, trace.len(), samples)?;
        if let Some((sample, value)) = trace.iter().enumerate().find(|(_, a)| !a.is_finite()) {
            return Err(EncodeError::Rejected(FormatError::invalid(
                "taps.trace.samples",
                index * samples + sample,
                f64::from(*value),
                "must be finite",
            )));
        }
        let peak = trace.iter().fold(
            0.0_f32,
            |peak, a| if a.abs() > peak { a.abs() } else { peak },
        );
        writer.f32(*speed_m_s)?;
        writer.f32(peak)?;
        let code =
            |sample: Option<&f32>| quantise(sample.copied().unwrap_or(0.0), peak) as u16 & 0xfff;
        for pair in trace.chunks(2) {
            let (even, odd) = (code(pair.first()), code(pair.get(1)));
            writer.u8(even as u8)?;
            writer.u8((even >> 8) as u8 | (odd << 4) as u8)?;
            if pair.len() == 2 {
                writer.u8((odd >> 4) as u8)?;
            }
        }
    }
    Ok(writer.position())
}

/// Nearest code of a sample; ties away from zero.
fn quantise(sample: f32, peak: f32) -> i16 {
    if peak > 0.0 {
        let scaled = sample / peak * f32::from(FULL_SCALE);
        let rounded = if scaled < 0.0 {
            scaled - 0.5
        } else {
            scaled + 0.5
        };
        // A float-to-integer cast truncates and saturates; NaN gives 0.
        (rounded as i16).clamp(-FULL_SCALE, FULL_SCALE)
    } else {
        0
    }
}

fn write_friction(
    friction: &FrictionParts<'_>,
    mut writer: Writer<'_>,
) -> Result<usize, EncodeError> {
    writer.f32(friction.mu)?;
    writer.u8(byte("friction.anchors", friction.anchors.len())?)?;
    for anchor in friction.anchors {
        writer.f32(anchor.mu)?;
        writer.f32(anchor.weight)?;
        writer.u8(byte("friction.anchor.name", anchor.name.len())?)?;
        writer.bytes(anchor.name.as_bytes())?;
    }
    if !friction.law.is_empty() {
        writer.u8(byte("friction.law.points", friction.law.len())?)?;
    }
    for point in friction.law {
        writer.u16(point.speed_code)?;
        writer.u16(point.factor_code)?;
    }
    Ok(writer.position())
}

fn write_coupling(coupling: &Coupling, mut writer: Writer<'_>) -> Result<usize, EncodeError> {
    for value in [
        coupling.stiffness_n_m,
        coupling.damping_n_s_m,
        coupling.vib_s2_m,
        coupling.effective_mass_kg,
        coupling.f_max_n,
    ] {
        writer.f32(value)?;
    }
    Ok(writer.position())
}

fn write_contact(contact: &ContactParts<'_>, mut writer: Writer<'_>) -> Result<usize, EncodeError> {
    let (relaxation, imprint) = (&contact.relaxation, &contact.imprint);
    for value in [
        contact.damping_s_m,
        relaxation.stiffness_n_m,
        relaxation.time_s,
        imprint.yield_m,
        imprint.share,
        imprint.heal,
        imprint.recovery_s,
        contact.drag.viscous_n_s_m2,
        contact.drag.plough_n_m,
        contact.adhesion.pull_n,
        contact.adhesion.stiffness_n_m,
    ] {
        writer.f32(value)?;
    }
    writer.u8(byte("contact.spring", contact.spring.len())?)?;
    for point in contact.spring {
        writer.u16(point.depth_code)?;
        writer.u16(point.shape_code)?;
    }
    Ok(writer.position())
}

fn write_direction(direction: &Direction, mut writer: Writer<'_>) -> Result<usize, EncodeError> {
    let numbers = [
        direction.power_ratio,
        direction.speed_ratio,
        direction.mu_forward,
        direction.mu_backward,
    ];
    for value in direction.axis.into_iter().chain(numbers) {
        writer.f32(value)?;
    }
    Ok(writer.position())
}
