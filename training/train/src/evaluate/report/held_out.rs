//! Section 3.

use super::{percent, row, table};
use crate::evaluate::{
    held_out::{Folds, HeldOut, Predictor},
    statistics::Spread,
};
use asperity::learned::description::CertaintyCurve;

pub(super) fn section(part: &HeldOut) -> String {
    let count = part.materials.folds.len();
    let phrases = [&part.materials, &part.families].map(|folds| {
        let counts = folds.folds.iter().map(|fold| fold.phrases.to_string());
        counts.collect::<Vec<_>>().join(" and ")
    });
    let phrases = format!(
        "{} with materials, {} with families",
        phrases[0], phrases[1]
    );
    let mut text = format!(
        "## 3. What of materials whose textures and captions are left out?\n\n\
         {count} folds. Each trains the recipe ({} epochs of the first stage) without a part of \
         the materials, normalisation included, and decodes the held-out captions of those left out. \
         A phrase of the rated lexicon is left out with a material if it is a caption, a name or a synonym of it, \
         whatever its articles, endings and order, or has a cosine of more than 0.9 with one: {phrases}. \
         What comes out is compared with the materials' unaugmented textures: by the RMS of log \
         spectra over 10–450 Hz, bin by bin; third octaves of the transients, 100–4000 Hz; their \
         initial slope over impact speed (rate-hardness); objective attributes; and μ by the \
         softmax over the remaining anchors. *Mean texture* has the mean LSFs, levels, transients \
         and μ of the training materials. *Nearest* is the training material whose mean caption is \
         nearest in text; *nearest, rated* has the phrases of the lexicon beside the captions, as the model has, \
         and a phrase stands for the training material of the nearest rating. *Text / nearest* and *better than \
         nearest* take the one of both that is less off. *Own latent* is the held-out texture itself, encoded and decoded: what \
         the decoder alone costs. Absolute errors, mean ± deviation over folds; logarithms are natural. On another machine \
         the same command gives other digits.\n\n",
        part.epochs
    );
    text += "![Errors on held-out materials](held_out.png)\n\n";
    text += "### Single materials held out, spread over the families\n\n";
    text += &folds(&part.materials);
    text += "\n### Whole families held out\n\n";
    text += &folds(&part.families);
    text += &format!(
        "\n### Certainty\n\n\
         Share of held-out captions of held-out families whose attributes land within 6 dB of \
         rough_db, 25 % of hard_hz and a factor of e^0.35 of μ, by the largest cosine with a \
         mean training caption, in groups of equal size and made monotone (PAVA). \
         `certainty.json` holds the knots.\n\n{}\n{}",
        curve("families held out", &part.certainty),
        curve("both ways to hold out", &part.certainty_both)
    );
    let better = |folds: &Folds| {
        let metrics = folds.metrics.iter();
        let wins = metrics
            .clone()
            .filter(|m| m.to_mean < 1.0 && m.to_nearest < 1.0);
        format!("{} of {} metrics", wins.count(), metrics.count())
    };
    let within = |folds: &Folds| {
        let [text, rated] =
            [Predictor::Text, Predictor::NearestRated].map(|p| folds.within[p as usize]);
        format!("{} against {}", percent(text), percent(rated))
    };
    text += &format!(
        "\n**Answer.** From text alone the model is better than every baseline in {} for single \
         materials and in {} for whole families. Captions within tolerance, text against *nearest, \
         rated*: {} for single materials, {} for whole families.\n",
        better(&part.materials),
        better(&part.families),
        within(&part.materials),
        within(&part.families),
    );
    text
}

fn folds(folds: &Folds) -> String {
    let spread = |s: Spread| {
        let digits = if s.mean >= 10.0 { 1 } else { 3 };
        format!("{:.digits$} ± {:.digits$}", s.mean, s.deviation)
    };
    let mut text = table(&[
        "error",
        "text",
        "mean texture",
        "nearest",
        "nearest, rated",
        "own latent",
        "text / mean",
        "text / nearest",
        "better than mean",
        "better than nearest",
    ]);
    for metric in &folds.metrics {
        let mut cells = vec![metric.name.clone()];
        cells.extend(metric.errors.map(spread));
        cells.push(format!("{:.2}", metric.to_mean));
        cells.push(format!("{:.2}", metric.to_nearest));
        cells.push(format!("{:.0} %", 100.0 * metric.better_than_mean.share));
        cells.push(format!("{:.0} %", 100.0 * metric.better_than_nearest.share));
        text += &row(&cells);
    }
    text += "\n";
    text += &table(&[
        "Spearman over captions",
        "text",
        "mean texture",
        "nearest",
        "nearest, rated",
        "own latent",
    ]);
    for ranks in &folds.ranks {
        let mut cells = vec![ranks.attribute.clone()];
        cells.extend(ranks.spearman.map(|found| match found {
            Some(s) => format!("{:.2} ± {:.2}", s.mean, s.deviation).replace('-', "−"),
            None => "constant".into(),
        }));
        text += &row(&cells);
    }
    let mut cells = vec!["captions within tolerance".to_owned()];
    cells.extend(Predictor::ALL.map(|p| percent(folds.within[p as usize])));
    text + &row(&cells)
}

fn curve(name: &str, curve: &CertaintyCurve) -> String {
    let values =
        |values: &[f64]| -> Vec<String> { values.iter().map(|x| format!("{x:.2}")).collect() };
    let mut titles = vec![name.to_owned()];
    titles.extend(values(&curve.similarity));
    let titles: Vec<&str> = titles.iter().map(String::as_str).collect();
    let mut cells = vec!["certainty".to_owned()];
    cells.extend(values(&curve.certainty));
    table(&titles) + &row(&cells)
}
