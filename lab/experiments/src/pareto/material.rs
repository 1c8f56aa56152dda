//! The textures that are measured: a user's HaTT folder, or the reference corpus.

use asperity::{
    learned::edges,
    model::{
        Friction, GridVertex, ModelGrid, Numerator, Provenance, TapBank, TapTrace, TextureModel,
        VertexKind, Wall, defaults, triangulate,
    },
    signal::level::nyquist_rms,
    sources::hatt,
};
use asperity_corpus::{
    CorpusError, Material, SAMPLE_RATE_HZ, TAP_RATE_HZ, UnifiedGrid,
    reference::{self, ReferenceOptions},
};
use asperity_io::diagnostic::Fault;
use std::path::Path;

/// Every material of a folder of HaTT files, in order of file name.
///
/// # Errors
/// [`Fault`] of the first file that is refused.
pub fn hatt(folder: &Path) -> Result<Vec<TextureModel>, Fault> {
    hatt::files(folder)?
        .iter()
        .map(|file| {
            let bytes = hatt::bytes(file)?;
            Ok(hatt::to_model(&hatt::parse(file, &bytes)?, "", 0))
        })
        .collect()
}

/// The prototypes of the reference corpus, each with its edge models. They are synthetic.
///
/// # Errors
/// [`CorpusError`] if the committed corpus is at fault.
pub fn corpus() -> Result<Vec<TextureModel>, CorpusError> {
    let options = ReferenceOptions {
        instances: 0,
        ..ReferenceOptions::default()
    };
    let (corpus, _) = reference::load(&options)?;
    Ok(corpus
        .materials
        .iter()
        .map(|material| prototype(material, &corpus.grid, &corpus.tap_speeds_m_s))
        .collect())
}

fn prototype(material: &Material, grid: &UnifiedGrid, speeds_m_s: &[f64]) -> TextureModel {
    let instance = &material.prototype;
    let interior: Vec<GridVertex> = grid
        .bins
        .iter()
        .zip(&instance.lsf_rad)
        .zip(&instance.level_db)
        .map(|((bin, lsf_rad), level_db)| {
            let lsf_rad: Vec<f64> = lsf_rad.iter().map(|&w| f64::from(w)).collect();
            GridVertex {
                speed_mm_s: bin.speed_mm_s,
                force_n: bin.force_n,
                kind: VertexKind::Interior,
                sigma_m_s2: libm::exp10(f64::from(*level_db) / 20.0) / nyquist_rms(&lsf_rad),
                lsf_rad,
                ma_lsf_rad: None,
                gain: 1.0,
            }
        })
        .collect();
    let order = interior.first().map_or(0, |vertex| vertex.lsf_rad.len());
    let vertices = edges::close(interior, grid.max_speed_mm_s, grid.max_force_n);
    TextureModel {
        name: material.name.clone(),
        grid: ModelGrid {
            sample_rate_hz: SAMPLE_RATE_HZ,
            order,
            numerator: Numerator::Nyquist,
            triangles: triangulate::delaunay(&vertices),
            vertices,
        },
        taps: TapBank {
            sample_rate_hz: TAP_RATE_HZ,
            traces: speeds_m_s
                .iter()
                .zip(&instance.taps_m_s2)
                .map(|(&speed_m_s, trace)| TapTrace {
                    speed_m_s,
                    accel_m_s2: trace.iter().map(|&a| f64::from(a)).collect(),
                })
                .collect(),
        },
        friction: Friction {
            mu: material.mu,
            anchors: Vec::new(),
            law: None,
        },
        wall: Wall {
            stiffness_n_m: material.stiffness_n_m,
            damping_n_s_m: defaults::DAMPING_N_S_M,
        },
        contact: None,
        direction: None,
        gains: defaults::gains(),
        provenance: Provenance::default(),
    }
}
