//! The grid as it fills, and what to do next.

use std::fmt::Write as _;

use asperity_lab::capture::{Exploration, NextStep, TAPS_M_S};

/// Blocks of a cell that is covered.
const BLOCKS: usize = 4;

/// A picture of several lines.
pub(super) fn picture(exploration: &Exploration) -> String {
    let now = exploration.now();
    let mut text = grid(exploration);
    let taps: Vec<String> = exploration.taps().iter().map(u32::to_string).collect();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "air {:.0} s, taps {}; now {:.0} mm/s, {:.2} N",
        exploration.air_s(),
        taps.join(" "),
        now.speed_mm_s,
        now.load_n
    );
    text + &ask(exploration)
}

/// The grid: a row for each band of force, the hardest first.
pub(super) fn grid(exploration: &Exploration) -> String {
    let coverage = exploration.coverage();
    let (speeds, forces) = coverage.bands();
    let mut text = format!("{:>12}", "");
    for speed in 0..speeds {
        let [low, high] = coverage.speed(speed);
        let _ = write!(text, "{:>9}", format!("{low}–{high}"));
    }
    text += " mm/s\n";
    for force in (0..forces).rev() {
        let [low, high] = coverage.force(force);
        let _ = write!(text, "{:>12}", format!("{low}–{high} N"));
        for speed in 0..speeds {
            let full = (coverage.part((speed, force)) * BLOCKS as f64) as usize;
            let cell = "█".repeat(full) + &"·".repeat(BLOCKS - full);
            let _ = write!(text, "{cell:>9}");
        }
        text.push('\n');
    }
    text
}

/// Returns the instruction for the next step.
pub(super) fn ask(exploration: &Exploration) -> String {
    let coverage = exploration.coverage();
    let now = exploration.now();
    match exploration.next_step() {
        NextStep::Air => "hold the tool still in the air, and tap it once with a finger".into(),
        NextStep::Tap(band) => format!(
            "tap the surface at {:.0} to {:.0} mm/s, and lift the tool in between",
            1e3 * TAPS_M_S[band],
            1e3 * TAPS_M_S[band + 1]
        ),
        NextStep::Stroke((speed, force)) => {
            let (speeds, forces) = (coverage.speed(speed), coverage.force(force));
            let [slow, fast] = speeds;
            let [light, hard] = forces;
            let hints = [
                hint(now.speed_mm_s, speeds, ["faster", "slower"]),
                hint(now.load_n, forces, ["harder", "lighter"]),
            ];
            let hints: Vec<&str> = hints.into_iter().flatten().collect();
            let hints = match now.touches {
                Some(true) if hints.is_empty() => ": hold it".into(),
                Some(true) => format!(": {}", hints.join(", ")),
                _ => String::new(),
            };
            format!("stroke at {slow} to {fast} mm/s with {light} to {hard} N{hints}")
        }
        NextStep::Nothing => "done".into(),
    }
}

fn hint(
    value: f64,
    [low, high]: [f64; 2],
    [more, less]: [&'static str; 2],
) -> Option<&'static str> {
    if value < low {
        Some(more)
    } else if value >= high {
        Some(less)
    } else {
        None
    }
}
