//! Permitted values of a configuration.

use super::{Config, ConfigError, Recall, TextStage};
use asperity::learned::description::LATENT;
use std::fmt::Debug;

/// Layers wider than this are a slip of the keyboard.
const MAX_WIDTH: usize = 8192;

impl Config {
    /// Checks every number.
    ///
    /// # Errors
    /// [`ConfigError::Value`] for the first that makes no sense.
    pub fn validate(&self) -> Result<(), ConfigError> {
        let (n, l, o, a) = (
            &self.network,
            &self.loss,
            &self.optimiser,
            &self.augmentation,
        );
        within("name", &self.name, !self.name.is_empty(), "a name")?;
        within(
            "seed",
            self.seed,
            i64::try_from(self.seed).is_ok(),
            "0..2⁶³",
        )?;
        count("corpus.instances", self.corpus.instances, 1000)?;
        within("network.latent", n.latent, n.latent == LATENT, "64")?;
        widths("network.ar_encoder", &n.ar_encoder)?;
        widths("network.tap_encoder", &n.tap_encoder)?;
        widths("network.decoder", &n.decoder)?;
        widths("network.text_projection", &n.text_projection)?;
        count("network.ar_residual_blocks", n.ar_residual_blocks, 64)?;
        count("network.tap_residual_blocks", n.tap_residual_blocks, 64)?;
        count("network.latent_projection", n.latent_projection, MAX_WIDTH)?;
        rate("network.dropout", n.dropout)?;
        weight("loss.reconstruction", l.reconstruction)?;
        weight("loss.ar", l.ar)?;
        weight("loss.taps", l.taps)?;
        probability("loss.excitation_share", l.excitation_share)?;
        weight("loss.contrastive", l.contrastive)?;
        positive("loss.temperature", l.temperature)?;
        weight("loss.alignment", l.alignment)?;
        weight("loss.compactness", l.compactness)?;
        weight("loss.friction", l.friction)?;
        weight("loss.kl", l.kl)?;
        within(
            "loss.kl_to_epoch",
            l.kl_to_epoch,
            l.kl_to_epoch >= l.kl_from_epoch,
            "no earlier than loss.kl_from_epoch",
        )?;
        count("optimiser.epochs", o.epochs, 1_000_000)?;
        let pairs = o.batch >= 2 && o.batch <= MAX_WIDTH;
        within("optimiser.batch", o.batch, pairs, "2..=8192")?;
        positive("optimiser.learning_rate", o.learning_rate)?;
        if let Some(end) = o.final_learning_rate {
            let falls = end >= 0.0 && end <= o.learning_rate;
            let expected = "0..=optimiser.learning_rate";
            within("optimiser.final_learning_rate", end, falls, expected)?;
        }
        positive("optimiser.clip_norm", o.clip_norm)?;
        weight("optimiser.weight_decay", o.weight_decay)?;
        rate("augmentation.modality_dropout", a.modality_dropout)?;
        weight("augmentation.caption_noise", a.caption_noise)?;
        probability("augmentation.caption_mixup", a.caption_mixup)?;
        probability("augmentation.latent_mixup", a.latent_mixup)?;
        if let Some(stage) = &self.text_stage {
            text_stage(stage)?;
        }
        count("friction.top_k", self.friction.top_k, 1000)?;
        positive("friction.temperature", self.friction.temperature)?;
        let folds = self.evaluation.folds;
        within(
            "evaluation.folds",
            folds,
            (2..=100).contains(&folds),
            "2..=100",
        )
    }
}

fn text_stage(s: &TextStage) -> Result<(), ConfigError> {
    positive("text_stage.lexicon_temperature", s.lexicon_temperature)?;
    positive("text_stage.lexicon_bandwidth", s.lexicon_bandwidth)?;
    let memory = &s.memory;
    positive("text_stage.memory.concentration", memory.concentration)?;
    positive("text_stage.memory.ridge", memory.ridge)?;
    count("text_stage.memory.iterations", memory.iterations, 10_000)?;
    count("text_stage.memory.directions", memory.directions, MAX_WIDTH)?;
    positive("text_stage.memory.caption_weight", memory.caption_weight)?;
    positive(
        "text_stage.memory.felt_concentration",
        memory.felt_concentration,
    )?;
    positive(
        "text_stage.memory.felt_caption_weight",
        memory.felt_caption_weight,
    )?;
    memory.recall.as_ref().map_or(Ok(()), recall)
}

fn recall(how: &Recall) -> Result<(), ConfigError> {
    positive("text_stage.memory.recall.temperature", how.temperature)?;
    count(
        "text_stage.memory.recall.directions",
        how.directions,
        MAX_WIDTH,
    )?;
    positive("text_stage.memory.recall.shrinkage", how.shrinkage)?;
    positive("text_stage.memory.recall.mean_weight", how.mean_weight)?;
    probability("text_stage.memory.recall.familiar", how.familiar)?;
    positive(
        "text_stage.memory.recall.felt_temperature",
        how.felt_temperature,
    )?;
    positive(
        "text_stage.memory.recall.felt_phrase_weight",
        how.felt_phrase_weight,
    )
}

fn within(
    field: &'static str,
    value: impl Debug,
    holds: bool,
    expected: &'static str,
) -> Result<(), ConfigError> {
    if holds {
        return Ok(());
    }
    Err(ConfigError::Value {
        field,
        value: format!("{value:?}"),
        expected,
    })
}

fn count(field: &'static str, value: usize, most: usize) -> Result<(), ConfigError> {
    within(
        field,
        value,
        value >= 1 && value <= most,
        "at least 1, and sane",
    )
}

fn widths(field: &'static str, value: &[usize]) -> Result<(), ConfigError> {
    let sane = value.iter().all(|w| (1..=MAX_WIDTH).contains(w));
    within(
        field,
        value,
        sane && !value.is_empty(),
        "widths of 1..=8192, at least one",
    )
}

fn weight(field: &'static str, value: f64) -> Result<(), ConfigError> {
    let holds = value >= 0.0 && value.is_finite();
    within(field, value, holds, "finite and not negative")
}

fn positive(field: &'static str, value: f64) -> Result<(), ConfigError> {
    let holds = value > 0.0 && value.is_finite();
    within(field, value, holds, "finite and more than 0")
}

fn probability(field: &'static str, value: f64) -> Result<(), ConfigError> {
    within(field, value, (0.0..=1.0).contains(&value), "0..=1")
}

fn rate(field: &'static str, value: f64) -> Result<(), ConfigError> {
    within(
        field,
        value,
        (0.0..1.0).contains(&value),
        "0 or more and less than 1",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_recipes_are_valid_and_read_back() {
        for name in ["paper", "reference", "hatt"] {
            let config = Config::find(name).unwrap();
            config.validate().unwrap();
            let text = config.to_toml().unwrap();
            assert_eq!(Config::parse("again", &text).unwrap(), config);
        }
    }

    #[test]
    fn the_paper_has_no_second_stage() {
        assert_eq!(Config::find("paper").unwrap().text_stage, None);
    }

    #[test]
    fn an_unknown_field_and_a_bad_value_are_named() {
        let text = Config::find("paper").unwrap().to_toml().unwrap();
        let unknown = Config::parse("x.toml", &format!("colour = 1\n{text}")).unwrap_err();
        assert!(unknown.to_string().contains("colour"));
        let mut config = Config::find("paper").unwrap();
        config.network.dropout = 1.0;
        let error = config.validate().unwrap_err().to_string();
        assert!(error.contains("network.dropout = 1.0"), "{error}");
        config = Config::find("paper").unwrap();
        config.loss.temperature = f64::NAN;
        let error = config.validate().unwrap_err().to_string();
        assert!(error.contains("loss.temperature"), "{error}");
    }
}
