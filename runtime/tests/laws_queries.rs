//! On random textures of every kind, weights are convex and filters are finite and stable, for
//! any bits as speed and force.

use asperity_formats::{Asset, Numerator};
use asperity_runtime::HostTexture;
use asperity_tests::{
    stability::largest_reflection,
    texture::{Texture, TextureKind, random},
};
use proptest::prelude::*;

fn load(texture: &Texture) -> Box<HostTexture> {
    let bytes = texture.encode();
    let asset = Asset::parse(&bytes).unwrap();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, 1000.0).unwrap();
    slot
}

/// Panics if a query is wrong, and names it.
fn check(slot: &HostTexture, order: usize, speed: f32, force: f32) {
    let query = slot.weights_at(speed, force);
    let sum: f32 = query.values().iter().sum();
    assert!(
        query.values().iter().all(|w| (0.0..=1.0).contains(w)) && (sum - 1.0).abs() < 1e-6,
        "({speed:e}, {force:e}): {query:?}"
    );
    let filter = slot.filter_at(speed, force);
    assert!(
        largest_reflection(&filter.a[..order]) < 1.0
            && filter.b.iter().all(|b| b.is_finite())
            && filter.level_m_s2.is_finite()
            && filter.level_m_s2 >= 0.0,
        "({speed:e}, {force:e}): {query:?} {filter:?}"
    );
}

fn number(max: f32) -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => -0.2 * max..1.2 * max,
        2 => any::<u32>().prop_map(f32::from_bits),
        1 => prop::sample::select(vec![
            0.0, -0.0, f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN,
            f32::MIN_POSITIVE, f32::from_bits(1), max, max.next_up(), max.next_down(),
        ]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_query_of_any_texture_is_convex_and_stable(
        seed in any::<u64>(),
        (ar_order, ma_order) in (1_usize..=24, 1_usize..=24),
        kind in 0_usize..3,
        lattice in (2_usize..=8, 2_usize..=8),
        queries in prop::collection::vec((number(250.0), number(4.0)), 300),
    ) {
        let numerator = [Numerator::None, Numerator::Nyquist, Numerator::Lsf][kind];
        let slot = load(&random(seed, TextureKind { ar_order, ma_order, numerator, lattice }));
        for (speed, force) in queries {
            check(&slot, ar_order, speed, force);
        }
    }
}

/// Valid assets whose triangles are as thin as rounding allows, or whose vertices are a denormal
/// apart.
#[test]
fn slivers_of_any_thinness_give_convex_weights() {
    for thickness in [
        1.0,
        1e-3,
        1e-6,
        1e-12,
        1e-20,
        1e-30,
        1e-37,
        1e-38,
        1e-40,
        1e-44,
        f32::from_bits(1),
    ] {
        for along_speed in [true, false] {
            for from_far in [true, false] {
                let mut texture = random(
                    5,
                    TextureKind {
                        lattice: (4, 4),
                        ..TextureKind::nyquist(8)
                    },
                );
                for (index, vertex) in texture.vertices.iter_mut().enumerate() {
                    let (column, row) = (index % 4, index / 4);
                    // The second line of vertices nearly touches the first or the last one.
                    let place = |at: usize, max: f32| match (at, from_far) {
                        (1, false) => thickness,
                        (1, true) => max - thickness,
                        (2, _) if from_far => max - thickness / 2.0,
                        _ => max * at as f32 / 3.0,
                    };
                    (vertex.speed_mm_s, vertex.force_n) = if along_speed {
                        (place(column, 250.0), 4.0 * row as f32 / 3.0)
                    } else {
                        (250.0 * column as f32 / 3.0, place(row, 4.0))
                    };
                }
                let slot = load(&texture);
                for vertex in &texture.vertices {
                    for (ds, df) in [(0.0, 0.0), (thickness, 0.0), (0.0, thickness), (1.0, 0.1)] {
                        check(&slot, 8, vertex.speed_mm_s + ds, vertex.force_n + df);
                        check(&slot, 8, vertex.speed_mm_s - ds, vertex.force_n - df);
                    }
                }
                for step in 0..=1000 {
                    let share = step as f32 / 1000.0;
                    check(&slot, 8, 250.0 * share, 4.0 * (1.0 - share));
                    check(&slot, 8, thickness * share, 4.0 * share);
                    check(&slot, 8, 250.0 * share, thickness * share);
                }
            }
        }
    }
}

/// A triangle that is too thin for f32 must not answer with rounding noise. Along a hair-thin
/// row of triangles the mixture stays that of the exact position.
#[test]
fn slivers_of_any_thinness_mix_what_their_neighbours_mix() {
    use asperity_tests::oracle;
    let mut worst = 0.0_f64;
    for exponent in 1..12 {
        let thickness = 10.0_f32.powi(-exponent);
        let mut texture = random(
            6,
            TextureKind {
                lattice: (4, 4),
                ..TextureKind::nyquist(8)
            },
        );
        for (index, vertex) in texture.vertices.iter_mut().enumerate() {
            let (column, row) = (index % 4, index / 4);
            vertex.speed_mm_s = 250.0 * column as f32 / 3.0;
            vertex.force_n = [0.0, 2.0, 2.0 + 4.0 * thickness, 4.0][row];
            // The mixture does not jump across the row.
            vertex.sigma_m_s2 = 0.1 * (1 + column) as f32 * [1.0, 2.0, 2.0, 3.0][row];
        }
        let bytes = texture.encode();
        let asset = Asset::parse(&bytes).unwrap();
        let oracle = oracle::Texture::new(&asset);
        let slot = load(&texture);
        for step in 0..=2000 {
            let speed = 250.0 * step as f32 / 2000.0;
            for force in [
                2.0,
                2.0 + 2.0 * thickness,
                2.0 + 4.0 * thickness,
                2.0_f32.next_up(),
            ] {
                let exact = oracle.model(speed.into(), force.into()).level_m_s2;
                let found = f64::from(slot.filter_at(speed, force).level_m_s2);
                worst = worst.max((found / exact - 1.0).abs());
            }
        }
    }
    println!("levels differ by {worst:.1e} at most");
    assert!(worst < 0.01, "{worst}");
}
