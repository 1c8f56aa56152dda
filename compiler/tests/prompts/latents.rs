//! Whatever the latent, the texture is stable and within bounds.

use super::PROMPTS;
use asperity::{
    driver,
    learned::{Latent, texture},
    model::Provenance,
    passes::reduce::Fidelity,
    pipeline::{Request, Ringing},
    signal::{level, lsf},
    sources::{SourceOutput, Tools},
};
use asperity_tests::size::sized_or;
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Every so many goes through the runtime as well.
const VERIFIED_EVERY: usize = 7;

/// Uniform in a cube whose half side runs from 0.01 to 10,000; every tenth has absurd
/// components.
fn latent(number: usize) -> Latent {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(number as u64);
    let mut uniform = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let half_side = 10.0_f64.powf(6.0 * uniform() - 2.0);
    let mut z: Latent = std::array::from_fn(|_| (half_side * (2.0 * uniform() - 1.0)) as f32);
    if number.is_multiple_of(10) {
        let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1e-40];
        z[number / 10 % z.len()] = odd[number / 10 % odd.len()];
    }
    z
}

/// 100,000 take ten minutes of processor time:
/// `ASPERITY_LATENTS=100000 cargo test --release -p asperity --test it any_latent`.
#[test]
fn any_latent_is_a_stable_texture_within_bounds() {
    let model = PROMPTS.model();
    let latents = sized_or("ASPERITY_LATENTS", "latents", 100, 10_000);
    let stabilised = AtomicUsize::new(0);
    (0..latents).into_par_iter().for_each(|number| {
        let z = latent(number);
        let decoded = model.decode(&z).unwrap();
        let name = format!("latent {number}");
        let (texture, _) = texture::build(
            model.description(),
            &decoded,
            &z,
            name,
            Provenance::default(),
        );
        let limits = &asperity_formats::limits::MAX_SIGMA_M_S2;
        for vertex in &texture.grid.vertices {
            assert!(lsf::is_ordered(&vertex.lsf_rad), "{number}");
            assert!(lsf::smallest_gap(&vertex.lsf_rad) > 0.009, "{number}");
            assert!(
                (0.0..f64::from(*limits)).contains(&vertex.sigma_m_s2),
                "{number}"
            );
            let rms_m_s2 = vertex.sigma_m_s2 * level::nyquist_rms(&vertex.lsf_rad);
            assert!(rms_m_s2 < 40.0, "{number}: {rms_m_s2} m/s²");
        }
        let mus: Vec<f64> = texture.friction.anchors.iter().map(|a| a.mu).collect();
        let low = mus.iter().copied().fold(f64::INFINITY, f64::min);
        let high = mus.iter().copied().fold(0.0, f64::max);
        assert!(
            (low..=high * (1.0 + 1e-12)).contains(&texture.friction.mu),
            "{number}"
        );
        if number.is_multiple_of(VERIFIED_EVERY) {
            let request = Request {
                fidelity: Fidelity::Auto,
                ..Request::default()
            };
            let source = SourceOutput {
                ringing: Ringing::Stabilised,
                ..SourceOutput::new(texture)
            };
            let compiled = driver::compile(&source, &request, &Tools::default());
            let compiled = compiled.unwrap_or_else(|error| panic!("{number}: {error}"));
            if compiled.stabilised > 0.0 {
                stabilised.fetch_add(1, Ordering::Relaxed);
            }
        }
    });
    let stabilised = stabilised.into_inner();
    let verified = latents.div_ceil(VERIFIED_EVERY);
    println!("{stabilised} of {verified} verified textures had to be stabilised");
    assert!(stabilised * 10 <= verified, "{stabilised} of {verified}");
}
