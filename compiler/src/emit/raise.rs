//! The way back: the f64 model that the bytes of an asset describe.
//!
//! Everything that shows an asset, edits it or compares it begins here. The model has the values that the runtime
//! renders, so it differs from the one that was [lowered](crate::lower) by the rounding of the format.
//!
//! ```
//! use asperity::{builtin, lower::lower, raise::raise};
//! use asperity_formats::Asset;
//!
//! let texture = builtin::texture();
//! let bytes = lower(&texture, None)?.bytes;
//! let raised = raise(&Asset::parse(&bytes).expect("a valid asset"));
//! assert_eq!((&raised.name, &raised.grid.triangles), (&texture.name, &texture.grid.triangles));
//! assert!((raised.friction.mu - texture.friction.mu).abs() < 1e-6);
//! # Ok::<(), asperity::lower::LowerError>(())
//! ```

use asperity_formats as formats;
use asperity_formats::{Asset, LsfCode};
use asperity_texture::model::{
    Friction, FrictionAnchor, FrictionLaw, Gains, GridVertex, LawPoint, ModelGrid, Numerator,
    Provenance, TapBank, TapTrace, TextureModel, VertexKind, Wall,
};

/// The texture that an asset holds.
#[must_use]
pub fn raise(asset: &Asset<'_>) -> TextureModel {
    let coupling = asset.coupling();
    TextureModel {
        name: asset.name().to_owned(),
        grid: grid(asset.grid()),
        taps: TapBank {
            sample_rate_hz: f64::from(asset.taps().sample_rate_hz()),
            traces: asset
                .taps()
                .traces()
                .map(|trace| TapTrace {
                    speed_m_s: f64::from(trace.speed_m_s),
                    accel_m_s2: trace.accel_m_s2().map(f64::from).collect(),
                })
                .collect(),
        },
        friction: Friction {
            mu: f64::from(asset.friction().mu()),
            anchors: asset
                .friction()
                .anchors()
                .map(|anchor| FrictionAnchor {
                    name: anchor.name.to_owned(),
                    mu: f64::from(anchor.mu),
                    weight: f64::from(anchor.weight),
                })
                .collect(),
            law: law(asset),
        },
        wall: Wall {
            stiffness_n_m: f64::from(coupling.stiffness_n_m),
            damping_n_s_m: f64::from(coupling.damping_n_s_m),
        },
        gains: Gains {
            vib_s2_m: f64::from(coupling.vib_s2_m),
            effective_mass_kg: f64::from(coupling.effective_mass_kg),
            f_max_n: f64::from(coupling.f_max_n),
        },
        provenance: asset.provenance().map(provenance).unwrap_or_default(),
    }
}

/// How the friction of an asset depends on speed, if it does.
#[must_use]
pub fn law(asset: &Asset<'_>) -> Option<FrictionLaw> {
    let law = asset.friction().law()?;
    let points = law.points().map(|point| LawPoint {
        speed_mm_s: f64::from(point.speed_mm_s()),
        factor: f64::from(point.factor()),
    });
    Some(FrictionLaw {
        points: points.collect(),
    })
}

fn grid(grid: &formats::Grid<'_>) -> ModelGrid {
    let numerator = match grid.numerator() {
        formats::Numerator::None => Numerator::None,
        formats::Numerator::Nyquist => Numerator::Nyquist,
        formats::Numerator::Lsf => Numerator::Lsf,
    };
    let models: Vec<_> = grid
        .models()
        .map(|model| {
            (
                model.lsf().map(LsfCode::to_rad).collect::<Vec<_>>(),
                model.ma_lsf().map(LsfCode::to_rad).collect::<Vec<_>>(),
                f64::from(model.gain),
            )
        })
        .collect();
    ModelGrid {
        sample_rate_hz: f64::from(grid.sample_rate_hz()),
        order: grid.ar_order(),
        numerator,
        vertices: grid
            .vertices()
            .map(|vertex| {
                // A parsed asset refers to models that are there.
                let (lsf_rad, ma_lsf_rad, gain) = models
                    .get(usize::from(vertex.model))
                    .cloned()
                    .unwrap_or_default();
                GridVertex {
                    speed_mm_s: f64::from(vertex.speed_mm_s),
                    force_n: f64::from(vertex.force_n),
                    kind: match vertex.kind {
                        formats::VertexKind::Interior => VertexKind::Interior,
                        formats::VertexKind::Edge => VertexKind::Edge,
                    },
                    lsf_rad,
                    ma_lsf_rad: (numerator == Numerator::Lsf).then_some(ma_lsf_rad),
                    gain,
                    sigma_m_s2: f64::from(vertex.sigma_m_s2),
                }
            })
            .collect(),
        triangles: grid
            .triangles()
            .map(|triangle| triangle.map(usize::from))
            .collect(),
    }
}

fn provenance(stored: &formats::Provenance<'_>) -> Provenance {
    Provenance {
        generator: stored.generator.to_owned(),
        source: stored.source.to_owned(),
        source_crc32: stored.source_crc32,
        prompt: stored.prompt.map(str::to_owned),
        seed: stored.seed,
        fidelity: stored.fidelity.to_owned(),
        taps_synthetic: stored.taps_synthetic,
        lsf_error_db: stored.lsf_error_db,
        notes: stored.notes.to_owned(),
    }
}
