//! Fixed point on real materials. No range cuts a model, spectra are within a tenth of a decibel
//! of those of the f64 oracle, and the bands of the vibration are those of floats.

use crate::support;
use asperity_formats::Asset;
use asperity_runtime::quantity::Quantity;
use asperity_runtime::{Fixed, Float, RenderArithmetic, stage::vibration::Vibration};
use asperity_tests::{
    draw::Draw,
    figures, hatt,
    oracle::{Texture, polynomial},
    size::{Size, sized},
    spectrum::{band_levels_db, model_power, periodogram, third_octaves},
    texture::HostSlot,
};
use rayon::prelude::*;

const RATE_HZ: f64 = 1000.0;

fn load<A: RenderArithmetic>(bytes: &[u8]) -> Box<HostSlot<A>> {
    let asset = Asset::parse(bytes).unwrap();
    let mut slot = Box::new(HostSlot::new());
    slot.load(&asset, asset.grid().sample_rate_hz()).unwrap();
    slot
}

fn point(draw: &mut Draw, oracle: &Texture) -> (f32, f32) {
    (
        draw.range(0.05, 1.0) as f32 * oracle.max_speed_mm_s as f32,
        draw.range(0.05, 1.0) as f32 * oracle.max_force_n as f32,
    )
}

/// Largest RMS difference of log spectra from 10 Hz to 450 Hz, level included, dB.
fn spectral_error_db(bytes: &[u8]) -> f64 {
    let slot = load::<Fixed>(bytes);
    let oracle = Texture::new(&Asset::parse(bytes).unwrap());
    let mut draw = Draw::new(1);
    let wide = |c: &[f32]| -> Vec<f64> { c.iter().map(|&c| c.into()).collect() };
    let errors = (0..Size::asked().of(10, 200)).map(|_| {
        let (speed, force) = point(&mut draw, &oracle);
        let filter = slot.filter_at(speed, force);
        let model = oracle.model(speed.into(), force.into());
        let ours = model_power(&wide(&filter.a), &wide(&filter.b), filter.level_m_s2.into());
        let exact = model_power(
            &polynomial(&model.cosines),
            &oracle.numerator(&model),
            model.level_m_s2,
        );
        let last = ours.len() - 1;
        let band = last * 10 / 500..last * 450 / 500;
        let count = band.len() as f64;
        let difference = |(a, b): (&f64, &f64)| (10.0 * (a / b).log10()).powi(2);
        let squares = ours[band.clone()].iter().zip(&exact[band]).map(difference);
        (squares.sum::<f64>() / count).sqrt()
    });
    errors.fold(0.0, f64::max)
}

/// Levels of a steady vibration in third octaves, dB.
fn bands_db<A: RenderArithmetic>(bytes: &[u8], (speed, force): (f32, f32)) -> Vec<f64> {
    let slot = load::<A>(bytes);
    let fraction = 1.0 - (-f64::from(slot.cycle_samples()) / 5.0).exp();
    let mut vibration = Vibration::<A>::new(3);
    let signal: Vec<f64> = (0..sized("ticks of a vibration", 6_000, 60_000))
        .map(|_| {
            let (speed, force) = (Quantity::of(speed), Quantity::of(force));
            let fraction = Quantity::of(fraction as f32);
            let sounded = vibration.step(&slot, speed, force, fraction, true);
            assert!(!sounded.clamped);
            sounded.y.value().into()
        })
        .skip(100)
        .collect();
    let bands = third_octaves(16.0, RATE_HZ);
    band_levels_db(&periodogram(&signal), RATE_HZ, &bands)
}

/// Largest difference of a band between both arithmetics, dB.
fn band_error_db(bytes: &[u8]) -> f64 {
    let oracle = Texture::new(&Asset::parse(bytes).unwrap());
    let at = point(&mut Draw::new(2), &oracle);
    let [fixed, float] = [bands_db::<Fixed>(bytes, at), bands_db::<Float>(bytes, at)];
    let differences = fixed.iter().zip(&float).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

#[test]
fn the_builtin_texture() {
    let bytes = support::builtin();
    let (spectrum, bands) = (spectral_error_db(&bytes), band_error_db(&bytes));
    println!("built-in: spectra within {spectrum:.4} dB, bands within {bands:.4} dB");
    assert!(spectrum < 0.1 && bands < 0.1);
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn every_hatt_material() {
    let files = hatt::some_materials(sized("every so many materials", 5, 1));
    let errors: Vec<(String, f64, f64)> = files
        .par_iter()
        .map(|file| {
            let bytes = support::hatt(file);
            let name = file.file_stem().unwrap().to_string_lossy().into_owned();
            (name, spectral_error_db(&bytes), band_error_db(&bytes))
        })
        .collect();
    let worst = |of: fn(&(String, f64, f64)) -> f64| errors.iter().map(of).fold(0.0, f64::max);
    println!(
        "{} materials: spectra within {:.4} dB, bands within {:.4} dB",
        errors.len(),
        worst(|e| e.1),
        worst(|e| e.2)
    );
    if errors.len() == hatt::PUBLISHED {
        figures::hold_at_full(
            "fixed_point",
            "-p asperity-tests --test it fixed_point",
            [
                ("materials", errors.len().to_string()),
                ("spectra_db", figures::within(worst(|e| e.1), 3)),
                ("bands_db", figures::within(worst(|e| e.2), 3)),
            ],
        );
    }
    for (name, spectrum, bands) in errors {
        assert!(spectrum < 0.1 && bands < 0.1, "{name}: {spectrum} {bands}");
    }
}
