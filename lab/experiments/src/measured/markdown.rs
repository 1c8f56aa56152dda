//! The tables of `docs/evaluation/measured.md`.

use super::{
    Comparison,
    score::Figure,
    trend::{Both, Spread, Trends},
};
use std::fmt::Write as _;

/// All tables, each under a heading.
#[must_use]
pub fn tables(comparison: &Comparison) -> String {
    let mut text = String::new();
    scores(&mut text, comparison);
    if let Some(trends) = &comparison.trends {
        spectrum(&mut text, trends);
        slopes(&mut text, trends);
        friction(&mut text, trends);
    }
    // As pages write a negative number.
    text.replace(" -", " −")
        .replace("(-", "(−")
        .replace("–-", "–−")
}

// Writing to a string cannot fail.
fn scores(text: &mut String, comparison: &Comparison) {
    let _ = write!(
        text,
        "## Prediction\n\n| a measured material is predicted by | materials | whole, dB | level, dB | shape, dB | rank of {} |\n|---|---:|---:|---:|---:|---:|\n",
        comparison.materials
    );
    for score in &comparison.scores {
        let [whole, level, shape] =
            [score.whole_db, score.level_db, score.shape_db].map(|of| shown(of, 2));
        let _ = writeln!(
            text,
            "| {} | {} | {whole} | {level} | {shape} | {} |",
            score.method,
            score.materials,
            shown(score.rank, 0)
        );
    }
    text.push('\n');
}

fn spectrum(text: &mut String, trends: &Trends) {
    text.push_str(
        "## Spectrum\n\n| third octave, Hz | measured, dB | by name, dB |\n|---:|---:|---:|\n",
    );
    let Both { measured, compiled } = trends.spectrum_db;
    for ((hz, measured), compiled) in trends.bands_hz.iter().zip(measured).zip(compiled) {
        let _ = writeln!(text, "| {hz:.0} | {measured:.1} | {compiled:.1} |");
    }
    text.push('\n');
}

fn slopes(text: &mut String, trends: &Trends) {
    text.push_str("## Slopes\n\n| mean ± deviation over materials, dB | measured | by name |\n|---|---:|---:|\n");
    for (what, both) in [
        ("level at 100 mm/s and 1 N", trends.level_db),
        ("its rise from 0.5 to 2 N", trends.over_force_db),
        ("its rise from 50 to 150 mm/s", trends.over_speed_db),
    ] {
        let shown = |of: Spread| format!("{:.1} ± {:.1}", of.mean, of.deviation);
        let (measured, compiled) = (shown(both.measured), shown(both.compiled));
        let _ = writeln!(text, "| {what} | {measured} | {compiled} |");
    }
    text.push('\n');
}

fn friction(text: &mut String, trends: &Trends) {
    let friction = &trends.friction;
    let _ = write!(
        text,
        "## Friction\n\n| μ | |\n|---|---:|\n| median, measured | {:.2} |\n| median, by name | {:.2} |\n| mean error by name | {} |\n| mean error of the others' median | {} |\n| rank correlation by name | {} |\n",
        friction.mu.measured,
        friction.mu.compiled,
        shown(friction.prompt, 3),
        shown(friction.constant, 3),
        shown(friction.correlation, 2)
    );
}

fn shown(figure: Figure, decimals: usize) -> String {
    let Figure {
        value,
        interval: [low, high],
    } = figure;
    format!("{value:.decimals$} ({low:.decimals$}–{high:.decimals$})")
}
