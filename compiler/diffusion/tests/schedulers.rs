//! DDIM and Euler against their papers' formulas, written a second time from the papers.

use asperity_diffusion::{
    Method, Problem,
    scheduler::{Config, Prediction, Schedule, Spacing},
};

/// Stable Diffusion 2 base, but for what is named.
fn config(more: &str) -> Config {
    Config::parse(&format!(
        r#"{{"_class_name": "PNDMScheduler", "beta_start": 0.00085, "beta_end": 0.012,
            "beta_schedule": "scaled_linear", "num_train_timesteps": 1000, "clip_sample": false,
            "steps_offset": 1, "set_alpha_to_one": false {more}}}"#
    ))
    .expect("a configuration")
}

/// ᾱ of Stable Diffusion as its papers state it: √β linear over 1000 steps.
fn alpha_bar(t: usize) -> f64 {
    (0..=t)
        .map(|s| {
            let root =
                0.00085_f64.sqrt() + (0.012_f64.sqrt() - 0.00085_f64.sqrt()) * s as f64 / 999.0;
            1.0 - root * root
        })
        .product()
}

/// A latent and a prediction that has nothing to do with it.
const SAMPLE: [f32; 4] = [0.3, -1.2, 2.5, 0.0];
const OUTPUT: [f32; 4] = [-0.7, 0.4, 0.1, 1.0];

fn close(found: &[f32], expected: impl Iterator<Item = f64>, bound: f64) {
    for (found, expected) in found.iter().zip(expected) {
        let error = (f64::from(*found) - expected).abs();
        assert!(
            error < bound * expected.abs().max(1.0),
            "{found} {expected}"
        );
    }
}

#[test]
fn the_noise_is_that_of_stable_diffusion() {
    let alphas = config("").alphas_cumprod;
    assert_eq!(alphas.len(), 1000);
    for t in [0, 1, 500, 999] {
        assert!((alphas[t] - alpha_bar(t)).abs() < 1e-12);
    }
    // The range of σ that k-diffusion states for Stable Diffusion.
    let sigma = |t: usize| ((1.0 - alphas[t]) / alphas[t]).sqrt();
    assert!((sigma(999) - 14.6146).abs() < 1e-4, "{}", sigma(999));
    assert!((sigma(0) - 0.0292).abs() < 1e-4, "{}", sigma(0));
}

#[test]
fn steps_are_spaced_as_the_configuration_says() {
    let steps = |more: &str, method, count| -> Vec<f64> {
        let schedule = Schedule::new(&config(more), method, count, true).expect("a schedule");
        schedule.steps.iter().map(|step| step.timestep).collect()
    };
    let leading = steps("", Method::Ddim, 50);
    assert_eq!((leading[0], leading[1], leading[49]), (981.0, 961.0, 1.0));
    let linspace = steps("", Method::Euler, 4);
    assert_eq!(linspace, [999.0, 666.0, 333.0, 0.0]);
    let trailing = steps(r#", "timestep_spacing": "trailing""#, Method::Ddim, 4);
    assert_eq!(trailing, [999.0, 749.0, 499.0, 249.0]);
    let spacing = r#", "timestep_spacing": "leading""#;
    assert_eq!(steps(spacing, Method::Euler, 50), leading);
    // Fractions are left to a UNet that takes numbers.
    let schedule = Schedule::new(&config(""), Method::Euler, 3, false).expect("a schedule");
    assert_eq!(schedule.steps[1].timestep, 499.5);
}

/// Eq. 12 of Song et al. at σ = 0, step by step.
#[test]
fn ddim_is_equation_12_of_its_paper() {
    for (prediction, set_alpha_to_one) in [
        (Prediction::Epsilon, false),
        (Prediction::Epsilon, true),
        (Prediction::Velocity, true),
    ] {
        let config = Config {
            set_alpha_to_one,
            prediction,
            ..config("")
        };
        let schedule = Schedule::new(&config, Method::Ddim, 10, true).expect("a schedule");
        assert_eq!(schedule.first_spread, 1.0);
        for (n, step) in schedule.steps.iter().enumerate() {
            let t = 901 - 100 * n;
            assert_eq!((step.timestep, step.input_scale), (t as f64, 1.0));
            let alpha = alpha_bar(t);
            let before = match (n, set_alpha_to_one) {
                (9, true) => 1.0,
                (9, false) => alpha_bar(0),
                _ => alpha_bar(t - 100),
            };
            let mut sample = SAMPLE;
            step.advance(&mut sample, &OUTPUT);
            let expected = SAMPLE.iter().zip(OUTPUT).map(|(&x, y)| {
                let (x, y) = (f64::from(x), f64::from(y));
                let epsilon = match prediction {
                    Prediction::Epsilon => y,
                    // v = √ᾱ ε − √(1−ᾱ) x₀ with x = √ᾱ x₀ + √(1−ᾱ) ε, solved for ε
                    Prediction::Velocity => alpha.sqrt() * y + (1.0 - alpha).sqrt() * x,
                };
                let predicted = (x - (1.0 - alpha).sqrt() * epsilon) / alpha.sqrt();
                before.sqrt() * predicted + (1.0 - before).sqrt() * epsilon
            });
            close(&sample, expected, 1e-6);
        }
    }
}

/// Algorithm 2 of Karras et al. without churn: d = (x − D(x; σ))/σ, x + (σ' − σ)·d.
#[test]
fn euler_is_algorithm_2_of_its_paper() {
    let sigma = |t: usize| ((1.0 - alpha_bar(t)) / alpha_bar(t)).sqrt();
    for prediction in [Prediction::Epsilon, Prediction::Velocity] {
        let config = Config {
            prediction,
            ..config("")
        };
        let schedule = Schedule::new(&config, Method::Euler, 4, true).expect("a schedule");
        assert!((schedule.first_spread - sigma(999)).abs() < 1e-9);
        for (n, step) in schedule.steps.iter().enumerate() {
            let t = 999 - 333 * n;
            let now = sigma(t);
            let after = if n == 3 { 0.0 } else { sigma(t - 333) };
            let scale = 1.0 / (now * now + 1.0).sqrt();
            assert!((step.input_scale - scale).abs() < 1e-12);
            let mut sample = SAMPLE;
            step.advance(&mut sample, &OUTPUT);
            let expected = SAMPLE.iter().zip(OUTPUT).map(|(&x, y)| {
                let (x, y) = (f64::from(x), f64::from(y));
                // With c_in·x = √ᾱ x₀ + √(1−ᾱ) ε as in the paper's table 1.
                let alpha = alpha_bar(t);
                let denoised = match prediction {
                    Prediction::Epsilon => x - now * y,
                    Prediction::Velocity => alpha.sqrt() * (scale * x) - (1.0 - alpha).sqrt() * y,
                };
                x + (after - now) * (x - denoised) / now
            });
            close(&sample, expected, 1e-6);
        }
    }
}

#[test]
fn sigmas_are_linear_between_whole_steps() {
    let schedule = Schedule::new(&config(""), Method::Euler, 3, false).expect("a schedule");
    let sigma = |t: usize| ((1.0 - alpha_bar(t)) / alpha_bar(t)).sqrt();
    let between = 0.5 * (sigma(499) + sigma(500));
    let scale = schedule.steps[1].input_scale;
    assert!((scale - 1.0 / (between * between + 1.0).sqrt()).abs() < 1e-12);
}

/// Data that are one point x₀: whatever noise it starts from, a scheduler with the right noise
/// ends at x₀.
#[test]
fn a_single_point_is_found_by_both_methods() {
    const POINT: f64 = 0.731;
    for method in [Method::Ddim, Method::Euler] {
        for spacing in [Spacing::Leading, Spacing::Linspace, Spacing::Trailing] {
            for prediction in [Prediction::Epsilon, Prediction::Velocity] {
                for count in [1, 2, 7, 50] {
                    let config = Config {
                        set_alpha_to_one: true,
                        spacing: Some(spacing),
                        prediction,
                        ..config("")
                    };
                    let schedule = Schedule::new(&config, method, count, true).expect("a schedule");
                    let mut sample = [1.3 * schedule.first_spread as f32];
                    for step in &schedule.steps {
                        let alpha = alpha_bar(step.timestep as usize);
                        let (signal, noise) = (alpha.sqrt(), (1.0 - alpha).sqrt());
                        let x = f64::from(sample[0]) * step.input_scale;
                        let epsilon = (x - signal * POINT) / noise;
                        let output = match prediction {
                            Prediction::Epsilon => epsilon,
                            Prediction::Velocity => signal * epsilon - noise * POINT,
                        };
                        step.advance(&mut sample, &[output as f32]);
                    }
                    let error = (f64::from(sample[0]) - POINT).abs();
                    // Rounding of f32, of latents up to σ = 14.6 times 1.3.
                    assert!(
                        error < 2e-5,
                        "{method} {spacing:?} {prediction:?} {count}: {error}"
                    );
                }
            }
        }
    }
}

/// Data of variance s² have a flow that is known: x(σ) grows as √(s² + σ²) (Karras et al.,
/// eq. 4). Both methods come to it with the first power of their number of steps.
#[test]
fn gaussian_data_are_followed_to_first_order() {
    const SPREAD: f64 = 0.5;
    let error = |method, count| -> f64 {
        let config = Config {
            set_alpha_to_one: true,
            spacing: Some(Spacing::Linspace),
            ..config("")
        };
        let schedule = Schedule::new(&config, method, count, true).expect("a schedule");
        let alpha = alpha_bar(999);
        let sigma = ((1.0 - alpha) / alpha).sqrt();
        let first = 0.8 * schedule.first_spread;
        let mut sample = [first as f32];
        for step in &schedule.steps {
            let alpha = alpha_bar(step.timestep as usize);
            let x = f64::from(sample[0]) * step.input_scale;
            // E[ε | x] of a Gaussian x₀.
            let variance = alpha * SPREAD * SPREAD + (1.0 - alpha);
            let epsilon = (1.0 - alpha).sqrt() * x / variance;
            step.advance(&mut sample, &[epsilon as f32]);
        }
        // DDIM's latent has unit variance: x/√ᾱ is that of the paper.
        let start = match method {
            Method::Ddim => first / alpha.sqrt(),
            Method::Euler => first,
        };
        let exact = start * SPREAD / (SPREAD * SPREAD + sigma * sigma).sqrt();
        (f64::from(sample[0]) / exact - 1.0).abs()
    };
    for method in [Method::Ddim, Method::Euler] {
        let (few, many) = (error(method, 50), error(method, 400));
        assert!(many < 0.02, "{method}: {many}");
        // Eight times the steps: an eighth of the error, at least a fifth.
        assert!(many < few / 5.0, "{method}: {few} then {many}");
    }
}

#[test]
fn what_no_schedule_can_be_made_of_is_refused() {
    let refused = |text: &str| Config::parse(text).expect_err("refused").to_string();
    for (text, says) in [
        ("7", "invalid type"),
        (r#"{"beta_schedule": "sigmoid"}"#, "beta_schedule"),
        (r#"{"prediction_type": "sample"}"#, "prediction_type"),
        (r#"{"num_train_timesteps": 1}"#, "num_train_timesteps"),
        (r#"{"num_train_timesteps": 1e30}"#, "num_train_timesteps"),
        (r#"{"num_train_timesteps": 4000000000}"#, "2 to 100000"),
        (r#"{"beta_start": -1}"#, "betas"),
        (r#"{"beta_end": 2}"#, "betas"),
        (
            r#"{"num_train_timesteps": 100000, "beta_schedule": "linear"}"#,
            "betas",
        ),
        (r#"{"trained_betas": [0.1]}"#, "trained_betas"),
        (r#"{"clip_sample": true}"#, "clip_sample"),
        (
            r#"{"rescale_betas_zero_snr": true}"#,
            "rescale_betas_zero_snr",
        ),
        (r#"{"steps_offset": 1000}"#, "steps_offset"),
        (r#"{"steps_offset": -1}"#, "steps_offset"),
    ] {
        let message = refused(text);
        assert!(message.contains(says), "{text}: {message}");
    }
    for (more, count, most) in [
        ("", 0, 500),
        ("", 1000, 500),
        (r#", "timestep_spacing": "linspace""#, 1001, 1000),
        (r#", "timestep_spacing": "trailing""#, usize::MAX, 1000),
    ] {
        let error = Schedule::new(&config(more), Method::Ddim, count, true).err();
        let expected = Problem::Steps { steps: count, most };
        assert_eq!(error, Some(expected));
        assert!(Schedule::new(&config(more), Method::Ddim, most, true).is_ok());
    }
}
