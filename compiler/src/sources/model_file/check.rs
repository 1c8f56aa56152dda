//! A document as a model: every value in its range, every list of its length, in its order.

use super::{
    contact,
    schema::{Document, Grid},
};
use crate::name;
use asperity_formats::limits;
use asperity_io::diagnostic::Fault;
use asperity_texture::model::{
    self, ContactLaw, Direction, Friction, FrictionLaw, Gains, GridVertex, ModelGrid, Numerator,
    TapBank, TextureModel, Wall, defaults, mesh, tap_synthesis, triangulate,
};
use std::f64::consts::PI;

/// Bytes of a text of the provenance at most, so that an asset holds all of them.
const MAX_TEXT_BYTES: usize = 3072;
/// Fastest point of a law of friction, mm/s, and its largest factor: the last codes of an asset.
const FASTEST_OF_LAW_MM_S: f32 = 4095.9375;
const HIGHEST_FACTOR: f32 = 7.999_878;

/// The model of a document.
///
/// # Errors
/// The first field that an asset could not hold.
pub(super) fn model(document: Document) -> Result<TextureModel, Fault> {
    check_name("name", &document.name)?;
    let grid = grid(document.grid)?;
    let taps = taps(document.taps)?;
    let friction = friction(document.friction)?;
    let provenance = document.provenance;
    for (field, text) in [
        ("provenance.generator", provenance.generator.as_str()),
        ("provenance.source", &provenance.source),
        (
            "provenance.prompt",
            provenance.prompt.as_deref().unwrap_or_default(),
        ),
        ("provenance.notes", &provenance.notes),
    ] {
        let bytes = text.len();
        if bytes > MAX_TEXT_BYTES {
            let what = format!("{bytes} bytes, but at most {MAX_TEXT_BYTES} are accepted");
            return Err(Fault::new(what, "shorten the text").field(field));
        }
    }
    let mut notes = provenance.notes;
    let mut assume = |what: &str| {
        let space = if notes.is_empty() { "" } else { " " };
        notes = format!("{notes}{space}{what} unconfirmed defaults.");
    };
    let wall = match document.wall {
        Some(stated) => wall(stated)?,
        None => {
            assume("Stiffness and damping of the wall are");
            defaults::wall()
        }
    };
    let gains = match document.gains {
        Some(stated) => gains(stated)?,
        None => {
            assume("Gains and masses are");
            defaults::gains()
        }
    };
    if let Some(law) = &document.contact {
        contact::check(law)?;
    }
    if let Some(stated) = &document.direction {
        direction(stated, friction.highest_mu())?;
    }
    let mut texture = TextureModel {
        name: document.name,
        grid,
        taps,
        friction,
        wall,
        contact: None,
        direction: document.direction,
        gains,
        provenance: model::Provenance {
            generator: provenance.generator,
            source: provenance.source,
            source_crc32: provenance.source_crc32,
            prompt: provenance.prompt,
            seed: provenance.seed,
            taps_synthetic: provenance.taps_synthetic,
            notes,
            // The pipeline states the rest.
            ..model::Provenance::default()
        },
    };
    // A spring states the stiffness of the wall.
    let slope = document
        .contact
        .as_ref()
        .and_then(ContactLaw::stiffness_n_m);
    texture.wall.stiffness_n_m = slope.unwrap_or(texture.wall.stiffness_n_m);
    texture.contact = document.contact;
    Ok(texture)
}

/// An axis of length 1, ratios in their ranges, and μ in every direction.
fn direction(stated: &Direction, highest_mu: f64) -> Result<(), Fault> {
    let length = libm::sqrt(stated.axis.iter().map(|x| x * x).sum());
    in_range("direction.axis", length, (0.9999, 1.0001))?;
    let powers = (0.0, limits::MAX_POWER_RATIO);
    in_range("direction.power_ratio", stated.power_ratio, powers)?;
    in_range(
        "direction.speed_ratio",
        stated.speed_ratio,
        limits::SPEED_RATIO,
    )?;
    let most = (f64::from(limits::MAX_MU) / highest_mu).min(limits::MU_RATIO.1.into());
    let ratios = (limits::MU_RATIO.0, most as f32);
    in_range("direction.mu_forward", stated.mu_forward, ratios)?;
    in_range("direction.mu_backward", stated.mu_backward, ratios)
}

fn grid(stated: Grid) -> Result<ModelGrid, Fault> {
    let numerator = stated.numerator;
    in_range("grid.sample_rate_hz", stated.sample_rate_hz, rate())?;
    length(
        "grid.vertices",
        stated.vertices.len(),
        3,
        limits::MAX_VERTICES,
    )?;
    let order = stated.vertices[0].lsf_rad.len();
    length("grid.vertices[0].lsf_rad", order, 1, limits::MAX_ORDER)?;
    let ma_order = stated.vertices[0].ma_lsf_rad.as_ref().map_or(0, Vec::len);
    if numerator == Numerator::Lsf {
        length(
            "grid.vertices[0].ma_lsf_rad",
            ma_order,
            1,
            limits::MAX_ORDER,
        )?;
    }
    for (index, vertex) in stated.vertices.iter().enumerate() {
        self::vertex(index, vertex, numerator, (order, ma_order))?;
    }
    let vertices = stated.vertices;
    let (field, remedy) = match stated.triangles {
        Some(_) => (
            "grid.triangles",
            "triangulate the vertices so that they tile the rectangle from (0, 0), or leave \
             triangles out",
        ),
        None => (
            "grid.vertices",
            "give vertices at the four corners of the rectangle from (0, 0): edge models",
        ),
    };
    let triangles = match stated.triangles {
        Some(triangles) => {
            length("grid.triangles", triangles.len(), 1, limits::MAX_TRIANGLES)?;
            triangles
        }
        None => triangulate::delaunay(&vertices),
    };
    if triangles.is_empty() {
        let what = "all of them lie on one line, and a grid needs an area";
        return Err(Fault::new(what, remedy).field(field));
    }
    places(&vertices)?;
    let grid = ModelGrid {
        sample_rate_hz: stated.sample_rate_hz,
        order,
        numerator,
        vertices,
        triangles,
    };
    mesh::check(&grid).map_err(|cause| Fault::new(cause, remedy).field(field))?;
    Ok(grid)
}

fn vertex(
    index: usize,
    stated: &GridVertex,
    numerator: Numerator,
    (order, ma_order): (usize, usize),
) -> Result<(), Fault> {
    let field = |name: &str| format!("grid.vertices[{index}].{name}");
    let up_to = |name: &str, value, high: f32| in_range(&field(name), value, (0.0, high));
    up_to("speed_mm_s", stated.speed_mm_s, limits::MAX_SPEED_MM_S)?;
    up_to("force_n", stated.force_n, limits::MAX_FORCE_N)?;
    up_to("sigma_m_s2", stated.sigma_m_s2, limits::MAX_SIGMA_M_S2)?;
    frequencies(&field("lsf_rad"), &stated.lsf_rad, order)?;
    let fault = |name: &str, what| {
        let remedy = "set \"numerator\" to \"none\", \"nyquist\" or \"lsf\" as the models have it";
        Err(Fault::new(what, remedy).field(field(name)))
    };
    match (numerator, &stated.ma_lsf_rad) {
        (Numerator::Lsf, None) => fault("ma_lsf_rad", "is absent, but grid.numerator is \"lsf\""),
        (Numerator::Lsf, Some(zeros)) => {
            frequencies(&field("ma_lsf_rad"), zeros, ma_order)?;
            up_to("gain", stated.gain, limits::MAX_GAIN)
        }
        (_, Some(_)) => fault("ma_lsf_rad", "is given, but grid.numerator is not \"lsf\""),
        (_, None) if stated.gain != 1.0 => {
            fault("gain", "is not 1, but grid.numerator is not \"lsf\"")
        }
        _ => Ok(()),
    }
}

/// Every vertex has a place of its own: of two at one place, one model would be lost.
fn places(vertices: &[GridVertex]) -> Result<(), Fault> {
    let place = |vertex: &GridVertex| (vertex.speed_mm_s, vertex.force_n);
    for (index, vertex) in vertices.iter().enumerate() {
        let before = vertices[..index].iter();
        let first = before.map(place).position(|other| other == place(vertex));
        if let Some(first) = first {
            let (speed_mm_s, force_n) = place(vertex);
            let what = format!(
                "it lies at {speed_mm_s} mm/s and {force_n} N, as grid.vertices[{first}] does"
            );
            let fault = Fault::new(what, "leave one of them, or move it");
            return Err(fault.field(format!("grid.vertices[{index}]")));
        }
    }
    Ok(())
}

/// Line spectral frequencies: as many as those of the first vertex, ascending in (0, π).
fn frequencies(field: &str, lsf_rad: &[f64], order: usize) -> Result<(), Fault> {
    if lsf_rad.len() != order {
        let rule = format!("{order} as at vertex 0");
        return Err(wrong_length(field, lsf_rad.len(), &rule));
    }
    for (index, &omega) in lsf_rad.iter().enumerate() {
        if !(omega > 0.0 && omega < PI) {
            let what = format!("{omega} rad, must be above 0 and below π");
            let remedy = "give frequencies in radians a sample, 2π·f / sample_rate_hz for f in Hz";
            return Err(Fault::new(what, remedy).field(format!("{field}[{index}]")));
        }
    }
    ascending(lsf_rad.iter().copied(), |index| format!("{field}[{index}]"))
}

fn taps(stated: Option<TapBank>) -> Result<TapBank, Fault> {
    let Some(stated) = stated else {
        return Ok(TapBank {
            // An asset without taps states a rate all the same.
            sample_rate_hz: tap_synthesis::SAMPLE_RATE_HZ,
            traces: Vec::new(),
        });
    };
    in_range("taps.sample_rate_hz", stated.sample_rate_hz, rate())?;
    length("taps.traces", stated.traces.len(), 0, limits::MAX_TAPS)?;
    let samples = stated.traces.first().map_or(0, |t| t.accel_m_s2.len());
    let highest = limits::MAX_TAP_ACCEL_M_S2;
    for (index, trace) in stated.traces.iter().enumerate() {
        let field = |name: &str| format!("taps.traces[{index}].{name}");
        let speeds = (f32::MIN_POSITIVE, limits::MAX_IMPACT_SPEED_M_S);
        in_range(&field("speed_m_s"), trace.speed_m_s, speeds)?;
        let found = trace.accel_m_s2.len();
        length(&field("accel_m_s2"), found, 1, limits::MAX_TAP_SAMPLES)?;
        if found != samples {
            let rule = format!("{samples} as in trace 0");
            return Err(wrong_length(&field("accel_m_s2"), found, &rule));
        }
        for (sample, &accel) in trace.accel_m_s2.iter().enumerate() {
            let place = field(&format!("accel_m_s2[{sample}]"));
            in_range(&place, accel, (-highest, highest))?;
        }
    }
    let speeds = stated.traces.iter().map(|trace| trace.speed_m_s);
    ascending(speeds, |index| format!("taps.traces[{index}].speed_m_s"))?;
    Ok(stated)
}

fn friction(stated: Friction) -> Result<Friction, Fault> {
    in_range("friction.mu", stated.mu, (0.0, limits::MAX_MU))?;
    length(
        "friction.anchors",
        stated.anchors.len(),
        0,
        limits::MAX_ANCHORS,
    )?;
    for (index, anchor) in stated.anchors.iter().enumerate() {
        let field = |key: &str| format!("friction.anchors[{index}].{key}");
        check_name(&field("name"), &anchor.name)?;
        in_range(&field("mu"), anchor.mu, (0.0, limits::MAX_MU))?;
        in_range(&field("weight"), anchor.weight, (0.0, 1.0))?;
    }
    if let Some(law) = &stated.law {
        self::law(law, stated.mu)?;
    }
    Ok(stated)
}

fn law(law: &FrictionLaw, mu: f64) -> Result<(), Fault> {
    let points = (limits::MIN_LAW_POINTS, limits::MAX_LAW_POINTS);
    length("friction.law", law.points.len(), points.0, points.1)?;
    let mut slowest = 0.0;
    for (index, point) in law.points.iter().enumerate() {
        let field = |key: &str| format!("friction.law[{index}].{key}");
        // The codes of an asset are 1/16 mm/s apart.
        let speed = (slowest as f32, FASTEST_OF_LAW_MM_S);
        in_range(&field("speed_mm_s"), point.speed_mm_s, speed)?;
        slowest = point.speed_mm_s + 1.0 / 16.0;
        let highest = (f64::from(limits::MAX_MU) / mu).min(f64::from(HIGHEST_FACTOR));
        in_range(&field("factor"), point.factor, (0.0, highest as f32))?;
    }
    Ok(())
}

fn wall(stated: Wall) -> Result<Wall, Fault> {
    let stiffness = (f32::MIN_POSITIVE, limits::MAX_STIFFNESS_N_M);
    in_range("wall.stiffness_n_m", stated.stiffness_n_m, stiffness)?;
    let damping = (0.0, limits::MAX_DAMPING_N_S_M);
    in_range("wall.damping_n_s_m", stated.damping_n_s_m, damping)?;
    Ok(stated)
}

fn gains(stated: Gains) -> Result<Gains, Fault> {
    let vibration = (0.0, limits::MAX_VIB_GAIN_S2_M);
    in_range("gains.vib_s2_m", stated.vib_s2_m, vibration)?;
    let mass = (0.0, limits::MAX_EFFECTIVE_MASS_KG);
    in_range("gains.effective_mass_kg", stated.effective_mass_kg, mass)?;
    let force = (f32::MIN_POSITIVE, limits::MAX_DEVICE_FORCE_N);
    in_range("gains.f_max_n", stated.f_max_n, force)?;
    Ok(stated)
}

fn rate() -> (f32, f32) {
    limits::SAMPLE_RATE_HZ
}

fn check_name(field: &str, text: &str) -> Result<(), Fault> {
    if name::fits(text) {
        return Ok(());
    }
    let shown: String = text.chars().take(limits::MAX_NAME_BYTES).collect();
    Err(name::invalid(&shown).field(field))
}

/// A number within a range of the format; one that an asset would round to infinity is outside.
pub(super) fn in_range(field: &str, value: f64, (low, high): (f32, f32)) -> Result<(), Fault> {
    // A NaN is in no range.
    if (f64::from(low)..=f64::from(high)).contains(&value) {
        return Ok(());
    }
    let rule = if low == f32::MIN_POSITIVE {
        format!("above 0 and at most {high}")
    } else {
        format!("from {low} to {high}")
    };
    let what = format!("{value}, must be {rule}");
    Err(Fault::new(what, "correct the value; its unit is in the key").field(field))
}

pub(super) fn length(field: &str, found: usize, low: usize, high: usize) -> Result<(), Fault> {
    if (low..=high).contains(&found) {
        return Ok(());
    }
    Err(wrong_length(field, found, &format!("{low} to {high}")))
}

fn wrong_length(field: &str, found: usize, rule: &str) -> Fault {
    let what = format!("{found} entries, must be {rule}");
    Fault::new(what, "give as many entries as that").field(field)
}

fn ascending(
    values: impl Iterator<Item = f64>,
    field: impl Fn(usize) -> String,
) -> Result<(), Fault> {
    let mut previous = f64::NEG_INFINITY;
    for (index, value) in values.enumerate() {
        if value <= previous {
            let what = format!("{value} is not above {previous}, the one before it");
            let fault = Fault::new(what, "sort the list; no two entries may be equal");
            return Err(fault.field(field(index)));
        }
        previous = value;
    }
    Ok(())
}
