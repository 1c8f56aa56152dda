//! A friction that falls with speed, through the whole tick: what it gives off, and a hand on it.

use super::{FAST_HZ, NOTHING, TICK_S, TOUCH};
use super::{energy_of_cycles, law::Law, rest::flips_at_rest, rest::rest_in_a_hand};
use crate::stability::material::Material;
use asperity::model::{FrictionLaw, LawPoint};
use asperity_runtime::{Config, Renderer, Sample, State};
use asperity_sim::device::DeviceConfig;
use asperity_sim::hand::{Grip, GripPreset, Motion, Script};
use asperity_sim::servo::RenderedTexture;
use asperity_sim::session::Session;

/// Stiffness of the wall, N/m.
const STIFFNESS_N_M: f64 = 500.0;

/// A silent surface with a μ of 0.7 at rest that a law multiplies.
fn material(points: &[(f64, f64)]) -> Material {
    let mut model = Material::silent(STIFFNESS_N_M, 0.1)
        .expect("built in")
        .model;
    model.friction.mu = 0.7;
    let points = points
        .iter()
        .map(|&(speed_mm_s, factor)| LawPoint { speed_mm_s, factor });
    model.friction.law = FrictionLaw::through(points.collect());
    Material::new(model).expect("lowered")
}

/// Falls from 0.7 at 20 mm/s to 0.3, as a Stribeck law of 40 mm/s does.
fn stribeck() -> Material {
    let factor = |v: f64| (0.3 + 0.4 * (-(v - 20.0) / 40.0).exp()) / 0.7;
    material(&[20.0, 30.0, 45.0, 60.0, 80.0, 110.0, 150.0, 220.0].map(|v| (v, factor(v))))
}

/// Falls from 1.4 to nothing within a sixteenth of a millimetre per second.
fn cliff() -> Material {
    material(&[(20.0, 2.0), (20.0625, 0.0)])
}

fn renderer(delay_ticks: u32) -> Renderer {
    let mut config = Config::default();
    config.mechanics.delay_ticks = delay_ticks;
    Renderer::new(&config).expect("a valid configuration")
}

/// Friction along x of whole ticks.
fn law(material: &Material, delay_ticks: u32) -> Law {
    let (renderer, slot, mut state) = (renderer(delay_ticks), material.slot.clone(), State::new(1));
    Box::new(move |x, normal_n| {
        let depth_m = normal_n / STIFFNESS_N_M;
        let sample = Sample::at([x as f32, 0.0, -depth_m as f32]);
        let output = renderer.tick(&slot, &mut state, &sample);
        f64::from(output.force_n[0])
    })
}

#[test]
fn a_falling_law_gives_off_no_more_than_the_device_absorbs() {
    let slow_hz = [0.5, 1.0, 2.0, 5.0, 10.0];
    for material in [stribeck(), cliff()] {
        let given = |delay: u32, hz: &[f64], absorber| {
            1e6 * energy_of_cycles(|| law(&material, delay), delay as usize, hz, absorber)
        };
        // The limits of friction without a law, µJ.
        let slow = given(0, &slow_hz, &NOTHING);
        assert!(slow < 1e-3, "{slow} µJ to a device that absorbs nothing");
        for delay in [0, 1, 2] {
            let fast = given(delay, &FAST_HZ, &TOUCH);
            assert!(fast < 1e-3, "{delay} ticks of delay: {fast} µJ");
        }
    }
}

#[test]
fn a_falling_law_does_not_chatter_at_rest() {
    for material in [stribeck(), cliff()] {
        assert_eq!(flips_at_rest(&mut law(&material, 0), 1), 0.0);
        let renderer = renderer(0);
        let speed = rest_in_a_hand(RenderedTexture::new(renderer, &material.slot, 1)).unwrap();
        // The limit of friction without a law, mm/s.
        assert!(speed <= 0.1, "{speed} mm/s about the mean");
    }
}

/// Strokes of a light grip at 1 N. Where the law falls gently, speed stays the hand's own. Where it falls
/// by more than the hand's damping, the hand sticks and slips, and slides on.
#[test]
fn a_hand_slides_over_a_falling_law() {
    let wobble = |material: &Material, speed_m_s: f64| {
        let device = DeviceConfig::touch().expect("built in");
        let grip = Grip::preset(GripPreset::Light).expect("built in");
        let script = Script::new(vec![Motion::Stroke {
            to_m: [0.06, 0.0],
            speed_m_s,
            force_n: 1.0,
        }]);
        let servo = RenderedTexture::new(renderer(0), &material.slot, 1);
        let mut session = Session::new(&device, grip, script, servo);
        let records = session.run(20_000);
        let speeds: Vec<f64> = records.iter().map(|r| r.true_m_s[0]).collect();
        let sliding: Vec<f64> = speeds
            .into_iter()
            .filter(|v| *v > 0.3 * speed_m_s)
            .collect();
        let middle = &sliding[sliding.len() / 4..3 * sliding.len() / 4];
        let mean = middle.iter().sum::<f64>() / middle.len() as f64;
        let square = middle.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        (
            (square / middle.len() as f64).sqrt() / mean,
            middle.len() as f64 * TICK_S,
        )
    };
    // Falls as v^−0.1: by 2.5 N·s/m at 1 N and 30 mm/s, where the other falls by 7.8.
    let gentle =
        material(&[20.0, 40.0, 80.0, 160.0, 320.0].map(|v: f64| (v, (v / 60.0).powf(-0.1))));
    let plain = material(&[]);
    for speed_m_s in [0.03, 0.05, 0.08, 0.12] {
        let [plain, gentle, steep] =
            [&plain, &gentle, &stribeck()].map(|material| wobble(material, speed_m_s));
        println!("{speed_m_s} m/s: {plain:?} without a law, {gentle:?} gentle, {steep:?} steep");
        // A fast stroke ends before the hand has settled, with a law or without.
        assert!(gentle.0 < plain.0 + 0.025, "{speed_m_s} m/s: {gentle:?}");
        assert!(steep.1 > 0.9 * plain.1, "{speed_m_s} m/s: {steep:?}");
        let sticks = steep.0 > 0.3;
        assert!(sticks || speed_m_s > 0.05, "{speed_m_s} m/s: {steep:?}");
    }
}
