//! The tables of `docs/evaluation/measured.md`.

use super::{
    Comparison,
    score::Figure,
    signature::BANDS,
    trend::{Beside, Spread, Trends},
};
use asperity_corpus::generator::constants::Constant;
use std::fmt::Write as _;

/// All tables, each under a heading.
#[must_use]
pub fn tables(comparison: &Comparison) -> String {
    let mut text = String::new();
    scores(&mut text, comparison);
    if let Some(fitted) = &comparison.constants {
        constants(&mut text, fitted);
    }
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

fn constants(text: &mut String, fitted: &[Constant]) {
    text.push_str("## Constants\n\n| constant | unit | physics, open data | calibrated (95 %) | moved by one material |\n|---|---|---:|---:|---:|\n");
    for constant in fitted {
        let of = constant.calibrated;
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {} ({}–{}) | {:.0} % |",
            constant.name,
            constant.unit,
            digits(constant.open.value),
            digits(of.value),
            digits(of.low),
            digits(of.high),
            100.0 * constant.moved
        );
    }
    let most = fitted
        .iter()
        .map(|constant| constant.moved)
        .fold(0.0, f64::max);
    let _ = write!(text, "\n## Most moved\n\n{:.0} %\n\n", 100.0 * most);
}

fn spectrum(text: &mut String, trends: &Trends) {
    heading(text, "Spectrum", "third octave, Hz");
    for (band, hz) in trends.bands_hz.iter().enumerate() {
        let cell = |of: &[f64; BANDS]| format!("{:.1}", of[band]);
        row(text, &format!("{hz:.0}"), &trends.spectrum_db, cell);
    }
    text.push('\n');
}

fn slopes(text: &mut String, trends: &Trends) {
    heading(text, "Slopes", "mean ± deviation over materials, dB");
    for (what, spread) in [
        ("level at 100 mm/s and 1 N", trends.level_db),
        ("its rise from 0.5 to 2 N", trends.over_force_db),
        ("its rise from 50 to 150 mm/s", trends.over_speed_db),
    ] {
        let cell = |of: &Spread| format!("{:.1} ± {:.1}", of.mean, of.deviation);
        row(text, what, &spread, cell);
    }
    text.push('\n');
}

fn heading(text: &mut String, title: &str, rows: &str) {
    let _ = write!(
        text,
        "## {title}\n\n| {rows} | measured | by name | generator, names left out |\n|---|---:|---:|---:|\n"
    );
}

fn row<T>(text: &mut String, what: &str, of: &Beside<T>, cell: impl Fn(&T) -> String) {
    let generated = of.generated.as_ref().map_or_else(|| "–".to_owned(), &cell);
    let (measured, compiled) = (cell(&of.measured), cell(&of.compiled));
    let _ = writeln!(text, "| {what} | {measured} | {compiled} | {generated} |");
}

fn friction(text: &mut String, trends: &Trends) {
    let friction = &trends.friction;
    let (mu, error, rank) = (&friction.mu, &friction.error, &friction.correlation);
    let figure =
        |of: Option<Figure>, decimals| of.map_or_else(|| "–".to_owned(), |of| shown(of, decimals));
    let _ = write!(
        text,
        "## Friction\n\n| μ | median | mean error | rank correlation |\n|---|---:|---:|---:|\n| measured | {:.2} | | |\n",
        mu.measured
    );
    for (name, median, error, rank) in [
        (
            "by name",
            Some(mu.compiled),
            Some(error.prompt),
            Some(rank.prompt),
        ),
        (
            "generator, names left out",
            mu.generated,
            error.generated,
            rank.generated,
        ),
        ("the others' median", None, error.constant, rank.constant),
    ] {
        let median = median.map_or_else(|| "–".to_owned(), |of| format!("{of:.2}"));
        let _ = writeln!(
            text,
            "| {name} | {median} | {} | {} |",
            figure(error, 3),
            figure(rank, 2)
        );
    }
}

/// Three significant digits.
fn digits(value: f64) -> String {
    let decimals = (2.0 - libm::floor(libm::log10(value.abs().max(1e-3)))).clamp(0.0, 4.0) as usize;
    format!("{value:.decimals$}")
}

fn shown(figure: Figure, decimals: usize) -> String {
    let Figure {
        value,
        interval: [low, high],
    } = figure;
    format!("{value:.decimals$} ({low:.decimals$}–{high:.decimals$})")
}
