//! The way back: the f64 model that the bytes of an asset describe.
//!
//! Everything that shows an asset, edits it or compares it begins here. The model has the values that the runtime
//! renders, so it differs from the one that was [lowered](crate::emit::lower) by the rounding of the format.
//!
//! ```
//! use asperity::{sources::builtin, emit::{lower::lower, raise::raise}};
//! use asperity_formats::Asset;
//!
//! let texture = builtin::texture();
//! let bytes = lower(&texture, None)?.bytes;
//! let raised = raise(&Asset::parse(&bytes).expect("a valid asset"));
//! assert_eq!((&raised.name, &raised.grid.triangles), (&texture.name, &texture.grid.triangles));
//! assert!((raised.friction.mu - texture.friction.mu).abs() < 1e-6);
//! # Ok::<(), asperity::emit::lower::LowerError>(())
//! ```

use asperity_formats as formats;
use asperity_formats::{Asset, LsfCode};
use asperity_texture::model::{
    Direction, Friction, FrictionAnchor, FrictionLaw, Gains, GridVertex, LawPoint, ModelGrid,
    Numerator, Provenance, TapBank, TapTrace, TextureModel, VertexKind,
    attributes::{self, Attributes, Meter},
};

/// The texture that an asset holds.
#[must_use]
pub fn raise(asset: &Asset<'_>) -> TextureModel {
    let coupling = asset.coupling();
    let (wall, contact) = super::contact::raise(asset);
    TextureModel {
        name: asset.name().to_owned(),
        grid: grid(asset.grid()),
        taps: TapBank {
            sample_rate_hz: f64::from(asset.taps().sample_rate_hz()),
            traces: asset
                .taps()
                .traces()
                .map(|trace| trace_of(&trace))
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
        wall,
        contact,
        direction: asset.direction().map(direction),
        gains: Gains {
            vib_s2_m: f64::from(coupling.vib_s2_m),
            effective_mass_kg: f64::from(coupling.effective_mass_kg),
            f_max_n: f64::from(coupling.f_max_n),
        },
        provenance: asset.provenance().map(provenance).unwrap_or_default(),
    }
}

fn direction(stored: &formats::Direction) -> Direction {
    Direction {
        axis: stored.axis.map(f64::from),
        power_ratio: stored.power_ratio.into(),
        speed_ratio: stored.speed_ratio.into(),
        mu_forward: stored.mu_forward.into(),
        mu_backward: stored.mu_backward.into(),
    }
}

/// The attributes of an asset. Only what decides them is raised: the models around the stated stroke, and the fastest
/// trace.
#[must_use]
pub fn attributes(asset: &Asset<'_>, meter: &mut Meter) -> Attributes {
    let (stored, taps) = (asset.grid(), asset.taps());
    let mut grid = grid_of(stored, &[]);
    if let Some(place) = attributes::place(&grid) {
        for vertex in place.vertices {
            let Some(found) = stored.vertices().nth(vertex) else {
                continue;
            };
            let model = stored
                .models()
                .nth(usize::from(found.model))
                .map(|model| model_of(&model));
            grid.vertices[vertex] = vertex_of(&found, model.as_ref(), grid.numerator);
        }
    }
    let bank = TapBank {
        sample_rate_hz: f64::from(taps.sample_rate_hz()),
        traces: taps.traces().last().iter().map(trace_of).collect(),
    };
    let (vibration, hard_hz) = (meter.vibration(&grid), meter.hard_hz(&bank));
    Attributes::of_parts(vibration, hard_hz, f64::from(asset.friction().mu()))
}

/// Returns the speed dependence of the friction, if any.
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
    let models: Vec<Model> = grid.models().map(|model| model_of(&model)).collect();
    grid_of(grid, &models)
}

/// LSFs of A(z) and of B(z), rad, and the gain.
type Model = (Vec<f64>, Vec<f64>, f64);

fn model_of(model: &formats::Model<'_>) -> Model {
    let ar = model.lsf().map(LsfCode::to_rad).collect();
    let ma = model.ma_lsf().map(LsfCode::to_rad).collect();
    (ar, ma, f64::from(model.gain))
}

/// A grid whose vertices have these models, and none where there is none.
fn grid_of(grid: &formats::Grid<'_>, models: &[Model]) -> ModelGrid {
    let numerator = match grid.numerator() {
        formats::Numerator::None => Numerator::None,
        formats::Numerator::Nyquist => Numerator::Nyquist,
        formats::Numerator::Lsf => Numerator::Lsf,
    };
    let vertex = |vertex: formats::Vertex| {
        let model = models.get(usize::from(vertex.model));
        vertex_of(&vertex, model, numerator)
    };
    ModelGrid {
        sample_rate_hz: f64::from(grid.sample_rate_hz()),
        order: grid.ar_order(),
        numerator,
        vertices: grid.vertices().map(vertex).collect(),
        triangles: grid
            .triangles()
            .map(|triangle| triangle.map(usize::from))
            .collect(),
    }
}

fn vertex_of(vertex: &formats::Vertex, model: Option<&Model>, numerator: Numerator) -> GridVertex {
    let (lsf_rad, ma_lsf_rad, gain) = model.cloned().unwrap_or_default();
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
}

fn trace_of(trace: &formats::Trace<'_>) -> TapTrace {
    TapTrace {
        speed_m_s: f64::from(trace.speed_m_s),
        accel_m_s2: trace.accel_m_s2().map(f64::from).collect(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};

    /// Attributes do not depend on the parts of the model that an asset omits: they are equal to the bit.
    #[test]
    fn attributes_of_an_asset_are_those_of_its_model() {
        let mut meter = Meter::default();
        for (speed, force, speed_m_s) in [(1.0, 1.0, 1.0), (0.3, 0.2, 2.0), (3.0, 5.0, 0.5)] {
            let mut texture = builtin::texture();
            for vertex in &mut texture.grid.vertices {
                vertex.speed_mm_s *= speed;
                vertex.force_n *= force;
            }
            for trace in &mut texture.taps.traces {
                trace.speed_m_s *= speed_m_s;
            }
            let bytes = lower(&texture, None).unwrap().bytes;
            let asset = Asset::parse(&bytes).unwrap();
            let whole = attributes::of(&raise(&asset));
            assert_eq!(super::attributes(&asset, &mut meter), whole);
            assert!(whole.rough_db.is_some() && whole.hard_hz.is_some());
        }
    }
}
