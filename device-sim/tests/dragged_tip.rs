//! The fast model of strokes over a relief, held against a ball that is dragged over it step by step.

use asperity_sim::{
    dragged_tip::{Drag, DraggedTip, RATE_HZ, Relief},
    random::unit,
};
use asperity_surface::{
    contact::{Contact, Tip},
    heights::HeightField,
    stroke::{LEAST_SPREAD_OCTAVES, Strokes},
    stylus::{Stylus, Support},
    vibration::{self, Spectrum},
    wave_spectrum::WaveSpectrum,
};
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use realfft::RealFftPlanner;
use std::f64::consts::{LN_2, PI, TAU};

const SURFACES: usize = 30;
const SIDE: usize = 512;
const PITCH_MM: f64 = 0.05;
const PERIOD_MM: f64 = SIDE as f64 * PITCH_MM;
/// Lines dragged along on every surface, and the periods of each.
const LINES: usize = 6;
const PERIODS: usize = 2;
const MODULI_MPA: [f64; 5] = [10.0, 30.0, 100.0, 1000.0, 3000.0];
/// Bands so far below the loudest count as this far below it, dB.
const RANGE_DB: f64 = 25.0;
/// The claim: so many surfaces within so much, RMS over the third octaves.
const WITHIN_DB: f64 = 4.5;
const CLAIMED: usize = 24;

type Rng = Xoshiro256PlusPlus;

fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * unit(rng)
}

/// A number whose logarithm is uniform.
fn ratio_between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(unit(rng))
}

/// Heights as a function of the place, mm.
fn drawn(height: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let at = |n: usize| height((n % SIDE) as f64 * PITCH_MM, (n / SIDE) as f64 * PITCH_MM);
    (0..SIDE * SIDE).map(at).collect()
}

/// Periodic waves of random phase, evenly over the octaves from 0.1 to 6 per mm, whose height falls as k^(−hurst); `stretch`
/// is how much longer they are in y.
fn random_field(rng: &mut Rng, hurst: f64, stretch: f64) -> Vec<f64> {
    let mut sum = vec![0.0_f32; SIDE * SIDE];
    for _ in 0..600 {
        let k = ratio_between(rng, 0.1, 6.0);
        let (direction, phase) = (TAU * unit(rng), TAU * unit(rng));
        let (k_x, k_y) = (k * direction.cos(), k * direction.sin() / stretch);
        // A whole number of waves in a period.
        let step = |per_mm: f64| TAU * (per_mm * PERIOD_MM).round() / SIDE as f64;
        let (step_x, step_y, height) = (step(k_x), step(k_y), k.powf(-hurst));
        let in_row = |n: usize| (step_x * n as f64).sin_cos();
        let row: Vec<(f32, f32)> = (0..SIDE)
            .map(in_row)
            .map(|(s, c)| (s as f32, c as f32))
            .collect();
        for (n, out) in sum.chunks_exact_mut(SIDE).enumerate() {
            let (sin, cos) = (step_y * n as f64 + phase).sin_cos();
            let (sin, cos) = ((height * sin) as f32, (height * cos) as f32);
            for (slot, (s, c)) in out.iter_mut().zip(&row) {
                *slot += cos * c - sin * s;
            }
        }
    }
    sum.into_iter().map(f64::from).collect()
}

/// A spatial frequency of a whole number of waves, of 0.5 to 4 mm, rad/mm.
fn wave(rng: &mut Rng) -> f64 {
    TAU * (PERIOD_MM / ratio_between(rng, 0.5, 4.0)).round() / PERIOD_MM
}

/// A flat land with parabolic grooves in y, of a width that is a share of their distance.
fn grooves(rng: &mut Rng) -> Vec<f64> {
    let (k, share) = (wave(rng), between(rng, 0.3, 0.8));
    drawn(|x, _| {
        let across = ((k * x / TAU).rem_euclid(1.0) - 0.5) * 2.0 / share;
        (across * across).min(1.0)
    })
}

/// Round grains on a flat ground.
fn grains(rng: &mut Rng) -> Vec<f64> {
    let count = ratio_between(rng, 60.0, 600.0) as usize;
    let radius = ratio_between(rng, 0.15, 0.6);
    let mut heights = vec![0.0_f64; SIDE * SIDE];
    for _ in 0..count {
        let (x, y) = (SIDE as f64 * unit(rng), SIDE as f64 * unit(rng));
        let radius = radius * between(rng, 0.7, 1.3) / PITCH_MM;
        let reach = radius as i64 + 1;
        let index = |at: f64, by: i64| (at as i64 + by).rem_euclid(SIDE as i64) as usize;
        for (in_y, in_x) in (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| (y, x))) {
            let away = (in_x as f64 - x.fract()).hypot(in_y as f64 - y.fract()) / radius;
            let slot = &mut heights[index(y, in_y) * SIDE + index(x, in_x)];
            *slot = slot.max(radius * (1.0 - away * away));
        }
    }
    heights
}

fn scaled(mut heights: Vec<f64>, rms: f64) -> Vec<f64> {
    let count = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / count;
    heights.iter_mut().for_each(|h| *h -= mean);
    let found = (heights.iter().map(|h| h * h).sum::<f64>() / count).sqrt();
    heights.iter().map(|h| h * rms / found).collect()
}

/// The name and the heights, µm, of a surface.
fn surface(index: usize, rng: &mut Rng) -> (&'static str, Vec<f32>) {
    let rms = ratio_between(rng, 1.0, 30.0);
    let (kind, heights) = match index % 7 {
        0 => {
            let hurst = between(rng, 0.0, 1.5);
            ("isotropic", random_field(rng, hurst, 1.0))
        }
        1 => {
            let k = wave(rng);
            ("grating", drawn(|x, _| (k * x).sin()))
        }
        2 => {
            let (k_x, k_y) = (wave(rng), wave(rng));
            ("weave", drawn(|x, y| (k_x * x).sin() + (k_y * y).sin()))
        }
        3 => ("grooves", grooves(rng)),
        4 => {
            let (hurst, stretch) = (between(rng, 0.0, 1.0), ratio_between(rng, 5.0, 30.0));
            ("brushed", random_field(rng, hurst, stretch))
        }
        5 => ("grains", grains(rng)),
        _ => {
            let (hurst, k, share) = (between(rng, 0.0, 1.5), wave(rng), between(rng, 0.2, 1.0));
            let rough = scaled(random_field(rng, hurst, 1.0), share);
            let grating = drawn(|x, y| (k * x).sin() * (0.5 * k * y).cos());
            let both = rough.iter().zip(grating).map(|(a, b)| a + b);
            ("mixture", both.collect())
        }
    };
    let heights = scaled(heights, rms);
    (kind, heights.iter().map(|h| *h as f32).collect())
}

/// Spectrum of the drags, (m/s²)²/Hz, as averaged Hann periodograms of one period each. A model draws no line narrower than
/// [`LEAST_SPREAD_OCTAVES`]; every bin is drawn here with the same kernel, so that both are equally smooth.
fn measured(drags: &[Drag], speed_mm_s: f64) -> Spectrum {
    let block = (PERIOD_MM / speed_mm_s * RATE_HZ).round() as usize;
    let forward = RealFftPlanner::<f64>::new().plan_fft_forward(block);
    let hann = |n: usize| (PI * (n as f64 + 0.5) / block as f64).sin().powi(2);
    let window: Vec<f64> = (0..block).map(hann).collect();
    let square: f64 = window.iter().map(|w| w * w).sum();
    let (mut input, mut output) = (forward.make_input_vec(), forward.make_output_vec());
    let (mut bins, mut blocks) = (vec![0.0; output.len()], 0.0);
    for drag in drags {
        for signal in drag.acceleration_m_s2.windows(block).step_by(block / 2) {
            for ((slot, a), w) in input.iter_mut().zip(signal).zip(&window) {
                *slot = a * w;
            }
            forward
                .process(&mut input, &mut output)
                .expect("lengths of the plan");
            for (bin, wave) in bins.iter_mut().zip(&output) {
                *bin += 2.0 * wave.norm_sqr() / (square * block as f64);
            }
            blocks += 1.0;
        }
    }
    let mut power = [0.0; vibration::POINTS];
    for (n, bin) in (0..).map(f64::from).zip(&bins).skip(1) {
        let (centre, spread) = ((n * RATE_HZ / block as f64).log2(), ((n + 1.0) / n).log2());
        let spread = spread.max(LEAST_SPREAD_OCTAVES);
        for (point, slot) in power.iter_mut().enumerate() {
            let freq_hz = vibration::freq_hz(point);
            let away = (freq_hz.log2() - centre) / spread;
            let per_octave = bin / blocks * (-0.5 * away * away).exp() / (spread * TAU.sqrt());
            *slot += per_octave / (freq_hz * LN_2);
        }
    }
    power
}

/// RMS of the levels' differences, dB, and the row of the table.
fn compare(index: usize) -> (f64, String) {
    let mut rng = Rng::seed_from_u64(index as u64);
    let (kind, heights_um) = surface(index, &mut rng);
    let speed_mm_s = ratio_between(&mut rng, 40.0, 200.0);
    let support = Support {
        modulus_mpa: MODULI_MPA[index % MODULI_MPA.len()],
        loss_factor: 0.0,
        force_n: ratio_between(&mut rng, 0.4, 2.4),
    };
    let contact_mm = Tip::STYLUS.contact_mm(&support);
    let tip = DraggedTip {
        radius_mm: Tip::STYLUS.radius_mm,
        force_n: support.force_n,
        contact_mm,
        resonance_hz: Stylus::CALIBRATED.resonance_hz(&support),
        damping_ratio: Stylus::CALIBRATED.hand_damping,
    };
    let relief = Relief::new(SIDE, [PITCH_MM; 2], &heights_um);
    let duration_s = PERIODS as f64 * PERIOD_MM / speed_mm_s;
    let drags: Vec<Drag> = (0..LINES)
        .map(|line| (line as f64 + unit(&mut rng)) * PERIOD_MM / LINES as f64)
        .map(|y_mm| tip.drag(&relief, y_mm, speed_mm_s, duration_s))
        .collect();
    let field = HeightField::new(SIDE, [PITCH_MM; 2], heights_um).expect("a field");
    let waves =
        WaveSpectrum::of(&Contact::with(&field.levelled()).followed(&Tip::STYLUS, &support));
    let model = Strokes::over(&waves.along(0.0)).power(speed_mm_s, &support);
    let [model, simulated] =
        [model, measured(&drags, speed_mm_s)].map(|power| vibration::bands_db(&power));
    let loudest = simulated.iter().copied().fold(f64::MIN, f64::max);
    let heard = |db: f64| db.max(loudest - RANGE_DB);
    let pairs = simulated.iter().zip(&model);
    let differences: Vec<f64> = pairs.map(|(a, b)| heard(*a) - heard(*b)).collect();
    let count = differences.len() as f64;
    let mean_db = differences.iter().sum::<f64>() / count;
    let rms_db = (differences.iter().map(|d| d * d).sum::<f64>() / count).sqrt();
    let lost = drags.iter().map(|drag| drag.lost).sum::<f64>() / LINES as f64;
    let (modulus_mpa, force_n, rms_um) = (support.modulus_mpa, support.force_n, field.rms_um());
    let row = format!(
        "{index:2} {kind:9} {rms_um:5.1} {speed_mm_s:5.0} {force_n:5.2} {modulus_mpa:5.0} \
         {loudest:8.1} {rms_db:6.1} {mean_db:5.1} {lost:5.3}\n"
    );
    (rms_db, row)
}

#[test]
fn the_model_of_strokes_is_within_4_5_db_of_the_simulated_ball_on_24_of_30_surfaces() {
    let mut table =
        String::from(" n kind      rms/µm mm/s    N   MPa  loudest/dB rms/dB mean/dB lost\n");
    let mut within = 0;
    for (rms_db, row) in (0..SURFACES).map(compare) {
        within += usize::from(rms_db <= WITHIN_DB);
        table.push_str(&row);
    }
    println!("{table}");
    assert!(
        within >= CLAIMED,
        "{within} of {SURFACES} within {WITHIN_DB} dB\n{table}"
    );
}
