//! Taps: bouncing, grazing the surface, while sliding, in close succession.

use super::unbounded;
use asperity_runtime::{Renderer, Sample, State};

use super::error::StabilityError;
use super::material::Material;
use super::row::{ScenarioResult, Words};

/// The runtime's output along a path.
struct ForceStats {
    taps: u32,
    /// Largest change of the whole force in a tick, N.
    step_n: f64,
    /// Integral of the tap force, N·s.
    impulse_n_s: f64,
    /// Mean magnitude of the friction, N.
    friction_n: f64,
}

/// Renders `ticks` ticks along a path of positions, m.
fn force_stats(material: &Material, ticks: usize, path: impl Fn(usize) -> [f64; 3]) -> ForceStats {
    let renderer = Renderer::new(&unbounded()).expect("the default");
    let mut state = State::new(1);
    let (mut last, mut step_n, mut impulse_n_s, mut friction_n) = ([0.0; 3], 0.0_f64, 0.0, 0.0);
    for n in 0..ticks {
        let sample = Sample::at(path(n).map(|x| x as f32));
        let output = renderer.tick(&material.slot, &mut state, &sample);
        let force = output.force_n.map(f64::from);
        let change: f64 = (0..3).map(|i| (force[i] - last[i]).powi(2)).sum();
        step_n = step_n.max(change.sqrt());
        impulse_n_s += 1e-3 * f64::from(output.tap_n);
        friction_n += f64::from(output.friction_n) / ticks as f64;
        last = force;
    }
    ForceStats {
        taps: state.counters().taps,
        step_n,
        impulse_n_s,
        friction_n,
    }
}

/// Ticks at which the surface is entered. They are the taps if every entry counts as one.
#[must_use]
pub fn entries(ticks: usize, path: impl Fn(usize) -> [f64; 3]) -> Vec<usize> {
    (1..ticks)
        .filter(|&n| path(n - 1)[2] >= 0.0 && path(n)[2] < 0.0)
        .collect()
}

/// Tap force of the runtime at each tick, N.
#[must_use]
pub fn tap_forces(material: &Material, ticks: usize, path: impl Fn(usize) -> [f64; 3]) -> Vec<f64> {
    let renderer = Renderer::new(&unbounded()).expect("the default");
    let mut state = State::new(1);
    (0..ticks)
        .map(|n| {
            let sample = Sample::at(path(n).map(|x| x as f32));
            f64::from(renderer.tick(&material.slot, &mut state, &sample).tap_n)
        })
        .collect()
}

/// A tap at 0.2 m/s that bounces: positions, m, of half-waves of falling height, then rest.
#[must_use]
pub fn bouncing(n: usize) -> [f64; 3] {
    let t = n as f64 - 100.0;
    let z = if t < 0.0 {
        -0.2e-3 * t
    } else {
        -0.4e-3 * (-t / 40.0).exp() * (0.35 * t).sin() - 0.02e-3 * (t / 100.0).min(1.0)
    };
    [0.0, 0.0, z]
}

/// A slow stroke along x, held at the surface with noise of ±1 count.
fn grazing(n: usize) -> [f64; 3] {
    let noise = [0.0, 55e-6, -55e-6, 0.0, -55e-6, 55e-6, 0.0][(n * n + n / 3) % 7];
    [2e-5 * n as f64, 0.0, noise]
}

/// A stroke at 150 mm/s that leaves the surface by 1 mm and comes back at 0.1 m/s.
fn sliding(n: usize) -> [f64; 3] {
    let z = match n {
        ..300 => -1e-3,
        300..320 => -1e-3 + 0.1e-3 * (n - 300) as f64,
        320..340 => 1e-3 - 0.1e-3 * (n - 320) as f64,
        _ => -1e-3,
    };
    [0.15e-3 * n as f64, 0.0, z]
}

/// Two taps at 0.4 m/s, 5 ms apart.
fn twice(n: usize) -> [f64; 3] {
    let z = match n {
        ..100 => 0.4e-3 * (100.0 - n as f64) - 0.2e-3,
        100 => -0.2e-3,
        101 => 0.3e-3,
        102 => 0.8e-3,
        103 => 0.6e-3,
        104 => 0.2e-3,
        _ => -0.2e-3,
    };
    [0.0, 0.0, z]
}

/// The first of the two taps alone.
fn once(n: usize) -> [f64; 3] {
    if n <= 100 {
        twice(n)
    } else {
        [0.0, 0.0, -0.2e-3]
    }
}

const CHATTER: Words = Words {
    theme: "tap",
    quantity: "taps too many or too few",
    fails: "every entry into the surface plays a transient: bounces and noise become a rattle",
    instead: "a tap needs an approach faster than 10 mm/s over 8 ms and a distance of 0.5 mm before",
};
const STEP: Words = Words {
    theme: "tap",
    quantity: "largest step of the force in a tick (N)",
    fails: "a transient that starts or is replaced at full force kicks the hand",
    instead: "the total is slew-limited to 2 N a tick, whatever starts",
};
const SLIDE: Words = Words {
    theme: "tap",
    quantity: "change of the mean friction by the tap (%)",
    fails: "friction in proportion to all normal force, tap included, jerks sideways on every tap",
    instead: "friction follows k·δ alone",
};
const TWICE: Words = Words {
    theme: "tap",
    quantity: "impulse missing of two transients (%)",
    fails: "a detector that waits out its transient misses the second tap altogether",
    instead: "the second tap starts at once; what is lost is what the first had still to play",
};

/// The rows.
///
/// # Errors
/// None for the built-in texture.
pub fn rows() -> Result<Vec<ScenarioResult>, StabilityError> {
    let material = Material::built_in()?;
    let mut rows = Vec::new();
    let mut silent = asperity::sources::builtin::texture();
    silent.taps.traces.clear();
    let without_taps = Material::new(silent)?;
    for (scenario, ticks, path, wanted) in [
        (
            "a tap at 0.2 m/s that bounces below 0.4 mm, then rest",
            600,
            bouncing as fn(usize) -> _,
            1.0,
        ),
        (
            "5 s at the surface with noise of ±1 count, sliding",
            5000,
            grazing,
            0.0,
        ),
        (
            "a stroke at 150 mm/s that lifts by 1 mm and lands at 0.1 m/s",
            600,
            sliding,
            1.0,
        ),
        ("two taps at 0.4 m/s, 5 ms apart", 300, twice, 2.0),
    ] {
        let ours = force_stats(&material, ticks, path);
        let miscount = |taps: f64| (taps - wanted).abs();
        rows.push(CHATTER.row(
            scenario,
            miscount(f64::from(ours.taps)),
            0.0,
            &[("every entry", miscount(entries(ticks, path).len() as f64))],
        ));
    }
    let friction = |material| force_stats(material, 600, sliding).friction_n;
    let (with, without) = (friction(&material), friction(&without_taps));
    let fast = 100.0 * (with / without - 1.0).abs();
    rows.push(SLIDE.row("the landing at 0.1 m/s in a stroke", fast, 0.1, &[]));

    let hard = force_stats(&material, 300, twice);
    rows.push(STEP.row("two taps at 0.4 m/s, 5 ms apart", hard.step_n, 1.0, &[]));

    let (one, two) = (
        force_stats(&material, 300, once),
        force_stats(&material, 300, twice),
    );
    let missing = |impulse: f64| 100.0 * (1.0 - impulse / (2.0 * one.impulse_n_s));
    rows.push(TWICE.row(
        "two taps at 0.4 m/s, 5 ms apart",
        missing(two.impulse_n_s),
        50.0,
        &[("wait for the end", missing(one.impulse_n_s))],
    ));
    Ok(rows)
}
