//! Answers to the steps of a study: which are possible, and what is kept of them.

use super::{
    dataset::{Row, stimulus_cells},
    design::Attribute,
    plan::Step,
    prepared::Study,
    stimuli::sha256,
};
use crate::texture::Texture;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::sync::Arc;
use toml::Spanned;

/// Bins of speed and force.
const BINS: usize = 36;

/// A prompt that was tried.
pub(super) struct Try {
    pub(super) prompt: String,
    pub(super) texture: Arc<Texture>,
}

/// `POST api/answer`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Answered {
    pub(crate) index: usize,
    pub(super) rt_ms: u64,
    response: Map<String, Value>,
    strokes: Option<u64>,
    taps: Option<u64>,
    contact_s: Option<f64>,
    exploration: Option<Vec<f64>>,
}

impl Answered {
    /// Fills the cells of a step.
    ///
    /// # Errors
    /// In words, for an answer that is missing or impossible.
    pub(super) fn fill(
        &self,
        row: &mut Row,
        step: Step,
        study: &Study,
        tries: &[Try],
    ) -> Result<(), String> {
        row.trial_type = step.trial_type();
        let response = match step {
            Step::Consent if self.response.get("agreed") == Some(&json!(true)) => {
                json!({ "agreed": true })
            }
            Step::Consent => return Err("response.agreed is not true".into()),
            Step::Break { .. } => json!({}),
            Step::Form(at) => {
                row.form.clone_from(&study.forms[at].name);
                study.forms[at].checked(&self.response)?
            }
            Step::Rating {
                texture,
                phase,
                repeat,
            } => {
                stimulus_cells(row, &study.stimuli[texture]);
                (row.phase, row.repeat) = (phase.name(), Some(repeat));
                self.ratings(&study.design.attributes)?
            }
            Step::Prompt => {
                let last = tries.last().ok_or("no prompt was tried")?;
                row.stimulus.clone_from(&last.prompt);
                row.asset_sha256 = sha256(last.texture.asset());
                let tries: Vec<Value> = tries.iter().map(Try::reported).collect();
                json!({ "tries": tries })
            }
        };
        row.response = response.to_string();
        if step.is_felt() {
            self.explored(row)?;
        }
        Ok(())
    }

    /// Ratings of every attribute, 0 to 100.
    fn ratings(&self, attributes: &[Spanned<Attribute>]) -> Result<Value, String> {
        let names = || attributes.iter().map(|it| &it.get_ref().name);
        if let Some(unknown) = self
            .response
            .keys()
            .find(|key| names().all(|name| name != *key))
        {
            return Err(format!("response.{unknown}: no such attribute"));
        }
        let rating = |name: &String| {
            let given = self.response.get(name);
            let rating = given.filter(|it| it.as_f64().is_some_and(|x| (0.0..=100.0).contains(&x)));
            let rating = rating.ok_or_else(|| format!("response.{name} is not 0 to 100"))?;
            Ok((name.clone(), rating.clone()))
        };
        let ratings: Result<Map<_, _>, String> = names().map(rating).collect();
        ratings.map(Value::from)
    }

    /// The cells of how a texture was explored.
    fn explored(&self, row: &mut Row) -> Result<(), String> {
        let is_time = |seconds: &f64| (0.0..=86_400.0).contains(seconds);
        let bins = self.exploration.as_ref().filter(|bins| bins.len() == BINS);
        let bins = bins.filter(|bins| bins.iter().all(is_time));
        row.exploration = json!(bins.ok_or("exploration is not 36 times")?).to_string();
        let contact_s = self.contact_s.filter(is_time);
        row.contact_s = Some(contact_s.ok_or("contact_s is missing or impossible")?);
        row.strokes = Some(self.strokes.ok_or("strokes is missing")?);
        row.taps = Some(self.taps.ok_or("taps is missing")?);
        Ok(())
    }
}

impl Try {
    fn reported(&self) -> Value {
        let report = self.texture.compiled();
        json!({ "prompt": self.prompt, "certainty": report.map(|it| &it["certainty_level"]) })
    }
}
