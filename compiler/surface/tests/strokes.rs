//! Strokes over surfaces of known spectra, against the closed form.

use asperity_surface::{
    contact::{Contact, Tip, disc_power},
    heights::HeightField,
    stroke::{LEAST_SPREAD_OCTAVES, Strokes},
    stylus::{Stylus, Support},
    vibration::{self, POINTS, Spectrum, bands_db},
    wave_spectrum::WaveSpectrum,
};
use std::{
    collections::BTreeSet,
    f64::consts::{LN_2, PI, TAU},
};

const SIDE: usize = 512;
const PITCH_MM: f64 = 0.05;
const SUPPORT: Support = Support {
    modulus_mpa: 300.0,
    loss_factor: 0.1,
    force_n: 1.0,
};

fn strokes(heights: Vec<f32>, direction_rad: f64) -> Strokes {
    let field = HeightField::new(SIDE, [PITCH_MM; 2], heights).unwrap();
    let followed = Contact::with(&field.levelled()).followed(&Tip::STYLUS, &SUPPORT);
    Strokes::over(&WaveSpectrum::of(&followed).along(direction_rad))
}

fn level_db(power: &Spectrum) -> f64 {
    10.0 * (500.0 / POINTS as f64 * power.iter().sum::<f64>()).log10()
}

/// A wave: its spatial frequency in x and, down the rows, in y, 1/mm, and its power, µm².
type Wave = ([f64; 2], f64);

/// Waves in all directions, evenly over the octaves from 0.2 to 8 per mm, with the power k^−2 an octave.
fn isotropic(height_um: f64) -> Vec<Wave> {
    const WAVES: u32 = 1200;
    let wave = |n: u32| {
        let k = 0.2 * (40.0_f64.log2() * (f64::from(n) + 0.5) / f64::from(WAVES)).exp2();
        // The golden angle spreads directions evenly; a whole number of waves fits the field.
        let angle = 2.399_963 * f64::from(n);
        let period_mm = SIDE as f64 * PITCH_MM;
        let whole = |part: f64| (k * part * period_mm).round() / period_mm;
        let power = (height_um / k).powi(2) / f64::from(WAVES);
        ([whole(angle.cos()), whole(angle.sin())], power)
    };
    // Those that another one equals would interfere.
    let mut met = BTreeSet::new();
    let is_new = |([x, y], _): &Wave| {
        let [x, y] = [x, y].map(|k| (k * SIDE as f64 * PITCH_MM).round() as i32);
        met.insert((x, y).max((-x, -y)))
    };
    (0..WAVES).map(wave).filter(is_new).collect()
}

fn drawn(waves: &[Wave]) -> Vec<f32> {
    let mut heights = vec![0.0_f32; SIDE * SIDE];
    for (n, ([x, y], power)) in waves.iter().enumerate() {
        let height = (2.0 * power).sqrt();
        let turned = |per_mm: f64, at: usize| f64::sin_cos(TAU * per_mm * at as f64 * PITCH_MM);
        let row: Vec<(f32, f32)> = (0..SIDE)
            .map(|at| turned(*x, at))
            .map(|(sin, cos)| (sin as f32, cos as f32))
            .collect();
        for (at, out) in heights.chunks_exact_mut(SIDE).enumerate() {
            let (sin, cos) = f64::sin_cos(TAU * y * at as f64 * PITCH_MM + 12.0 * n as f64);
            let (sin, cos) = ((height * sin) as f32, (height * cos) as f32);
            for (slot, (s, c)) in out.iter_mut().zip(&row) {
                *slot += cos * c - sin * s;
            }
        }
    }
    heights
}

/// Claim: a surface of a known spectrum, flat enough for the tip to follow, vibrates within 1 dB of theory in third octaves.
#[test]
fn random_surfaces_are_as_theory_has_them() {
    let contact_mm = Tip::STYLUS.contact_mm(&SUPPORT);
    let waves = isotropic(0.05);
    let heights = drawn(&waves);
    for (direction_rad, speed_mm_s) in [(0.0, 60.0), (0.7, 100.0), (0.5 * PI, 150.0)] {
        let strokes = strokes(heights.clone(), direction_rad);
        let end_hz = 0.7 * speed_mm_s * strokes.measured_to_per_mm();
        let found = strokes.power(speed_mm_s, &SUPPORT);
        let (sin, cos) = f64::sin_cos(direction_rad);
        let mut theory = [0.0; POINTS];
        for ([x, y], power) in &waves {
            let met = (cos * x - sin * y).abs();
            let averaged = power * disc_power(x.hypot(*y), contact_mm);
            for (point, slot) in theory.iter_mut().enumerate() {
                let freq_hz = vibration::freq_hz(point);
                // A line, drawn as wide as the model draws it.
                let away = (freq_hz / speed_mm_s / met).log2() / LEAST_SPREAD_OCTAVES;
                if away.abs() < 4.0 {
                    let line = (-0.5 * away * away).exp() / (LEAST_SPREAD_OCTAVES * TAU.sqrt());
                    *slot += 1e-12 * averaged * (TAU * met * speed_mm_s).powi(4) * line
                        / (freq_hz * LN_2)
                        * Stylus::CALIBRATED.transmission(&SUPPORT, freq_hz);
                }
            }
        }
        let centres_hz = (16..=26).map(|tenths| 10.0_f64.powf(f64::from(tenths) / 10.0));
        let measured = centres_hz.take_while(|hz| *hz < end_hz).count();
        assert!(measured > 8);
        let bands = bands_db(&found).into_iter().zip(bands_db(&theory));
        for (found, theory) in bands.take(measured) {
            assert!(
                (found - theory).abs() < 1.0,
                "{speed_mm_s} mm/s: {found} dB, {theory} dB"
            );
        }
    }
}

/// Claim: nothing vibrates on a flat or a tilted surface; twice the heights are 6 dB, where the tip follows both.
#[test]
fn strokes_are_linear_in_small_heights() {
    let tilted = (0..SIDE * SIDE).map(|n| (n % SIDE) as f32).collect();
    let silent = strokes(tilted, 0.0).power(100.0, &SUPPORT);
    assert!(level_db(&silent) < -80.0, "{}", level_db(&silent));
    let heights = drawn(&isotropic(0.05));
    let level = |factor: f32| {
        let scaled = heights.iter().map(|h| factor * h).collect();
        level_db(&strokes(scaled, 0.0).power(100.0, &SUPPORT))
    };
    let more_db = level(2.0) - level(1.0);
    assert!((more_db - 6.02).abs() < 0.1, "{more_db}");
}

/// Claim: sharp valleys that the ball cannot enter are felt as shallower ones.
#[test]
fn a_ball_does_not_enter_narrow_valleys() {
    let grating = |height_um: f64| {
        let wave = |n: usize| (TAU * (n % SIDE) as f64 / 8.0).sin();
        (0..SIDE * SIDE)
            .map(|n| (height_um * wave(n)) as f32)
            .collect::<Vec<_>>()
    };
    let support = Support {
        modulus_mpa: 1e5,
        ..SUPPORT
    };
    let rms = |height_um: f64| {
        let field = HeightField::new(SIDE, [PITCH_MM; 2], grating(height_um)).unwrap();
        Contact::with(&field)
            .followed(&Tip::STYLUS, &support)
            .levelled()
            .rms_um()
    };
    // The sag of the ball over half a period is 12.5 µm.
    assert!((rms(1e-3) / 1e-3 / rms(1e-4) * 1e-4 - 1.0).abs() < 0.01);
    assert!(rms(100.0) < 4.2, "{}", rms(100.0));
}
