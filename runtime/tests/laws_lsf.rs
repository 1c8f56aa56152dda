//! Within a triangle the runtime's filter is that of the convex mixture of its corners' cosines, which are ordered,
//! and it is stable; an extrapolation would not be.

use asperity_formats::{Asset, Numerator};
use asperity_runtime::{Fixed, Float, LoadError, RenderArithmetic};
use asperity_tests::{
    draw::Draw,
    oracle::polynomial,
    size::sized,
    stability::{largest_reflection, magnitudes},
    texture::{HostSlot, Texture, TextureKind, random},
};
use std::f64::consts::PI;

/// The widest range of |A(e^jω)| that loads, and the largest magnitude in fixed point.
const WIDEST: f64 = 1.0e5;
const LARGEST: f64 = 32.0;

/// The gaps between the line spectral frequencies of an order, with those to 0 and π, as shares of the whole: even
/// ones, clusters of any kind, and spectra that lean to one side.
fn gaps(draw: &mut Draw, order: usize) -> Vec<f64> {
    let kind = draw.below(5);
    let lean = draw.range(-8.0, 8.0);
    let mut gaps: Vec<f64> = (0..=order)
        .map(|gap| match kind {
            0 => draw.range(0.1, 1.0),
            1 => draw.range(0.0, 1.0).powi(4),
            2 => draw.range(0.0, 1.0).powi(12),
            3 => (lean * gap as f64 / order as f64).exp() * draw.range(0.2, 1.0),
            _ => 0.0,
        })
        .collect();
    if kind == 4 {
        for _ in 0..=draw.below(4) {
            gaps[draw.below(order + 1)] += draw.range(0.1, 1.0);
        }
    }
    let sum: f64 = gaps.iter().sum();
    gaps.iter().map(|gap| gap / sum).collect()
}

/// LSF codes, steps of π/65536, as close as the format allows where gaps are 0.
fn codes(gaps: &[f64]) -> Vec<u16> {
    let least = 101.0;
    let room = 65536.0 - least * gaps.len() as f64;
    let ends = gaps.iter().scan(0.0, |at, gap| {
        *at += least + room * gap;
        Some(*at as u16)
    });
    ends.take(gaps.len() - 1).collect()
}

fn cosines(codes: &[u16]) -> Vec<f64> {
    let cosine = |&code: &u16| (f64::from(code) * PI / 65536.0).cos();
    codes.iter().map(cosine).collect()
}

/// The mixture of cosines.
fn mix(lists: &[Vec<f64>; 3], weights: [f64; 3]) -> Vec<f64> {
    (0..lists[0].len())
        .map(|i| lists.iter().zip(weights).map(|(list, w)| w * list[i]).sum())
        .collect()
}

/// Three corners of a triangle, alike or not, and as well conditioned as it comes.
struct Corners {
    codes: [Vec<u16>; 3],
    cosines: [Vec<f64>; 3],
    /// The widest range of |A(e^jω)|, the least and the largest magnitude.
    range: f64,
    least: f64,
    most: f64,
}

impl Corners {
    fn draw(draw: &mut Draw) -> Self {
        let order = 1 + draw.below(24);
        let common = gaps(draw, order);
        let alike = [0.0, 0.0, 0.7, 0.95][draw.below(4)];
        let even = draw.range(0.0, 1.0).powi(2);
        let codes = [(); 3].map(|()| {
            let own = gaps(draw, order);
            let mixed = common.iter().zip(own).map(|(common, own)| {
                let own = alike * common + (1.0 - alike) * own;
                even / (order as f64 + 1.0) + (1.0 - even) * own
            });
            self::codes(&mixed.collect::<Vec<_>>())
        });
        let cosines = codes.each_ref().map(|codes| cosines(codes));
        let magnitudes = cosines.each_ref().map(|x| magnitudes(x));
        let largest =
            |of: fn((f64, f64)) -> f64| magnitudes.map(of).into_iter().fold(0.0, f64::max);
        Self {
            range: largest(|(least, most)| most / least),
            least: 1.0 / largest(|(least, _)| 1.0 / least),
            most: largest(|(_, most)| most),
            codes,
            cosines,
        }
    }

    /// A texture with these corners: at rest without force, at the largest speed, at the largest force.
    fn texture(&self) -> Texture {
        let kind = TextureKind {
            ar_order: self.codes[0].len(),
            ma_order: 0,
            numerator: Numerator::None,
            lattice: (2, 2),
        };
        let mut texture = random(1, kind);
        let models = texture.models.iter_mut();
        for (model, codes) in models.zip(self.codes.iter().cycle()) {
            model.lsf.clone_from(codes);
        }
        texture
    }
}

/// Weights within the triangle, a quarter of them next to one of its edges.
fn weights(draw: &mut Draw) -> [f64; 3] {
    let near = |draw: &mut Draw| if draw.below(4) == 0 { 0.03 } else { 1.0 };
    let parts = [(); 3].map(|()| near(draw) * draw.range(1e-9, 1.0));
    parts.map(|part| part / parts.iter().sum::<f64>())
}

fn load<A: RenderArithmetic>(slot: &mut HostSlot<A>, texture: &Texture) -> Result<(), LoadError> {
    let bytes = texture.encode();
    slot.load(&Asset::parse(&bytes).unwrap(), 1000.0)
}

/// The runtime's coefficients at these weights.
fn rendered<A: RenderArithmetic>(
    slot: &HostSlot<A>,
    texture: &Texture,
    order: usize,
    weights: [f64; 3],
) -> Vec<f32> {
    let far = &texture.vertices[3];
    let at = |weight: f64, most: f32| weight as f32 * most;
    let filter = slot.filter_at(at(weights[1], far.speed_mm_s), at(weights[2], far.force_n));
    filter.a[..order].to_vec()
}

/// A texture that loads mixes cosines and is stable at every query, in both arithmetics; a refused
/// one exceeds the bound of the range or, in fixed point, of the magnitude.
#[test]
fn whatever_loads_mixes_cosines_within_a_triangle_and_stays_stable() {
    let textures = sized("textures", 3000, 20_000);
    let mut draw = Draw::new(1);
    let mut floats = Box::new(HostSlot::<Float>::new());
    let mut fixed = Box::new(HostSlot::<Fixed>::new());
    let (mut loaded, mut just, mut refused) = (0, 0, 0);
    for _ in 0..textures {
        let corners = Corners::draw(&mut draw);
        let texture = corners.texture();
        let order = corners.codes[0].len();
        let in_floats = load(&mut floats, &texture);
        let in_fixed = load(&mut fixed, &texture);
        // The runtime looks at some frequencies only.
        match in_floats {
            Ok(()) => assert!(corners.range < 1.6 * WIDEST, "{}", corners.range),
            Err(LoadError::Conditioning { .. }) => {
                assert!(corners.range > 0.98 * WIDEST, "{}", corners.range);
            }
            Err(error) => panic!("{error}"),
        }
        match in_fixed {
            Ok(()) => assert!(in_floats.is_ok() && corners.most < 1.3 * LARGEST),
            Err(LoadError::Range { field, .. }) => {
                assert_eq!(field, "grid max |A|");
                assert!(corners.most > 0.98 * LARGEST, "{}", corners.most);
            }
            Err(error) => assert!(matches!(error, LoadError::Conditioning { .. }), "{error}"),
        }
        if in_floats.is_err() {
            refused += 1;
            continue;
        }
        loaded += 1;
        just += usize::from(corners.range > WIDEST / 30.0);
        for _ in 0..4 {
            let weights = weights(&mut draw);
            let mixed = mix(&corners.cosines, weights);
            assert!(mixed.windows(2).all(|pair| pair[0] > pair[1]));
            let exact = polynomial(&mixed);
            let check = |a: &[f32], tolerance: f64| {
                assert!(largest_reflection(a) < 1.0, "{a:?}");
                let sum: f64 = 1.0 + exact.iter().map(|a| a.abs()).sum::<f64>();
                for (a, exact) in a.iter().zip(&exact) {
                    let within = tolerance * sum;
                    assert!((f64::from(*a) - exact).abs() < within, "{a} for {exact}");
                }
            };
            check(&rendered(&floats, &texture, order, weights), 2e-5);
            if in_fixed.is_ok() {
                // Weights are exact to 10⁻⁶ there, and each moves every cosine.
                check(&rendered(&fixed, &texture, order, weights), 3e-4);
            }
        }
    }
    println!("{loaded} loaded, {just} of them next to the bound, {refused} refused");
    assert!(10 * loaded > 3 * textures && 10 * just > textures && 10 * refused > textures);
}

/// Justifies checking the models alone: in a mixture min |A| is no smaller than the smallest of its
/// corners, and max |A| at most half more than the largest of theirs.
#[test]
fn no_mixture_comes_nearer_to_zero_than_its_corners() {
    let triangles = sized("triangles", 3000, 100_000);
    let mut draw = Draw::new(2);
    let (mut least, mut most, mut mixtures) = (f64::INFINITY, 0.0_f64, 0);
    for _ in 0..triangles {
        let corners = Corners::draw(&mut draw);
        if corners.range > 100.0 * WIDEST {
            continue;
        }
        for _ in 0..4 {
            let mixed = magnitudes(&mix(&corners.cosines, weights(&mut draw)));
            least = least.min(mixed.0 / corners.least);
            most = most.max(mixed.1 / corners.most);
            mixtures += 1;
        }
    }
    println!("{mixtures} mixtures: min |A| × {least:.4} or more, max |A| × {most:.4} or less");
    assert!(mixtures > 2 * triangles, "{mixtures}");
    assert!((0.98..1.1).contains(&least), "{least}");
    assert!(most < 1.5, "{most}");
}

/// Seven frequencies as close as the format allows: the format takes them, f32 would not keep their filter stable.
#[test]
fn a_cluster_is_refused_by_the_name_of_its_model() {
    let clustered: Vec<u16> = (0..24)
        .map(|line| {
            if line < 17 {
                3200 * (line + 1)
            } else {
                54_400 + 101 * (line - 16)
            }
        })
        .collect();
    let mut texture = random(1, TextureKind::nyquist(24));
    let mut slot = Box::new(HostSlot::<Float>::new());
    assert_eq!(load(&mut slot, &texture), Ok(()));
    let before = slot.filter_at(100.0, 1.0);
    texture.models[4].lsf.clone_from(&clustered);
    let refusal = load(&mut slot, &texture).unwrap_err();
    let exact = magnitudes(&cosines(&clustered));
    match refusal {
        LoadError::Conditioning { model, range, most } => {
            assert_eq!((model, f64::from(most)), (4, WIDEST));
            let share = f64::from(range) / (exact.1 / exact.0);
            assert!((0.6..1.02).contains(&share), "{range:e} for {exact:?}");
        }
        other => panic!("{other}"),
    }
    let told = refusal.to_string();
    assert!(
        told.starts_with("grid.models[4]: |A| ranges over a factor of "),
        "{told}"
    );
    assert_eq!(
        slot.filter_at(100.0, 1.0),
        before,
        "a slot that refuses keeps what it had"
    );
}

/// The law needs convexity. It fails for weights outside [0, 1], which shows that the check
/// can fail.
#[test]
fn extrapolation_breaks_the_order_and_the_filter() {
    let lists = [
        vec![0.5, 0.6, 2.0, 2.1],
        vec![0.1, 1.5, 1.6, 3.0],
        vec![0.3, 1.0, 1.8, 2.5],
    ];
    let cosines = lists.map(|list: Vec<f64>| list.iter().map(|w| w.cos()).collect::<Vec<f64>>());
    let mixed = mix(&cosines, [1.4, -0.3, -0.1]);
    assert!(mixed.windows(2).any(|pair| pair[0] <= pair[1]));
    let a: Vec<f32> = polynomial(&mixed).iter().map(|a| *a as f32).collect();
    assert!(largest_reflection(&a) >= 1.0);
}
