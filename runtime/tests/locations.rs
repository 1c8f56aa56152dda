//! The weights of a query are those of the point itself: they mix the corners to where the query is, in the triangle that
//! contains it.

use asperity_formats::Asset;
use asperity_runtime::{Fixed, Float, RenderArithmetic};
use asperity_tests::{
    draw::Draw,
    texture::{HostSlot, Texture, TextureKind, lattice, random},
};

fn grid(seed: u64, lattice: (usize, usize)) -> Texture {
    let kind = TextureKind {
        lattice,
        ..TextureKind::nyquist(4)
    };
    random(seed, kind)
}

fn loaded<A: RenderArithmetic>(texture: &Texture) -> Box<HostSlot<A>> {
    let mut slot = Box::new(HostSlot::new());
    slot.load(&Asset::parse(&texture.encode()).unwrap(), 1000.0)
        .unwrap();
    slot
}

/// Where a query was found: speed and force of the mixture, and the weights by vertex.
fn mixed<A: RenderArithmetic>(
    slot: &HostSlot<A>,
    texture: &Texture,
    (speed, force): (f32, f32),
) -> ([f64; 2], Vec<(usize, f64)>) {
    let query = slot.weights_at(speed, force);
    let corners: Vec<_> = query.vertices.iter().map(|v| usize::from(*v)).collect();
    let weights: Vec<_> = corners
        .iter()
        .copied()
        .zip(query.values().map(f64::from))
        .collect();
    let sum: f64 = weights.iter().map(|(_, w)| w).sum();
    assert!((sum - 1.0).abs() < 1e-5, "{weights:?}");
    let is_triangle = |t: &[u8; 3]| t.map(usize::from)[..] == corners[..];
    assert!(texture.triangles.iter().any(is_triangle), "{corners:?}");
    let mut at = [0.0; 2];
    for (corner, weight) in &weights {
        let vertex = &texture.vertices[*corner];
        at[0] += weight * f64::from(vertex.speed_mm_s);
        at[1] += weight * f64::from(vertex.force_n);
    }
    (at, weights)
}

const SHAPES: [(usize, usize); 8] = [
    (2, 2),
    (2, 3),
    (3, 2),
    (4, 4),
    (7, 6),
    (6, 7),
    (8, 8),
    (2, 8),
];

fn everywhere(check: fn(u64, (usize, usize))) {
    for (seed, shape) in (1..).zip(SHAPES) {
        check(seed, shape);
    }
}

/// In steps of 2⁻²⁰ a weight is off by less than 1e-4, in floats by rounding.
fn tolerance<A: RenderArithmetic>() -> f64 {
    if A::OUT_OF_REACH_M < 10.0 { 3e-4 } else { 3e-6 }
}

fn near<A: RenderArithmetic>(found: [f64; 2], (speed, force): (f32, f32)) {
    let off = [
        (found[0] - f64::from(speed)).abs() / 250.0,
        (found[1] - f64::from(force)).abs() / 4.0,
    ];
    assert!(
        off.iter().all(|x| *x < tolerance::<A>()),
        "({speed}, {force}) found at {found:?}"
    );
}

#[test]
fn a_mixture_of_the_corners_lies_where_the_query_is() {
    fn check<A: RenderArithmetic>(seed: u64, shape: (usize, usize)) {
        let texture = grid(seed, shape);
        let slot = loaded::<A>(&texture);
        let mut draw = Draw::new(seed);
        for _ in 0..1500 {
            let query = (draw.range(0.0, 250.0) as f32, draw.range(0.0, 4.0) as f32);
            let (found, _) = mixed(&slot, &texture, query);
            near::<A>(found, query);
            assert!(!slot.weights_at(query.0, query.1).outside);
        }
    }
    everywhere(check::<Float>);
    everywhere(check::<Fixed>);
}

#[test]
fn a_vertex_has_all_of_the_weight_and_an_edge_leaves_none_to_the_third() {
    fn check<A: RenderArithmetic>(seed: u64, shape: (usize, usize)) {
        let texture = grid(seed, shape);
        let slot = loaded::<A>(&texture);
        let place = |v: u8| {
            let vertex = &texture.vertices[usize::from(v)];
            (vertex.speed_mm_s, vertex.force_n)
        };
        let weight = |weights: &[(usize, f64)], v: u8| {
            let own = weights.iter().filter(|(at, _)| *at == usize::from(v));
            own.map(|(_, w)| w).sum::<f64>()
        };
        for triangle in &texture.triangles {
            for side in 0..3 {
                let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
                let (_, weights) = mixed(&slot, &texture, place(a));
                let own = weight(&weights, a);
                assert!((own - 1.0).abs() < 10.0 * tolerance::<A>(), "{a}: {own}");
                let ((s0, f0), (s1, f1)) = (place(a), place(b));
                let (_, weights) = mixed(&slot, &texture, ((s0 + s1) / 2.0, (f0 + f1) / 2.0));
                for end in [a, b] {
                    let own = weight(&weights, end);
                    assert!((own - 0.5).abs() < 10.0 * tolerance::<A>(), "{end}: {own}");
                }
            }
        }
    }
    everywhere(check::<Float>);
    everywhere(check::<Fixed>);
}

/// The nearest point of the border answers, and the answer says so.
#[test]
fn a_query_beyond_the_grid_is_answered_from_its_border() {
    fn check<A: RenderArithmetic>() {
        let texture = grid(9, (5, 5));
        let slot = loaded::<A>(&texture);
        let far = 300.0_f32;
        for (query, border, outside) in [
            ((far, 2.0), (250.0, 2.0), true),
            ((100.0, 9.0), (100.0, 4.0), true),
            ((far, 9.0), (250.0, 4.0), true),
            ((-5.0, 2.0), (0.0, 2.0), false),
            ((100.0, -1.0), (100.0, 0.0), false),
            ((-5.0, -1.0), (0.0, 0.0), false),
            ((250.0, 4.0), (250.0, 4.0), false),
            ((250.0, 0.0), (250.0, 0.0), false),
            ((0.0, 4.0), (0.0, 4.0), false),
            ((250.01, 0.0), (250.0, 0.0), true),
            ((0.0, 4.001), (0.0, 4.0), true),
        ] {
            let (found, _) = mixed(&slot, &texture, query);
            near::<A>(found, border);
            assert_eq!(
                slot.weights_at(query.0, query.1).outside,
                outside,
                "{query:?}"
            );
        }
    }
    check::<Float>();
    check::<Fixed>();
    let texture = grid(9, (5, 5));
    let slot = loaded::<Float>(&texture);
    for (query, border) in [
        ((f32::NAN, 2.0), (0.0, 2.0)),
        ((100.0, f32::NAN), (100.0, 0.0)),
    ] {
        near::<Float>(mixed(&slot, &texture, query).0, border);
        assert!(slot.weights_at(query.0, query.1).outside, "{query:?}");
    }
    assert!(slot.weights_at(250.0_f32.next_up(), 1.0).outside);
    assert!(slot.weights_at(1.0, 4.0_f32.next_up()).outside);
}

/// The same triangles in any order answer alike: the order of an asset has no meaning.
#[test]
fn the_order_of_triangles_and_of_their_corners_changes_nothing() {
    fn check<A: RenderArithmetic>() {
        let texture = grid(4, (6, 5));
        let mut other = texture.clone();
        other.triangles.reverse();
        for (at, triangle) in other.triangles.iter_mut().enumerate() {
            triangle.rotate_left(at % 3);
        }
        let (a, b) = (loaded::<A>(&texture), loaded::<A>(&other));
        let mut draw = Draw::new(5);
        for _ in 0..500 {
            let query = (draw.range(0.0, 250.0) as f32, draw.range(0.0, 4.0) as f32);
            let (found, _) = mixed(&b, &other, query);
            near::<A>(found, query);
            let levels = [&a, &b].map(|slot| slot.filter_at(query.0, query.1).level_m_s2);
            assert!((levels[0] - levels[1]).abs() < 1e-4, "{levels:?}");
        }
    }
    check::<Float>();
    check::<Fixed>();
    // Three triangles leave three lanes of a block, whatever their number.
    for (columns, rows) in [(2, 2), (3, 2), (2, 4)] {
        assert_eq!(lattice(columns, rows).len(), 2 * (columns - 1) * (rows - 1));
    }
}
