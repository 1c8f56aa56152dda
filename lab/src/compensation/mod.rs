//! A texture in a device's own voice: the filter of a [profile](asperity_host::profile) is put into
//! its models and taps when it is loaded.
//!
//! A model of the texture gives `y = g·σ·B(z)/A(z)·ε`. The filter is a polynomial
//! `C(z) = c₀·(1 + c₁z⁻¹ + …)` of minimum phase, so `C·y` is a model of the same kind:
//!
//! ```text
//! C·y = (c₀·g)·σ·(B·C/c₀)(z)/A(z)·ε
//! ```
//!
//! The tick renders it as it renders any model with a numerator. A texture without a filter costs
//! nothing more; one with it costs the numerator's longer recursion (`docs/devices.md`). Taps are
//! filtered sample by sample.
//!
//! | file | holds |
//! |---|---|
//! | `error` | what cannot be filtered |

mod error;
#[cfg(test)]
mod tests;

pub use error::CompensationError;

use asperity::{
    emit::{lower, raise},
    model::{GridVertex, ModelGrid, Numerator, TapBank, TextureModel},
    signal::lsf,
};
use asperity_formats::{
    Asset, Library, SceneSurface, library, limits::MAX_ORDER, scene as formats_scene,
};
use asperity_host::profile::{Compensation, MOST_TAPS, compensation::taps_at};

/// The bytes of an asset whose vibration and taps went through a filter. Its preview is left out.
///
/// # Errors
/// [`CompensationError`] for bytes that are no asset, and a texture that the filter takes beyond the limits
/// of the format.
pub fn asset(bytes: &[u8], filter: &Compensation) -> Result<Vec<u8>, CompensationError> {
    let texture = raise::raise(&Asset::parse(bytes)?);
    let texture = compensated(&texture, filter)?;
    Ok(lower::lower(&texture, None)?.bytes)
}

/// The bytes of a library with a scene, each of whose textures went through a filter.
///
/// # Errors
/// As [`asset`].
pub fn scene(bytes: &[u8], filter: &Compensation) -> Result<Vec<u8>, CompensationError> {
    let parsed = Library::parse(bytes)?;
    let mut textures = Vec::new();
    for (n, entry) in parsed.index().entries().enumerate() {
        textures.push((entry.name, asset(parsed.bytes(n)?, filter)?));
    }
    let named: Vec<(&str, &[u8])> = textures
        .iter()
        .map(|(name, bytes)| (*name, bytes.as_slice()))
        .collect();
    let surfaces: Vec<SceneSurface> = parsed.scene().iter().flat_map(|s| s.surfaces()).collect();
    let room = library::encoded_len(&named) + formats_scene::encoded_len(surfaces.len());
    let mut out = vec![0; room];
    let used = library::encode_scene(&named, &surfaces, &mut out)?;
    out.truncate(used);
    Ok(out)
}

/// A texture whose vibration and taps went through a filter.
///
/// # Errors
/// [`CompensationError::Numerator`] for zeros that leave the unit circle: a filter that is not of minimum
/// phase.
pub fn compensated(
    texture: &TextureModel,
    filter: &Compensation,
) -> Result<TextureModel, CompensationError> {
    let mut texture = texture.clone();
    texture.grid = grid(&texture.grid, filter)?;
    texture.taps = taps(&texture.taps, filter);
    if !texture.provenance.notes.is_empty() {
        texture.provenance.notes += "; ";
    }
    texture.provenance.notes += "compensated for a device";
    Ok(texture)
}

fn grid(grid: &ModelGrid, filter: &Compensation) -> Result<ModelGrid, CompensationError> {
    let mut grid = grid.clone();
    let room = room(&grid);
    let c = taps_at(filter, grid.sample_rate_hz, MOST_TAPS.min(room + 1));
    let first = c[0];
    let c: Vec<f64> = c.iter().map(|tap| tap / first).collect();
    let own = grid.numerator;
    for (n, vertex) in grid.vertices.iter_mut().enumerate() {
        let product = product(&of(own, vertex), &c);
        // The sign of noise is nobody's.
        if product.len() == 1 {
            vertex.sigma_m_s2 *= first.abs();
        } else {
            let lsf_rad = frequencies(&product);
            vertex.ma_lsf_rad = Some(lsf_rad.ok_or(CompensationError::Numerator { vertex: n })?);
            vertex.gain *= first.abs();
        }
    }
    if grid
        .vertices
        .iter()
        .any(|vertex| vertex.ma_lsf_rad.is_some())
    {
        grid.numerator = Numerator::Lsf;
    }
    Ok(grid)
}

/// Traces keep their length: what the filter adds behind their end has died away.
fn taps(bank: &TapBank, filter: &Compensation) -> TapBank {
    let mut bank = bank.clone();
    if bank.traces.is_empty() {
        return bank;
    }
    let c = taps_at(filter, bank.sample_rate_hz, MOST_TAPS);
    for trace in &mut bank.traces {
        let x = &trace.accel_m_s2;
        let y = (0..x.len()).map(|n| (0..c.len().min(n + 1)).map(|k| c[k] * x[n - k]).sum());
        trace.accel_m_s2 = y.collect();
    }
    bank
}

// The numerator of a model, times a filter.

/// A zero on the unit circle is moved to this radius, because its frequencies would coincide.
const RADIUS: f64 = 0.999;

/// Order that a filter may add to the numerators of a grid.
fn room(grid: &ModelGrid) -> usize {
    let orders = grid
        .vertices
        .iter()
        .map(|vertex| order(grid.numerator, vertex));
    MAX_ORDER.saturating_sub(orders.max().unwrap_or(0))
}

fn order(numerator: Numerator, vertex: &GridVertex) -> usize {
    match numerator {
        Numerator::None => 0,
        Numerator::Nyquist => 1,
        Numerator::Lsf => vertex.ma_lsf_rad.as_ref().map_or(0, Vec::len),
    }
}

/// B(z) of a vertex, 1 first.
fn of(numerator: Numerator, vertex: &GridVertex) -> Vec<f64> {
    match numerator {
        Numerator::None => vec![1.0],
        Numerator::Nyquist => vec![1.0, 1.0],
        Numerator::Lsf => lsf::to_polynomial(vertex.ma_lsf_rad.as_deref().unwrap_or_default()),
    }
}

/// The product of two polynomials.
fn product(b: &[f64], c: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; b.len() + c.len() - 1];
    for (i, b) in b.iter().enumerate() {
        for (j, c) in c.iter().enumerate() {
            product[i + j] += b * c;
        }
    }
    product
}

/// Line spectral frequencies of a polynomial whose zeros lie within the unit circle or on it.
fn frequencies(monic: &[f64]) -> Option<Vec<f64>> {
    lsf::from_polynomial(monic).or_else(|| {
        let inwards = monic.iter().enumerate();
        let moved: Vec<f64> = inwards.map(|(k, b)| b * RADIUS.powi(k as i32)).collect();
        lsf::from_polynomial(&moved)
    })
}
