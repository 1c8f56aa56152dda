//! Shared state across textures and renderers, without a scene or an exchange; and models slower
//! than the loop.

use asperity_formats::Asset;
use asperity_runtime::{
    Config, Exchange, Fixed, Flags, Float, HostCapacities, RenderArithmetic, Renderer, Sample,
    State, arithmetic::Scalar as _, stage::vibration::LAG_SAMPLES,
};
use asperity_tests::texture::{HostSlot, Texture, TextureKind, random};
use std::mem::MaybeUninit;

const DEPTH_M: f32 = 1e-3;

fn texture(seed: u64, order: usize, stiffness_n_m: f32, sigma_m_s2: f32) -> Texture {
    let mut texture = random(seed, TextureKind::nyquist(order));
    texture.coupling.stiffness_n_m = stiffness_n_m;
    for vertex in &mut texture.vertices {
        vertex.sigma_m_s2 = sigma_m_s2;
    }
    texture
}

fn loaded<A: RenderArithmetic>(texture: &Texture, rate_hz: f32) -> Box<HostSlot<A>> {
    let mut slot = Box::new(HostSlot::new());
    slot.load(&Asset::parse(&texture.encode()).unwrap(), rate_hz)
        .unwrap();
    slot
}

/// A circle at 0.1 m/s, in contact.
fn stroke(rate_hz: f32, n: usize) -> Sample {
    let angle = n as f32 * 5.0 / rate_hz;
    Sample::at([0.02 * angle.cos(), 0.02 * angle.sin(), -DEPTH_M])
}

#[test]
fn a_plain_tick_on_another_texture_has_its_wall_at_once_and_falls_silent_first() {
    fn check<A: RenderArithmetic>() {
        let renderer = Renderer::<A>::prepare(&Config::default()).unwrap();
        let (a, b) = (
            loaded::<A>(&texture(1, 8, 500.0, 0.5), 1000.0),
            loaded::<A>(&texture(2, 8, 300.0, 0.5), 1000.0),
        );
        let mut state = State::new(1);
        let mut tick = |slot: &HostSlot<A>, n| {
            let output = renderer.tick(slot, &mut state, &Sample::of(&stroke(1000.0, n)));
            (output.normal_force_n.value(), output.vib_m_s2.value())
        };
        let near = |found: f32, wanted: f32| (found - wanted).abs() < 2e-5;
        let mut loud = 0.0_f32;
        for n in 0..400 {
            let (spring_n, y) = tick(&a, n);
            assert!(near(spring_n, 0.5), "{n}: {spring_n}");
            loud = loud.max(y.abs());
        }
        assert!(loud > 0.1, "{loud}");
        let mut heard = Vec::new();
        for n in 400..450 {
            let (spring_n, y) = tick(&b, n);
            assert!(near(spring_n, 0.3), "{n}: {spring_n}");
            heard.push(y != 0.0);
        }
        // Silence until the model of the new texture is made, in four to six ticks.
        let silent = heard.iter().take_while(|heard| !**heard).count();
        assert!((3..=6).contains(&silent), "{heard:?}");
        assert!(heard[silent..].iter().filter(|heard| **heard).count() > 40);
    }
    check::<Float>();
    check::<Fixed>();
}

/// A device that bears less takes the state over.
#[test]
fn another_renderer_lowers_the_wall_within_eight_samples() {
    let mut weak = Config::default();
    (weak.mechanics.damping_n_s_m, weak.mechanics.coulomb_n) = (0.05, 0.05);
    let [strong, weak] = [Config::default(), weak].map(|c| Renderer::<Float>::prepare(&c).unwrap());
    let slot = loaded::<Float>(&texture(1, 8, 500.0, 0.1), 1000.0);
    let borne = weak.wall(&slot.coupling()).stiffness.value();
    assert!(borne < 400.0);
    let mut state = State::new(1);
    for n in 0..100 {
        let output = strong.tick(&slot, &mut state, &stroke(1000.0, n));
        assert_eq!(output.normal_force_n, 500.0 * DEPTH_M);
    }
    let found: Vec<_> = (100..120)
        .map(|n| {
            weak.tick(&slot, &mut state, &stroke(1000.0, n))
                .normal_force_n
        })
        .collect();
    let kept = found.iter().take_while(|f| **f == 500.0 * DEPTH_M).count();
    assert!(kept <= 8, "{found:?}");
    assert!(
        found[kept..].iter().all(|f| *f == borne * DEPTH_M),
        "{found:?}"
    );
}

#[test]
fn a_state_made_in_place_is_a_new_state() {
    let mut memory = MaybeUninit::uninit();
    let state: &mut State = State::init(&mut memory, 9);
    assert_eq!(*state, State::new(9));
    assert_ne!(*state, State::new(10));
}

/// A contact is heard at the earliest when a query taken in it takes effect, and at the latest a lag after it began.
#[test]
fn a_contact_is_silent_until_a_query_of_its_own_takes_effect() {
    fn check<A: RenderArithmetic>() {
        for ticks in [1_u8, 2, 3, 7] {
            let rate_hz = 1000.0 * f32::from(ticks);
            let config = Config {
                servo_rate_hz: rate_hz,
                ..Config::default()
            };
            let renderer = Renderer::<A>::prepare(&config).unwrap();
            let slot = loaded::<A>(&texture(1, 8, 500.0, 0.5), rate_hz);
            for begins in 300..300 + 8 * usize::from(ticks) {
                let mut state = State::new(1);
                let mut first = None;
                for n in 0..begins + 30 * usize::from(ticks) {
                    let mut sample = stroke(rate_hz, n);
                    if n < begins {
                        sample.position_m[2] = 0.0;
                    }
                    let output = renderer.tick(&slot, &mut state, &Sample::of(&sample));
                    let heard = output.vib_m_s2.value() != 0.0;
                    assert_eq!(output.flags.contains(Flags::CONTACT), n >= begins);
                    assert!(!heard || n > begins, "{ticks} {n}");
                    if heard && first.is_none() {
                        first = Some(n - begins);
                    }
                }
                let first = first.unwrap() as f32 / f32::from(ticks);
                // Order 8 works for four samples, the query's own included.
                assert!(
                    (2.0..=LAG_SAMPLES as f32 + 1.0).contains(&first),
                    "{ticks} {begins}: {first}"
                );
            }
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// Where models are slower than the loop, the old vibration rings out in the upsampler.
#[test]
fn slow_models_hand_over_within_the_lag_and_ring_out() {
    for ticks in [2_u8, 5] {
        let rate_hz = 1000.0 * f32::from(ticks);
        let config = Config {
            servo_rate_hz: rate_hz,
            ..Config::default()
        };
        let renderer = Renderer::new(&config).unwrap();
        let per_sample = usize::from(ticks);
        for phase in 0..8 * per_sample {
            let mut playing = loaded::<Float>(&texture(1, 8, 500.0, 0.5), rate_hz);
            let mut spare = Box::new(HostSlot::<Float>::new());
            let silent = texture(2, 8, 500.0, 0.0).encode();
            let mut exchange = Exchange::<HostCapacities, Float>::new();
            let (mut preparer, mut player) = exchange.split(&mut playing, [&mut spare], 1);
            let sent = 400 + phase;
            let heard: Vec<f32> = (0..sent + 60 * per_sample)
                .map(|n| {
                    if n == sent {
                        let next = Asset::parse(&silent).unwrap();
                        preparer.prepare(&next, rate_hz).unwrap();
                    }
                    let output = renderer.tick_player(&mut player, &stroke(rate_hz, n));
                    output.vib_m_s2.abs()
                })
                .collect();
            let most = |from: usize, to: usize| {
                let part = &heard[sent + from * per_sample..sent + to * per_sample];
                part.iter().copied().fold(0.0, f32::max)
            };
            assert!(most(0, 3) > 0.05, "{ticks} {phase}: it goes on at first");
            let (late, later) = (most(20, 40), most(40, 60));
            assert!(late < 0.1 * most(0, 3), "{ticks} {phase}: {late}");
            assert!(later < 0.02 * most(0, 3), "{ticks} {phase}: {later}");
        }
    }
}
