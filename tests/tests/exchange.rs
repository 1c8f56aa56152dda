//! A texture that arrives while the servo loop runs makes no larger step than a texture alone.
//! The state is kept, and whatever plays is exactly what was prepared, however fast textures
//! follow each other.

use asperity::{
    emit::lower::lower,
    passes::reduce::{Fidelity, reduce},
    sources::builtin,
};
use asperity_formats::Asset;
use asperity_runtime::{
    Config, Exchange, Fixed, Flags, Float, HostCapacities, Output, PrepareError, Preparer,
    RenderArithmetic, Renderer, Sample, State, Texture,
    arithmetic::{Point, Scalar as _},
    stage::vibration::LAG_SAMPLES,
};
use std::{
    ops::Range,
    sync::atomic::{AtomicBool, Ordering::Relaxed},
};

type Slot<A> = Texture<HostCapacities, A>;
type TestExchange<'a, A> = Exchange<'a, HostCapacities, A>;
type TestPreparer<'q, 'a, A> = Preparer<'q, 'a, HostCapacities, A>;

const RATE_HZ: f32 = 1000.0;
/// Tick in which the second texture is sent.
const SENT: usize = 400;
/// Ticks after that one that count as the crossing.
const AROUND: usize = 60;
/// Number of textures that a thread sends.
const CHANGES: usize = 300;
/// Largest step of a crossing, relative to the larger one of both textures alone.
const ALLOWED: f32 = 1.1;

/// The built-in texture, and one that is softer, rougher, stickier and of lower order.
fn textures() -> [Vec<u8>; 2] {
    let hard = builtin::texture();
    let mut soft = reduce(&hard, Fidelity::Order(4)).texture;
    for vertex in &mut soft.grid.vertices {
        vertex.sigma_m_s2 *= 2.0;
    }
    soft.wall.stiffness_n_m *= 0.7;
    soft.friction.mu += 0.4;
    [hard, soft].map(|texture| lower(&texture, None).unwrap().bytes)
}

fn slot<A: RenderArithmetic>() -> Box<Slot<A>> {
    Box::new(Slot::new())
}

fn loaded<A: RenderArithmetic>(bytes: &[u8]) -> Box<Slot<A>> {
    let mut slot = slot();
    slot.load(&Asset::parse(bytes).unwrap(), RATE_HZ).unwrap();
    slot
}

/// Down to 2 mm within 0.2 s, then along x at 100 mm/s.
fn stroke() -> Vec<Sample> {
    let down = (0..200).map(|n| [0.0, 0.0, 2.0e-3 - 4.0e-3 * n as f32 / 199.0]);
    let along = (0..500).map(|n| [1.0e-4 * n as f32, 0.0, -2.0e-3]);
    down.chain(along).map(Sample::at).collect()
}

/// Plays a texture, and then whatever `send` prepares before each tick.
fn play<A: RenderArithmetic>(
    first: &[u8],
    seed: u64,
    samples: &[Sample],
    mut send: impl FnMut(usize, &mut TestPreparer<'_, '_, A>),
) -> (Vec<Output<A>>, State<A>) {
    let renderer = Renderer::prepare(&Config::default()).unwrap();
    let (mut playing, mut a, mut b) = (loaded(first), slot(), slot());
    let mut exchange = TestExchange::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut a, &mut b], seed);
    let outputs = samples.iter().enumerate().map(|(n, sample)| {
        send(n, &mut preparer);
        renderer.tick_player(&mut player, &Sample::of(sample))
    });
    let outputs = outputs.collect();
    (outputs, player.state().clone())
}

fn alone<A: RenderArithmetic>(
    bytes: &[u8],
    seed: u64,
    samples: &[Sample],
) -> (Vec<Output<A>>, State<A>) {
    let renderer = Renderer::prepare(&Config::default()).unwrap();
    let (texture, mut state) = (loaded(bytes), State::new(seed));
    let tick = |sample| renderer.tick(&texture, &mut state, &Sample::of(sample));
    let outputs = samples.iter().map(tick).collect();
    (outputs, state)
}

fn difference<A: RenderArithmetic, F: Point>(a: A::Scalar<F>, b: A::Scalar<F>) -> f32 {
    (a.value() - b.value()).abs()
}

fn largest_step_n<A: RenderArithmetic>(outputs: &[Output<A>]) -> f32 {
    let step_n = |pair: &[Output<A>]| {
        let squared = |axis: usize| {
            let (before, after) = (pair[0].force_n[axis], pair[1].force_n[axis]);
            difference::<A, _>(after, before).powi(2)
        };
        (squared(0) + squared(1) + squared(2)).sqrt()
    };
    outputs.windows(2).map(step_n).fold(0.0, f32::max)
}

#[test]
fn another_texture_makes_no_larger_step_than_either_alone() {
    crossing::<Float>();
    crossing::<Fixed>();
}

fn crossing<A: RenderArithmetic>() {
    let pair = textures();
    let samples = stroke();
    for [from, to] in [[0, 1], [1, 0]] {
        let (mut crossing_n, mut alone_n) = (0.0_f32, 0.0_f32);
        for seed in 0..200 {
            let next = Asset::parse(&pair[to]).unwrap();
            let (outputs, _) = play::<A>(&pair[from], seed, &samples, |n, preparer| {
                if n == SENT {
                    preparer.prepare(&next, RATE_HZ).unwrap();
                }
            });
            let crossed = &outputs[SENT - 1..SENT + AROUND];
            crossing_n = crossing_n.max(largest_step_n(crossed));
            let limited = |o: &Output<A>| o.flags.contains(Flags::SLEW_LIMITED);
            assert!(!crossed.iter().any(limited), "the limiter had to step in");
            for bytes in &pair {
                let (outputs, _) = alone::<A>(bytes, seed, &samples);
                alone_n = alone_n.max(largest_step_n(&outputs[SENT - 1..SENT + AROUND]));
            }
        }
        println!("{from} to {to}: {crossing_n:.4} N across, {alone_n:.4} N alone");
        assert!(
            crossing_n <= ALLOWED * alone_n,
            "{from} to {to}: {crossing_n} N across, {alone_n} N alone"
        );
    }
}

/// Without vibration a step of wall or friction could not hide. Both follow in 5 ms, so a tick
/// goes at most 1 − e^(−1/5) of the way.
#[test]
fn wall_and_friction_change_little_by_little() {
    change::<Float>();
    change::<Fixed>();
}

fn change<A: RenderArithmetic>() {
    let silent = |stiffness_n_m: f64, mu: f64| {
        let mut texture = builtin::texture();
        for vertex in &mut texture.grid.vertices {
            vertex.sigma_m_s2 = 0.0;
        }
        texture.wall.stiffness_n_m = stiffness_n_m;
        texture.friction.mu = mu;
        lower(&texture, None).unwrap().bytes
    };
    let pair = [silent(500.0, 0.3), silent(300.0, 0.9)];
    let samples = stroke();
    for [from, to] in [[0, 1], [1, 0]] {
        let next = Asset::parse(&pair[to]).unwrap();
        let (outputs, _) = play::<A>(&pair[from], 1, &samples, |n, preparer| {
            if n == SENT {
                preparer.prepare(&next, RATE_HZ).unwrap();
            }
        });
        let (before, after) = (&outputs[SENT - 1], &outputs[SENT + AROUND]);
        let way_n = largest_step_n(&[*before, *after]);
        assert!(way_n > 0.2, "{way_n} N of way");
        let step_n = largest_step_n(&outputs[SENT - 1..SENT + AROUND]);
        assert!(step_n <= 0.25 * way_n, "{step_n} N of {way_n} N at once");
    }
}

/// Without another texture a player gives the bits of the plain tick. With one, the model at
/// work keeps sounding until the new one is made, and the motion is that of the plain tick.
#[test]
fn nothing_is_forgotten() {
    memory::<Float>();
    memory::<Fixed>();
}

fn memory<A: RenderArithmetic>() {
    let pair = textures();
    let samples = stroke();
    let (plain, plain_state) = alone::<A>(&pair[0], 7, &samples);
    let (kept, kept_state) = play(&pair[0], 7, &samples, |_, _| {});
    assert_eq!(kept, plain);
    assert_eq!(kept_state.counters(), plain_state.counters());

    let next = Asset::parse(&pair[1]).unwrap();
    let (changed, state) = play(&pair[0], 7, &samples, |n, preparer| {
        if n == SENT {
            preparer.prepare(&next, RATE_HZ).unwrap();
        }
    });
    let sound = |outputs: &[Output<A>]| outputs.iter().map(|o| o.vib_m_s2).collect::<Vec<_>>();
    assert_eq!(sound(&changed[..SENT]), sound(&plain[..SENT]));
    // On a steady stroke the old texture's next model would hardly differ from the one at work.
    let effect = SENT + LAG_SAMPLES + 1 - usize::from(loaded::<A>(&pair[1]).cycle_samples());
    let differences = |ticks: Range<usize>| {
        let pairs = changed[ticks.clone()].iter().zip(&plain[ticks]);
        pairs.map(|(a, b)| difference::<A, _>(a.vib_m_s2, b.vib_m_s2))
    };
    assert!(differences(SENT..effect).all(|difference| difference < 1e-3));
    assert!(differences(effect..effect + 5).any(|difference| difference > 0.1));
    let speed = |outputs: &[Output<A>]| outputs.iter().map(|o| o.speed_mm_s).collect::<Vec<_>>();
    assert_eq!(speed(&changed), speed(&plain));
    assert_eq!(state.counters(), plain_state.counters());

    // At the end only the new texture is felt.
    let (new, _) = alone::<A>(&pair[1], 7, &samples);
    let (ours, theirs) = (changed.last().unwrap(), new.last().unwrap());
    let apart_n = difference::<A, _>(ours.normal_force_n, theirs.normal_force_n);
    assert!(apart_n < 5e-5, "{apart_n} N");
    assert!(difference::<A, _>(ours.friction_n, theirs.friction_n) < 1e-3);
}

/// A tap plays to its end on the traces that it began with.
#[test]
fn a_tap_is_not_interrupted() {
    let pair = textures();
    let samples: Vec<_> = (0..200)
        .map(|n| Sample::at([0.0, 0.0, (0.01 - 2.0e-4 * n as f32).max(-1.0e-3)]))
        .collect();
    let (plain, _) = alone::<Float>(&pair[0], 3, &samples);
    let started = |o: &Output| o.flags.contains(Flags::TAP_STARTED);
    let start = plain.iter().position(started).expect("a tap");
    let soft = Asset::parse(&pair[1]).unwrap();
    let (changed, _) = play::<Float>(&pair[0], 3, &samples, |n, preparer| {
        if n == start + 2 {
            preparer.prepare(&soft, RATE_HZ).unwrap();
        }
    });
    let active = |o: &&Output| o.flags.contains(Flags::TAP_ACTIVE);
    let end = start + plain[start..].iter().take_while(active).count();
    assert_eq!(changed[..end], plain[..end]);
    assert_ne!(changed[end + 1], plain[end + 1], "then the other one comes");
}

#[test]
fn a_refused_texture_changes_nothing_and_its_slot_is_kept() {
    refusal::<Float>();
    refusal::<Fixed>();
}

fn refusal<A: RenderArithmetic>() {
    let pair = textures();
    let good = Asset::parse(&pair[1]).unwrap();
    let samples = stroke();
    play::<A>(&pair[0], 1, &samples[..2], |n, preparer| {
        if n > 0 {
            return;
        }
        for _ in 0..10 {
            let refused = preparer.prepare(&good, 1500.0);
            assert!(matches!(refused, Err(PrepareError::Load(_))), "{refused:?}");
        }
        preparer.prepare(&good, RATE_HZ).unwrap();
        preparer.prepare(&good, RATE_HZ).unwrap();
        let full = preparer.prepare(&good, RATE_HZ);
        assert_eq!(full, Err(PrepareError::NoneSpare));
    });
}

/// A thread prepares textures as fast as it can. Whatever plays is one of both textures,
/// complete, and the force stays within peak and slew.
#[test]
fn a_thread_that_never_stops_preparing() {
    let pair = textures();
    let config = Config::default();
    let renderer = Renderer::new(&config).unwrap();
    let whole = [loaded::<Float>(&pair[0]), loaded(&pair[1])];
    let models = whole.each_ref().map(|texture| texture.filter_at(90.0, 1.0));
    let (mut playing, mut a, mut b) = (loaded(&pair[0]), slot(), slot());
    let mut exchange = TestExchange::<Float>::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut a, &mut b], 1);
    let stop = AtomicBool::new(false);
    let step_n = config.limits.slew_n_s / config.servo_rate_hz * 1.0001;
    std::thread::scope(|scope| {
        let sender = scope.spawn(|| {
            let mut sent = 0;
            while !stop.load(Relaxed) {
                let asset = Asset::parse(&pair[(sent + 1) % 2]).unwrap();
                match preparer.prepare(&asset, RATE_HZ) {
                    Ok(()) => sent += 1,
                    Err(PrepareError::NoneSpare) => std::thread::yield_now(),
                    Err(refused) => panic!("{refused}"),
                }
            }
            sent
        });
        let (mut at, mut changes) = (0, 0);
        let mut before = [0.0; 3];
        for n in 0..30_000_000 {
            if changes >= CHANGES {
                break;
            }
            let t = n as f32 * 1e-3;
            let position_m = [
                0.02 * (7.0 * t).sin(),
                0.0,
                -1.5e-3 + 1.0e-3 * (5.0 * t).sin(),
            ];
            let output = renderer.tick_player(&mut player, &Sample::at(position_m));
            for (force, before) in output.force_n.iter().zip(before) {
                assert!(force.is_finite() && (force - before).abs() <= step_n);
            }
            before = output.force_n;
            let model = player.texture().filter_at(90.0, 1.0);
            let now = models
                .iter()
                .position(|m| *m == model)
                .expect("a whole texture");
            changes += usize::from(now != at);
            at = now;
        }
        stop.store(true, Relaxed);
        let sent = sender.join().unwrap();
        println!("{changes} changes, {sent} sent");
        assert_eq!(changes, CHANGES, "the thread never came to prepare");
        assert!(
            sent <= changes + 3 && changes <= sent,
            "{changes} of {sent} in order"
        );
    });
}
