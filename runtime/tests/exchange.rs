//! From one texture to the next while the servo loop runs: wall and friction go by the same share of what is left in every
//! tick, the old vibration fades by a quarter a tick, and slots take turns.

use asperity_formats::Asset;
use asperity_runtime::{
    Config, Exchange, Fixed, Flags, Float, HostCapacities, LoadError, Output, Player, PrepareError,
    Preparer, RenderArithmetic, Renderer, Sample, State, arithmetic::Scalar as _,
};
use asperity_tests::{
    texture::{HostSlot, Texture, TextureKind, random},
    trajectory::strokes,
};
use std::mem::MaybeUninit;

type Host = HostCapacities;

const DEPTH_M: f32 = 1e-3;

/// A texture of this stiffness, and this loud wherever it is touched.
fn texture(seed: u64, stiffness_n_m: f32, sigma_m_s2: f32) -> Texture {
    let mut texture = random(seed, TextureKind::nyquist(8));
    texture.coupling.stiffness_n_m = stiffness_n_m;
    for vertex in &mut texture.vertices {
        vertex.sigma_m_s2 = sigma_m_s2;
    }
    texture
}

fn loaded<A: RenderArithmetic>(texture: &Texture) -> Box<HostSlot<A>> {
    let mut slot = Box::new(HostSlot::new());
    slot.load(&Asset::parse(&texture.encode()).unwrap(), 1000.0)
        .unwrap();
    slot
}

fn empty<A: RenderArithmetic>() -> Box<HostSlot<A>> {
    Box::new(HostSlot::new())
}

/// At rest in contact: `count` ticks on the first texture; then whatever `send` prepares before
/// each tick.
fn at_rest<A: RenderArithmetic>(
    config: &Config,
    first: &Texture,
    count: usize,
    mut send: impl FnMut(usize, &mut Preparer<'_, '_, Host, A>),
) -> Vec<Output<A>> {
    let renderer = Renderer::<A>::prepare(config).unwrap();
    let (mut playing, mut a, mut b) = (loaded(first), empty(), empty());
    let mut exchange = Exchange::<Host, A>::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut a, &mut b], 1);
    let sample = Sample::of(&Sample::at([0.0, 0.0, -DEPTH_M]));
    (0..count)
        .map(|n| {
            send(n, &mut preparer);
            renderer.tick_player(&mut player, &sample)
        })
        .collect()
}

fn springs<A: RenderArithmetic>(outputs: &[Output<A>]) -> Vec<f64> {
    let spring = |o: &Output<A>| f64::from(o.normal_force_n.value());
    outputs.iter().map(spring).collect()
}

/// With a time constant τ a tick goes 1 − e^(−T/τ) of the way.
#[test]
fn a_wall_goes_to_its_new_stiffness_by_the_same_share_in_every_tick() {
    fn check<A: RenderArithmetic>(within_n: f64) {
        for (constant_s, from, to) in [
            (0.005, 400.0, 200.0),
            (0.02, 200.0, 400.0),
            (0.001, 300.0, 500.0),
        ] {
            let config = Config {
                parameter_time_constant_s: constant_s,
                ..Config::default()
            };
            let next = texture(2, to, 0.0).encode();
            let outputs = at_rest::<A>(&config, &texture(1, from, 0.0), 600, |n, preparer| {
                if n == 300 {
                    preparer
                        .prepare(&Asset::parse(&next).unwrap(), 1000.0)
                        .unwrap();
                }
            });
            let (from, to) = (f64::from(from * DEPTH_M), f64::from(to * DEPTH_M));
            let left = (-1e-3 / f64::from(constant_s)).exp();
            for (n, found) in springs(&outputs).into_iter().enumerate().skip(290) {
                let gone = n as i32 - 299;
                let wanted = if gone > 0 {
                    to + (from - to) * left.powi(gone)
                } else {
                    from
                };
                assert!((found - wanted).abs() < within_n, "{n}: {found} {wanted}");
            }
        }
    }
    check::<Float>(2e-6);
    check::<Fixed>(1e-3);
}

#[test]
fn without_a_time_constant_another_wall_is_there_at_once_and_exactly() {
    let config = Config {
        parameter_time_constant_s: 0.0,
        ..Config::default()
    };
    let next = texture(2, 300.0, 0.0).encode();
    let outputs = at_rest::<Float>(&config, &texture(1, 500.0, 0.0), 20, |n, preparer| {
        if n == 10 {
            preparer
                .prepare(&Asset::parse(&next).unwrap(), 1000.0)
                .unwrap();
        }
    });
    for (n, output) in outputs.iter().enumerate() {
        let stiffness = if n < 10 { 500.0 } else { 300.0 };
        assert_eq!(output.normal_force_n, stiffness * DEPTH_M, "{n}");
    }
}

#[test]
fn a_stylus_in_the_air_finds_the_new_wall_as_it_is() {
    let renderer = Renderer::new(&Config::default()).unwrap();
    let mut slots = [texture(1, 500.0, 0.0), texture(2, 200.0, 0.0)].map(|t| loaded::<Float>(&t));
    let next = texture(2, 200.0, 0.0).encode();
    let [playing, spare] = &mut slots;
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(playing, [spare], 1);
    let mut tick = |z_m: f32| renderer.tick_player(&mut player, &Sample::at([0.0, 0.0, z_m]));
    for _ in 0..50 {
        tick(0.01);
    }
    preparer
        .prepare(&Asset::parse(&next).unwrap(), 1000.0)
        .unwrap();
    tick(0.01);
    tick(0.01);
    assert_eq!(tick(-DEPTH_M).normal_force_n, 200.0 * DEPTH_M);
}

/// A constant stroke over a circle, so that the vibration never pauses.
fn stroke(count: usize) -> Vec<Sample> {
    let at = |n: usize| {
        let angle = n as f32 * 5e-3;
        Sample::at([0.02 * angle.cos(), 0.02 * angle.sin(), -DEPTH_M])
    };
    (0..count).map(at).collect()
}

/// Plays a stroke, sending textures before given ticks; the vibration of each tick, and whether
/// each change of texture was under way by then.
fn vibration<A: RenderArithmetic>(
    first: &Texture,
    sends: &[(usize, Vec<u8>)],
    count: usize,
) -> (Vec<f32>, Vec<f32>) {
    let renderer = Renderer::<A>::prepare(&Config::default()).unwrap();
    let (mut playing, mut a, mut b) = (loaded(first), empty(), empty());
    let mut exchange = Exchange::<Host, A>::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut a, &mut b], 1);
    let (mut heard, mut stiffness) = (Vec::new(), Vec::new());
    for (n, sample) in stroke(count).iter().enumerate() {
        for (_, bytes) in sends.iter().filter(|(at, _)| *at == n) {
            let asset = Asset::parse(bytes).unwrap();
            preparer.prepare(&asset, 1000.0).unwrap();
        }
        let output = renderer.tick_player(&mut player, &Sample::of(sample));
        heard.push(output.vib_m_s2.value());
        stiffness.push(player.texture().coupling().stiffness_n_m);
    }
    (heard, stiffness)
}

/// The place where a silent texture has begun: from here on every sample is ¾ of the one before.
fn fades_from(heard: &[f32], sent: usize, within: f32) -> usize {
    let fades = |n: usize| (heard[n] - 0.75 * heard[n - 1]).abs() <= within;
    let begun = (sent..heard.len()).find(|&n| (n..n + 8).all(fades));
    begun.expect("it fades")
}

#[test]
fn the_old_vibration_sounds_until_the_new_model_is_made_and_then_fades_by_a_quarter_a_tick() {
    fn check<A: RenderArithmetic>(step: f32) {
        let (loud, silent) = (texture(1, 500.0, 0.5), texture(2, 500.0, 0.0));
        let sent = 400;
        let (alone, _) = vibration::<A>(&loud, &[], 600);
        let (heard, _) = vibration::<A>(&loud, &[(sent, silent.encode())], 600);
        assert_eq!(heard[..sent], alone[..sent]);
        let begun = fades_from(&heard, sent, step);
        // Four to six ticks make a model.
        assert!((sent + 3..=sent + 10).contains(&begun), "{begun}");
        assert!(heard[begun - 1].abs() > 0.02, "{}", heard[begun - 1]);
        for n in begun..begun + 20 {
            let wanted = 0.75 * heard[n - 1];
            assert!((heard[n] - wanted).abs() <= step, "{n}");
        }
        assert!(heard[begun + 120..].iter().all(|y| y.abs() <= step));
    }
    check::<Float>(1e-7);
    check::<Fixed>(3e-5);
}

/// Models at half the rate have another clock, so nothing of the old vibration can go on.
#[test]
fn a_texture_of_another_rate_ends_the_old_vibration_at_once() {
    let loud = texture(1, 500.0, 0.5);
    let mut slow = texture(2, 500.0, 0.0);
    slow.sample_rate_hz = 500.0;
    let sent = 400;
    let (heard, _) = vibration::<Float>(&loud, &[(sent, slow.encode())], 500);
    assert!(heard[sent - 1].abs() > 0.02);
    assert_eq!(fades_from(&heard, sent, 1e-7), sent);
}

/// Two textures are sent at once. The second waits until nothing is left of the first change.
#[test]
fn a_slot_waits_while_another_change_is_under_way() {
    fn check<A: RenderArithmetic>() {
        let loud = texture(1, 500.0, 0.5);
        let sent = 400;
        let sends = [
            (sent, texture(2, 400.0, 0.0).encode()),
            (sent, texture(3, 300.0, 0.0).encode()),
        ];
        let (heard, stiffness) = vibration::<A>(&loud, &sends, 700);
        assert_eq!(stiffness[sent - 1], 500.0);
        assert_eq!(stiffness[sent], 400.0);
        let second = (sent..).find(|&n| stiffness[n] == 300.0).unwrap();
        assert_eq!(heard[second - 1], 0.0, "nothing fades any longer");
        assert!(heard[second - 2] != 0.0 || second > sent + 50);
        assert!(second > sent + 20 && second < sent + 200, "{second}");
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn a_slot_waits_while_a_tap_plays() {
    let renderer = Renderer::new(&Config::default()).unwrap();
    let (mut playing, mut spare) = (loaded::<Float>(&texture(1, 500.0, 0.1)), empty());
    let next = texture(2, 300.0, 0.1).encode();
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut spare], 1);
    let mut sent = false;
    let (mut tapped, mut taken) = (0, None);
    for n in 0..200 {
        let z_m = (5e-3 - 2e-4 * n as f32).max(-DEPTH_M);
        let output = renderer.tick_player(&mut player, &Sample::at([0.0, 0.0, z_m]));
        let active = output.flags.contains(Flags::TAP_ACTIVE);
        tapped += usize::from(active);
        let plays_next = player.texture().coupling().stiffness_n_m == 300.0;
        if plays_next && taken.is_none() {
            taken = Some(n);
        }
        assert!(
            !(active && plays_next),
            "{n}: a tap goes on with other traces"
        );
        if active && !sent {
            sent = true;
            preparer
                .prepare(&Asset::parse(&next).unwrap(), 1000.0)
                .unwrap();
        }
    }
    assert!(tapped > 10 && taken.is_some());
}

#[test]
fn slots_go_round_and_a_refused_texture_sends_nothing() {
    let renderer = Renderer::new(&Config::default()).unwrap();
    let (mut playing, mut spare) = (loaded::<Float>(&texture(1, 500.0, 0.0)), empty());
    let next = texture(2, 300.0, 0.0).encode();
    let next = Asset::parse(&next).unwrap();
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut spare], 1);
    let rate = LoadError::Rate {
        model_hz: 1000.0,
        servo_hz: 1500.0,
    };
    assert_eq!(
        preparer.prepare(&next, 1500.0),
        Err(PrepareError::Load(rate))
    );
    assert!(matches!(
        preparer.prepare_haptic(&[1, 2, 3], 1000.0),
        Err(PrepareError::Load(LoadError::Format(_)))
    ));
    // The slot that refused is still spare.
    assert_eq!(preparer.prepare(&next, 1000.0), Ok(()));
    assert_eq!(
        preparer.prepare(&next, 1000.0),
        Err(PrepareError::NoneSpare)
    );
    let air = Sample::at([0.0, 0.0, 0.01]);
    assert_eq!(player.texture().coupling().stiffness_n_m, 500.0);
    renderer.tick_player(&mut player, &air);
    assert_eq!(player.texture().coupling().stiffness_n_m, 300.0);
    // The old one came back.
    assert_eq!(preparer.prepare(&next, 1000.0), Ok(()));
    assert_eq!(player.state().counters().ticks, 1);
}

/// Without another texture a player gives the bits of the plain tick, wherever it lives.
#[test]
fn a_player_is_the_plain_tick_until_it_gets_a_texture() {
    fn check<A: RenderArithmetic>() {
        let renderer = Renderer::<A>::prepare(&Config::default()).unwrap();
        let bytes = texture(1, 500.0, 0.4);
        let (mut playing, mut other) = (loaded::<A>(&bytes), loaded::<A>(&bytes));
        let slot = loaded::<A>(&bytes);
        let (mut exchange, mut second) = (Exchange::<Host, A>::new(), Exchange::<Host, A>::new());
        let (_, mut player) = exchange.split(&mut playing, [], 9);
        let mut memory = MaybeUninit::<Player<'_, '_, Host, A>>::uninit();
        let (_, in_place) = second.split_in(&mut memory, &mut other, [], 9);
        let mut state = State::new(9);
        for position in strokes(6, 3000) {
            let sample = Sample::of(&Sample::at(position));
            let plain = renderer.tick(&slot, &mut state, &sample);
            assert_eq!(renderer.tick_player(&mut player, &sample), plain);
            assert_eq!(renderer.tick_player(in_place, &sample), plain);
        }
        assert_eq!(player.state().counters(), state.counters());
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn three_spare_slots_are_filled_before_one_is_missing() {
    let renderer = Renderer::new(&Config::default()).unwrap();
    let first = texture(1, 500.0, 0.0);
    let mut playing = loaded::<Float>(&first);
    let mut spare = [0; 3].map(|_| empty::<Float>());
    let mut exchange = Exchange::<Host, Float>::new();
    let spare = spare.each_mut().map(|slot| &mut **slot);
    let (mut preparer, mut player) = exchange.split(&mut playing, spare, 1);
    for stiffness in [400.0, 300.0, 200.0] {
        let next = texture(2, stiffness, 0.0).encode();
        let next = Asset::parse(&next).unwrap();
        assert_eq!(preparer.prepare(&next, 1000.0), Ok(()));
    }
    let next = first.encode();
    let next = Asset::parse(&next).unwrap();
    let refused = preparer.prepare(&next, 1000.0);
    assert_eq!(refused, Err(PrepareError::NoneSpare));
    // They play in the order in which they were sent.
    let mut played = Vec::new();
    for _ in 0..100 {
        renderer.tick_player(&mut player, &Sample::at([0.0, 0.0, 0.01]));
        played.push(player.texture().coupling().stiffness_n_m);
    }
    played.dedup();
    assert_eq!(played, [400.0, 300.0, 200.0]);
}
