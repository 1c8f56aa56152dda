//! `MODEL_CARD.md`.

use crate::{metrics::Metrics, trained::Trained};
use asperity::learned::description::ModelDescription;
use asperity_corpus::Corpus;
use std::fmt::Write as _;

/// Writes the model card: the model, its training data, and its accuracy on its materials.
pub(super) fn write(
    trained: &Trained,
    corpus: &Corpus,
    description: &ModelDescription,
    metrics: &Metrics,
    config: &str,
) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = card(&mut text, trained, corpus, description, metrics, config);
    text
}

fn card(
    text: &mut String,
    trained: &Trained,
    corpus: &Corpus,
    description: &ModelDescription,
    metrics: &Metrics,
    config: &str,
) -> std::fmt::Result {
    let materials = &trained.materials;
    let instances: usize = materials
        .iter()
        .map(|m| corpus.materials[m.material].instances.len())
        .sum();
    let taps = if corpus.taps_synthetic {
        "synthesised"
    } else {
        "recorded"
    };
    writeln!(text, "# Model card: {}\n", description.name)?;
    writeln!(
        text,
        "Text to haptic texture: a bimodal variational autoencoder over AR models and tapping \
         transients with a projection of text into its latent, after Qian, Chang, Lu, Gu and \
         Culbertson, \"Language-Guided Multimodal Texture Authoring via Generative Models\". \
         Written by `asperity-train fit`, read by `asperity`.\n"
    )?;
    writeln!(text, "| | |\n|---|---|")?;
    writeln!(
        text,
        "| corpus | {} (CRC-32 {:08x}) |",
        corpus.name, corpus.crc32
    )?;
    writeln!(text, "| licence of the corpus | {} |", corpus.licence)?;
    writeln!(
        text,
        "| data | {} materials, {instances} instances, taps {taps} |",
        materials.len()
    )?;
    writeln!(
        text,
        "| text encoder | {}, {} numbers |",
        trained.encoder, trained.width
    )?;
    writeln!(text, "| parameters | {} |", trained.parameters.count())?;
    writeln!(text, "| seed | {} |", description.seed)?;
    writeln!(text, "| epochs | {} |", trained.history.len())?;
    writeln!(text, "\n## On the materials it was trained on\n")?;
    writeln!(
        text,
        "These say that it learned, not that it generalises: that is what \
         `asperity-train evaluate` measures.\n"
    )?;
    writeln!(text, "| | |\n|---|---|")?;
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let loss = metrics.loss;
    writeln!(
        text,
        "| last epoch: total, AR, taps | {:.4}, {:.4}, {:.4} |",
        loss.total, loss.ar, loss.taps
    )?;
    writeln!(
        text,
        "| last epoch: KL, InfoNCE, alignment | {:.2} nats, {:.4}, {:.4} |",
        loss.kl, loss.contrastive, loss.alignment
    )?;
    writeln!(
        text,
        "| last epoch: compactness, friction | {:.4}, {:.4} |",
        loss.compactness, loss.friction
    )?;
    writeln!(
        text,
        "| variance explained: LSFs, excitation, taps | {}, {}, {} |",
        percent(metrics.lsf_explained),
        percent(metrics.excitation_explained),
        percent(metrics.taps_explained)
    )?;
    writeln!(
        text,
        "| active latent units | {} of 64 |",
        metrics.active_units
    )?;
    for (name, retrieval) in [
        ("training", metrics.training),
        ("held-out", metrics.held_out),
        ("own names, as", metrics.names),
        ("synonyms, trained on, as", metrics.synonyms),
    ] {
        writeln!(
            text,
            "| material found by its {} {name} captions, first / first five | {} / {} |",
            retrieval.captions,
            percent(retrieval.top_1),
            percent(retrieval.top_5)
        )?;
    }
    if let Some(words) = &metrics.words {
        let [rough, slippery, hard] = words.r_squared;
        writeln!(
            text,
            "| ratings of {} phrases left out in groups, R²: rough, slippery, hard | {rough:.3}, \
             {slippery:.3}, {hard:.3} |",
            words.phrases
        )?;
        let [rough, slippery, hard] = words.spearman;
        writeln!(
            text,
            "| the same, Spearman's ρ | {rough:.3}, {slippery:.3}, {hard:.3} |"
        )?;
        writeln!(
            text,
            "| expected calibration error of the certainty, by halves of these phrases | {:.3} |",
            words.calibration_error
        )?;
    }
    for axis in &description.axes {
        writeln!(
            text,
            "| linear in z: {}, R² | {:.3} |",
            axis.attribute, axis.r_squared
        )?;
    }
    writeln!(text, "\n## Limits\n")?;
    writeln!(
        text,
        "A prompt far from every caption gets a mixture of known materials; `certainty` in \
         `model.json` says how far. What it says of friction is read from the nearest \
         materials. `docs/evaluation/measured.md` says how near a name comes to the measured \
         material. Nothing was felt by people on a device.\n"
    )?;
    writeln!(
        text,
        "## Configuration\n\n```toml\n{}\n```",
        config.trim_end()
    )
}
