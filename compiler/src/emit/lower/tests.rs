//! Size, rounding and refusals of the back end.

use super::*;
use crate::{emit::raise::raise, sources::builtin};
use asperity_texture::{
    model::{FrictionLaw, GridVertex, LawPoint, triangulate},
    signal::spectrum::{ArmaModel, log_spectral_distance_db},
};
use proptest::prelude::*;

/// The largest plain texture: 18 interior vertices with models of their own, edge
/// models that copy them up to 64 vertices, the built-in taps, friction, wall.
fn full_texture(models: &[Vec<f64>]) -> TextureModel {
    let mut texture = builtin::texture();
    let interior: Vec<GridVertex> = texture
        .grid
        .vertices
        .iter()
        .filter(|vertex| vertex.kind == VertexKind::Interior)
        .zip(models)
        .map(|(vertex, lsf_rad)| GridVertex {
            lsf_rad: lsf_rad.clone(),
            ..vertex.clone()
        })
        .collect();
    let (width, height) = mesh::corner(&texture.grid);
    let mut vertices = interior.clone();
    for k in 0..46 {
        // Around the border, corners included: 12 along each speed side, 11 along
        // each force side.
        let (speed_mm_s, force_n) = match k {
            0..12 => (width * f64::from(k) / 12.0, 0.0),
            12..23 => (width, height * f64::from(k - 12) / 11.0),
            23..35 => (width * f64::from(35 - k) / 12.0, height),
            _ => (0.0, height * f64::from(46 - k) / 11.0),
        };
        vertices.push(GridVertex {
            speed_mm_s,
            force_n,
            kind: VertexKind::Edge,
            ..interior[k as usize % interior.len()].clone()
        });
    }
    texture.grid.order = models[0].len();
    texture.grid.triangles = triangulate::delaunay(&vertices);
    texture.grid.vertices = vertices;
    texture
}

/// 18 lists of 21 LSFs whose smallest gap is as in recorded textures.
fn models() -> impl Strategy<Value = Vec<Vec<f64>>> {
    let gaps = prop::collection::vec(0.3_f64..1.0, 22);
    let model = gaps.prop_map(|gaps| {
        let total: f64 = gaps.iter().sum();
        let mut omega = 0.0;
        gaps[..21]
            .iter()
            .map(|gap| {
                omega += gap / total * std::f64::consts::PI;
                omega
            })
            .collect()
    });
    prop::collection::vec(model, 18)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_full_texture_takes_four_kibibytes_and_loses_little(models in models()) {
        let texture = full_texture(&models);
        prop_assert_eq!(texture.grid.vertices.len(), 64);
        let lowered = lower(&texture, None).unwrap();
        prop_assert!(lowered.haptic_bytes <= 4096, "{} bytes", lowered.haptic_bytes);
        prop_assert_eq!(lowered.models, 18);
        prop_assert!(lowered.lsf_error.rms_db <= 0.03, "{:?}", lowered.lsf_error);
        prop_assert!(lowered.lsf_error.max_db <= 0.03, "{:?}", lowered.lsf_error);
    }
}

#[test]
fn the_builtin_texture_is_within_the_same_bounds_and_comes_back() {
    let texture = builtin::texture();
    let lowered = lower(&texture, None).unwrap();
    assert!(lowered.haptic_bytes <= 4096);
    assert!(lowered.lsf_error.max_db <= 0.03);
    let asset = formats::Asset::parse(&lowered.bytes).unwrap();
    let raised = crate::emit::raise::raise(&asset);
    assert_eq!(raised.grid.triangles, texture.grid.triangles);
    assert_eq!(raised.friction.anchors.len(), 1);
    for (found, expected) in raised.grid.vertices.iter().zip(&texture.grid.vertices) {
        assert_eq!(found.kind, expected.kind);
        assert!((found.speed_mm_s - expected.speed_mm_s).abs() < 1e-4);
        let distance_db = log_spectral_distance_db(
            &ArmaModel::at_vertex(&raised.grid, found),
            &ArmaModel::at_vertex(&texture.grid, expected),
        );
        assert!(distance_db < 0.02, "{distance_db} dB");
    }
    // Lowering what came back changes nothing.
    assert_eq!(
        lower(&raised, None).unwrap().haptic_bytes,
        lowered.haptic_bytes
    );
}

#[test]
fn a_law_of_friction_comes_back_within_a_code_and_is_of_version_2() {
    let mut texture = builtin::texture();
    let plain = lower(&texture, None).unwrap().bytes;
    assert_eq!(plain[4..6], [1, 0]);
    let point = |speed_mm_s, factor| LawPoint { speed_mm_s, factor };
    let law = FrictionLaw {
        points: vec![point(20.02, 1.50004), point(61.3, 1.0), point(199.99, 0.6)],
    };
    texture.friction.law = Some(law.clone());
    let bytes = lower(&texture, None).unwrap().bytes;
    assert_eq!(bytes[4..6], [2, 0]);
    // A byte of count and four a point.
    assert_eq!(bytes.len(), plain.len() + 13);
    let back = raise(&formats::Asset::parse(&bytes).unwrap()).friction;
    let found = back.law.expect("a law").points;
    for (found, stated) in found.iter().zip(&law.points) {
        assert!((found.speed_mm_s - stated.speed_mm_s).abs() <= 0.5 / 16.0);
        assert!((found.factor - stated.factor).abs() <= 0.5 / 8192.0);
    }
    for (points, names) in [
        (
            vec![point(20.0, 1.0), point(5000.0, 1.0)],
            "friction.law.speed_mm_s[1] = 5000",
        ),
        (
            vec![point(20.0, f64::NAN), point(50.0, 1.0)],
            "friction.law.factor[0] = NaN",
        ),
        (
            vec![point(20.0, 1.0), point(20.001, 2.0)],
            "friction.law.speed_mm_s[1] = 20",
        ),
        (vec![point(20.0, 1.0)], "friction.law.count[0] = 1"),
        (
            vec![point(20.0, 1.0); 9],
            "points of the law of friction: 9",
        ),
    ] {
        texture.friction.law = Some(FrictionLaw { points });
        let error = lower(&texture, None).unwrap_err().to_string();
        assert!(error.contains(names), "{error}");
    }
}

#[test]
fn what_an_asset_cannot_hold_is_named() {
    let texture = builtin::texture();
    let mut close = texture.clone();
    close.grid.vertices[4].lsf_rad[1] = close.grid.vertices[4].lsf_rad[0] + 1e-4;
    assert!(matches!(
        lower(&close, None),
        Err(LowerError::Gap { vertex: 4, .. })
    ));
    let mut odd = texture.clone();
    odd.grid.vertices[2].lsf_rad[7] = f64::NAN;
    assert!(matches!(
        lower(&odd, None),
        Err(LowerError::Frequency {
            vertex: 2,
            index: 7,
            ..
        })
    ));
    let mut many = texture.clone();
    many.grid.vertices = vec![many.grid.vertices[0].clone(); 300];
    assert!(matches!(
        lower(&many, None),
        Err(LowerError::TooMany {
            found: 300,
            limit: 64,
            ..
        })
    ));
    let mut short = texture.clone();
    short.grid.vertices[5].lsf_rad.pop();
    assert!(matches!(
        lower(&short, None),
        Err(LowerError::Encode(EncodeError::Count { .. }))
    ));
    let mut nameless = texture;
    nameless.name.clear();
    assert!(matches!(
        lower(&nameless, None),
        Err(LowerError::Encode(EncodeError::Rejected(_)))
    ));
}

/// Claim: what a runtime needs of an asset is counted of the bytes that it has, and bytes that are no
/// asset change nothing.
#[test]
fn other_bytes_are_counted_anew() {
    let texture = builtin::texture();
    let mut lowered = lower(&texture, None).unwrap();
    let before = lowered.clone();
    let mut longer = texture.clone();
    longer.friction.law = FrictionLaw::through(vec![
        LawPoint {
            speed_mm_s: 0.0,
            factor: 1.0,
        },
        LawPoint {
            speed_mm_s: 100.0,
            factor: 0.5,
        },
    ]);
    let other = lower(&longer, None).unwrap();
    assert!(other.haptic_bytes > before.haptic_bytes);
    lowered.set_bytes(other.bytes.clone()).unwrap();
    assert_eq!(
        (&lowered.bytes, lowered.haptic_bytes),
        (&other.bytes, other.haptic_bytes)
    );
    assert!(lowered.set_bytes(b"no asset".to_vec()).is_err());
    assert_eq!(lowered.bytes, other.bytes);
}

/// Claim: a trace without a scale of its own reaches the encoder as it is.
#[test]
fn a_trace_that_cannot_be_scaled_is_not_quantised() {
    for accel_m_s2 in [
        vec![0.0; 4],
        vec![1.0, f64::INFINITY, -2.5],
        vec![f64::NAN; 2],
    ] {
        let trace = TapTrace {
            speed_m_s: 0.1,
            accel_m_s2: accel_m_s2.clone(),
        };
        let quantised = quantise_trace(&trace);
        let bits = |a: f32| a.to_bits();
        let same = accel_m_s2.iter().map(|&a| bits(a as f32));
        assert!(quantised.into_iter().map(bits).eq(same), "{accel_m_s2:?}");
    }
}
