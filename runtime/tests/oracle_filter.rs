//! Location, mixture and filter agree with the f64 oracle.

use asperity_formats::{Asset, Numerator};
use asperity_runtime::{Fixed, Float, RenderArithmetic};
use asperity_tests::{
    draw::Draw,
    oracle::{Texture, polynomial},
    spectrum::model_power,
    texture::{HostSlot, TextureKind, random},
};

fn load<A: RenderArithmetic>(bytes: &[u8]) -> (Box<HostSlot<A>>, Texture) {
    let asset = Asset::parse(bytes).unwrap();
    let mut slot = Box::new(HostSlot::new());
    slot.load(&asset, asset.grid().sample_rate_hz()).unwrap();
    (slot, Texture::new(&asset))
}

/// Largest difference of log spectra from 10 Hz to 490 Hz, dB; levels of 0 are left out.
fn spectral_error_db<A: RenderArithmetic>(
    slot: &HostSlot<A>,
    oracle: &Texture,
    speed: f64,
    force: f64,
) -> f64 {
    let filter = slot.filter_at(speed as f32, force as f32);
    let model = oracle.model(f64::from(speed as f32), f64::from(force as f32));
    let wide = |c: &[f32]| -> Vec<f64> { c.iter().map(|&c| c.into()).collect() };
    if model.level_m_s2 == 0.0 {
        assert!(filter.level_m_s2.abs() < 1e-6);
        return 0.0;
    }
    let ours = model_power(&wide(&filter.a), &wide(&filter.b), filter.level_m_s2.into());
    let exact = model_power(
        &polynomial(&model.cosines),
        &oracle.numerator(&model),
        model.level_m_s2,
    );
    let bins = 20..1003;
    ours[bins.clone()]
        .iter()
        .zip(&exact[bins])
        .map(|(a, b)| (10.0 * (a / b).log10()).abs())
        .fold(0.0, f64::max)
}

#[test]
fn spectra_agree_within_two_hundredths_of_a_decibel() {
    let worst = largest_error_db::<Float>();
    println!("largest spectral error of the runtime's filters: {worst:.5} dB");
    assert!(worst < 0.02, "{worst} dB");
}

#[test]
fn spectra_in_fixed_point_agree_within_a_tenth_of_a_decibel() {
    let worst = largest_error_db::<Fixed>();
    println!("largest spectral error in fixed point: {worst:.5} dB");
    assert!(worst < 0.1, "{worst} dB");
}

fn largest_error_db<A: RenderArithmetic>() -> f64 {
    let mut worst = 0.0_f64;
    for (seed, numerator) in [Numerator::None, Numerator::Nyquist]
        .into_iter()
        .enumerate()
    {
        for order in [1, 2, 3, 4, 8, 13, 20, 21, 24] {
            let kind = TextureKind {
                numerator,
                ..TextureKind::nyquist(order)
            };
            let bytes = random(seed as u64 * 100 + order as u64, kind).encode();
            let (slot, oracle) = load::<A>(&bytes);
            let mut draw = Draw::new(order as u64);
            for _ in 0..200 {
                let (speed, force) = (draw.range(1.0, 260.0), draw.range(0.05, 4.2));
                worst = worst.max(spectral_error_db(&slot, &oracle, speed, force));
            }
        }
    }
    worst
}

#[test]
fn armas_agree_too() {
    let worst = largest_arma_error_db::<Float>();
    println!("largest spectral error of the runtime's ARMA filters: {worst:.5} dB");
    // Near a zero of the numerator a decibel is a small difference.
    assert!(worst < 0.05, "{worst} dB");
}

#[test]
fn armas_in_fixed_point_agree_too() {
    let worst = largest_arma_error_db::<Fixed>();
    println!("largest spectral error of ARMA filters in fixed point: {worst:.5} dB");
    assert!(worst < 0.1, "{worst} dB");
}

fn largest_arma_error_db<A: RenderArithmetic>() -> f64 {
    let mut worst = 0.0_f64;
    for (ar_order, ma_order) in [(20, 18), (14, 12), (24, 24), (5, 3), (6, 1)] {
        let kind = TextureKind {
            ar_order,
            ma_order,
            numerator: Numerator::Lsf,
            lattice: (7, 6),
        };
        let (slot, oracle) = load::<A>(&random(ar_order as u64, kind).encode());
        let mut draw = Draw::new(ma_order as u64);
        for _ in 0..200 {
            let (speed, force) = (draw.range(1.0, 260.0), draw.range(0.05, 4.2));
            worst = worst.max(spectral_error_db(&slot, &oracle, speed, force));
        }
    }
    worst
}

/// Two triangles may share a point, and must give the same mixture there.
#[test]
fn the_mixture_is_the_oracles_wherever_it_is_asked() {
    compare_mixtures::<Float>(2e-5);
}

/// Fixed point computes weights in steps of 10⁻⁶, from slopes that are as coarse.
#[test]
fn the_mixture_in_fixed_point_is_too() {
    compare_mixtures::<Fixed>(3e-4);
}

fn compare_mixtures<A: RenderArithmetic>(most: f64) {
    for seed in 0..5 {
        let (slot, oracle) = load::<A>(&random(seed, TextureKind::nyquist(20)).encode());
        let mut draw = Draw::new(seed);
        let mut worst = 0.0_f64;
        let mut check = |speed: f32, force: f32| {
            let query = slot.weights_at(speed, force);
            let ours = oracle.mixture(
                query.vertices.map(usize::from),
                query.weights.map(|weight| weight.value().into()),
            );
            let exact = oracle.model(speed.into(), force.into());
            for (a, b) in ours.cosines.iter().zip(&exact.cosines) {
                worst = worst.max((a - b).abs());
            }
            worst = worst.max((ours.level_m_s2 - exact.level_m_s2).abs());
        };
        for _ in 0..5000 {
            check(
                draw.range(-10.0, 300.0) as f32,
                draw.range(-1.0, 5.0) as f32,
            );
        }
        for vertex in &oracle.vertices {
            check(vertex.speed_mm_s as f32, vertex.force_n as f32);
        }
        for triangle in &oracle.triangles {
            let [a, b, _] = triangle.map(|v| &oracle.vertices[v]);
            for step in 0..=100 {
                let t = f64::from(step) / 100.0;
                let mix = |a: f64, b: f64| (a + t * (b - a)) as f32;
                check(mix(a.speed_mm_s, b.speed_mm_s), mix(a.force_n, b.force_n));
            }
        }
        println!("seed {seed}: mixtures differ by {worst:.2e} at most");
        assert!(worst < most, "seed {seed}: {worst}");
    }
}
