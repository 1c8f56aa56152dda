//! A servo loop at 1 kHz on a thread of its own, fed with textures while it runs.
//!
//! The loop sleeps until absolute times, so that one late wake-up does not delay those after
//! it, and tells the runtime how many periods it missed. No lock is shared with other threads:
//! textures come through the queues of an `Exchange`, commands through atomics. A loop on a real
//! device also asks the system for real-time priority and locked memory, since without them some
//! wake-ups are late.
//!
//! Device, hand and faults are simulated, one step in each servo period.

use asperity::{emit::lower::lower, sources::builtin};
use asperity_formats::Asset;
use asperity_runtime::{Config, Exchange, Flags, HostTexture, Output, Renderer, Sample};
use asperity_sim::fault::{FaultInjector, FaultPlan, SampleFault};
use asperity_sim::hand::{Grip, GripPreset, Motion, Script};
use asperity_sim::{device::DeviceConfig, servo::Servo, session::Session};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::{error::Error, ops::Range, thread, time::Duration, time::Instant};

const PERIOD: Duration = Duration::from_millis(1);
/// Ticks in which the device has nothing new to say.
const STALE: Range<usize> = 700..720;
/// Ticks over which the force fades before the loop ends.
const FADE: usize = 100;
/// The loop ends by itself after so many ticks.
const MOST_TICKS: usize = 30_000;
/// Variations of the built-in texture: name and coefficient of friction.
const TEXTURES: [(&str, f64); 3] = [("grit", 0.72), ("smooth", 0.3), ("sticky", 1.1)];

/// Output of a tick, and the friction coefficient of the texture that played.
type PlayedTick = (Output, f32);

fn main() -> Result<(), Box<dyn Error>> {
    let config = Config::default();
    let renderer = Renderer::new(&config)?;
    let assets: Vec<Vec<u8>> = TEXTURES.into_iter().map(asset).collect::<Result<_, _>>()?;
    let [mut playing, mut a, mut b] = [(); 3].map(|()| Box::new(HostTexture::new()));
    playing.load(&Asset::parse(&assets[0])?, config.servo_rate_hz)?;
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut a, &mut b], 1);

    let ticks = AtomicUsize::new(0);
    let [stop, done] = [const { AtomicBool::new(false) }; 2];
    let (mut rows, mut left) = (Vec::with_capacity(MOST_TICKS), FADE);
    let servo = |sample: &Sample| {
        let mut output = renderer.tick_player(&mut player, sample);
        // A fault cuts the force as fast as the slew limit allows; a planned end can be gentle.
        left = left.saturating_sub(usize::from(stop.load(Relaxed)));
        output.force_n = output.force_n.map(|n| n * left as f32 / FADE as f32);
        rows.push((output, player.texture().mu()));
        ticks.store(rows.len(), Relaxed);
        done.store(left == 0 || rows.len() == MOST_TICKS, Relaxed);
        output
    };
    let (device, grip) = (DeviceConfig::touch()?, Grip::preset(GripPreset::Light)?);
    let servo = FaultInjector::new(servo, FaultPlan::default(), 1);
    let mut session = Session::new(&device, grip, scrub(), servo);

    let missed = thread::scope(|scope| {
        let servo = scope.spawn(|| servo_loop(&mut session, &ticks, &done));
        // This thread may take its time: it loads a texture now and then, and says when to stop.
        let wait_until = |tick| {
            while ticks.load(Relaxed) < tick && !servo.is_finished() {
                thread::sleep(Duration::from_millis(5));
            }
        };
        for (index, bytes) in assets.iter().enumerate().skip(1) {
            wait_until(1000 * index);
            preparer.prepare(&Asset::parse(bytes)?, config.servo_rate_hz)?;
        }
        wait_until(1000 * assets.len());
        stop.store(true, Relaxed);
        Ok::<_, Box<dyn Error>>(servo.join().expect("the servo loop does not panic"))
    })?;
    check(&rows, config.limits.peak_n);
    report(&rows);
    println!("missed   {missed} periods; that is the machine's, and not checked");
    Ok(())
}

/// Renders a tick per period until the last one is `done`; returns the number of missed periods.
fn servo_loop<S: Servo>(
    session: &mut Session<FaultInjector<S>>,
    ticks: &AtomicUsize,
    done: &AtomicBool,
) -> u128 {
    let (mut due, mut missed) = (Instant::now(), 0);
    while !done.load(Relaxed) {
        due += PERIOD;
        thread::sleep(due.saturating_duration_since(Instant::now()));
        let late = due.elapsed().as_micros() / PERIOD.as_micros();
        due += PERIOD * late as u32;
        missed += late;
        // In a missed period the device holds the last force. The next sample says how many
        // periods have passed.
        for _ in 0..late {
            session.servo_mut().start(SampleFault::Dropped, 1);
            session.tick();
        }
        if STALE.contains(&ticks.load(Relaxed)) {
            session.servo_mut().start(SampleFault::Stale, 1);
        }
        if session.tick().is_none() {
            break; // The script has ended.
        }
    }
    missed
}

/// Checks the invariants, which hold however late the loop was woken.
fn check(rows: &[PlayedTick], peak_n: f32) {
    let force_n =
        |(output, _): &PlayedTick| output.force_n.iter().map(|n| n * n).sum::<f32>().sqrt();
    assert!(rows.iter().all(|row| force_n(row) <= 1.0001 * peak_n));
    let pressed = |(output, _): &PlayedTick| output.normal_force_n > 0.5;
    assert!(rows.iter().any(pressed), "nothing was touched");
    assert_eq!(rows.last().map(force_n), Some(0.0), "a force was left on");
    // Two stale samples hold the last good one; the third enters the safe state, where the slew
    // limit takes 3.3 N to zero in two ticks. The first good sample begins a ramp.
    let safe = &rows[STALE.start + 2..STALE.end];
    let is_safe = |(output, _): &PlayedTick| output.flags.contains(Flags::SAFE_STATE);
    assert!(safe.iter().all(is_safe), "not safe");
    assert!(safe[2..].iter().all(|row| force_n(row) == 0.0), "a force");
    let (back, _) = rows[STALE.end];
    assert!(back.flags.contains(Flags::RAMPING), "no ramp");
}

/// The textures in the order in which they played.
fn report(rows: &[PlayedTick]) {
    println!("texture     mu   ticks   vibration m/s² RMS");
    let mut played = rows.chunk_by(|(_, before), (_, mu)| before == mu);
    for (name, _) in TEXTURES {
        let rows = played.next().expect("every texture plays");
        let (mu, ticks) = (rows[0].1, rows.len());
        let squares = rows.iter().map(|(output, _)| output.vib_m_s2.powi(2));
        let vib_m_s2 = (squares.sum::<f32>() / ticks as f32).sqrt();
        println!("{name:<8} {mu:>5.2} {ticks:>7} {vib_m_s2:>20.2}");
    }
    println!("stale    ticks {STALE:?}: safe state, no force, then a ramp");
    println!("end      {FADE} ticks of fading, then no force");
}

fn asset((_, mu): (&str, f64)) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut texture = builtin::texture();
    texture.friction.mu = mu;
    Ok(lower(&texture, None)?.bytes)
}

/// To and fro for a minute, 3 cm to either side, with 1 N.
fn scrub() -> Script {
    Script::new(vec![Motion::Scrub {
        amplitude_m: 0.03,
        frequency_hz: 1.0,
        cycles: 60.0,
        force_n: 1.0,
    }])
}
