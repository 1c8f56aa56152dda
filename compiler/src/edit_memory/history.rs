//! Creation and edit history of a texture: the contents of `hist`.

use super::{
    latents::{Latents, of_hex, to_hex},
    sliders::Sliders,
};
use crate::learned::Certainty;
use asperity_formats::limits::MAX_HISTORY_BYTES;
use asperity_texture::model::{ContactLaw, shift::Shift};
use serde::{Deserialize, Serialize};

/// Creation and edit history of a texture. For a prompt, the provenance holds prompt and seed; the history holds the
/// certainty and, if the prompt has a grammar, a shift.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct History {
    /// Origin, unless a prompt.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub made: Option<Origin>,
    /// Certainty of the prompt's interpretation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certainty: Option<Certainty>,
    /// Level that all textures were brought to, dB re 1 N RMS of force; none is the default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub loudness_db: Option<f64>,
    /// Shift applied after decoding. `remember` takes it from the latents.
    #[serde(default, skip_serializing_if = "Shift::is_none")]
    pub shift: Shift,
    /// Edits, the oldest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<Step>,
}

/// Origin of a texture without a prompt of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Origin {
    /// Between two textures.
    Blend {
        /// At t = 0.
        a: Ingredient,
        /// At t = 1.
        b: Ingredient,
        /// Where between them, 0..=1.
        t: f64,
    },
    /// Parts of several textures.
    Compose {
        /// Source of the tap response.
        tap: Ingredient,
        /// Source of the sliding vibration.
        slide: Ingredient,
        /// Where friction comes from.
        friction: Ingredient,
    },
    /// The latent of a recording.
    Encode {
        /// Name of the recorded texture.
        name: String,
        /// `whole`, `taps` or `slide`: what the encoder was given.
        part: String,
    },
}

/// A texture that another one was made of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ingredient {
    /// Its name.
    pub name: String,
    /// Its prompt, if it had one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prompt: Option<String>,
    /// Its latents as hexadecimal text, one or three.
    pub latents: Vec<String>,
    /// Shift applied after decoding.
    #[serde(default, skip_serializing_if = "Shift::is_none")]
    pub shift: Shift,
}

impl Ingredient {
    /// A texture by name, prompt and latents.
    #[must_use]
    pub fn new(name: &str, prompt: Option<&str>, latents: &Latents) -> Self {
        Self {
            name: name.to_owned(),
            prompt: prompt.map(str::to_owned),
            latents: hex(latents),
            shift: latents.shift,
        }
    }

    /// Its latents; `None` if they are damaged.
    #[must_use]
    pub fn latents(&self) -> Option<Latents> {
        Some(unhex(&self.latents)?.shifted(self.shift))
    }
}

/// A single edit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Requested sliders, or those that the words resolved to.
    pub edit: Sliders,
    /// The words, if it was asked for in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prompt: Option<String>,
    /// The latents before it as hexadecimal text, one or three.
    pub before: Vec<String>,
    /// Shift applied after decoding `before`.
    #[serde(default, skip_serializing_if = "Shift::is_none")]
    pub shift: Shift,
    /// The contact law before it, if its words moved that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactLaw>,
}

impl Step {
    /// An edit of these latents.
    #[must_use]
    pub fn new(edit: Sliders, before: &Latents) -> Self {
        Self {
            edit,
            prompt: None,
            before: hex(before),
            shift: before.shift,
            contact: None,
        }
    }

    /// The same edit, asked for in words.
    #[must_use]
    pub fn worded(self, prompt: &str) -> Self {
        Self {
            prompt: Some(prompt.to_owned()),
            ..self
        }
    }

    /// The latents before it; `None` if they are damaged.
    #[must_use]
    pub fn before(&self) -> Option<Latents> {
        Some(unhex(&self.before)?.shifted(self.shift))
    }
}

fn hex(latents: &Latents) -> Vec<String> {
    latents.parts().iter().map(to_hex).collect()
}

fn unhex(parts: &[String]) -> Option<Latents> {
    let parts: Option<Vec<_>> = parts.iter().map(|part| of_hex(part)).collect();
    Latents::of_parts(&parts?)
}

impl History {
    /// A texture that was made in this way.
    #[must_use]
    pub fn of(made: Origin) -> Self {
        Self {
            made: Some(made),
            ..Self::default()
        }
    }

    /// Returns true if there is nothing to write.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self == &Self::default()
    }

    /// The JSON that an asset holds. Where it would be too long, the oldest edits are left out.
    #[must_use]
    pub fn json(&self) -> String {
        let mut kept = self.clone();
        loop {
            // Plain structures of numbers and strings always serialise.
            let json = serde_json::to_string(&kept).unwrap_or_default();
            if json.len() <= MAX_HISTORY_BYTES || kept.steps.is_empty() {
                return json;
            }
            kept.steps.remove(0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_history_reads_back_and_forgets_its_oldest_edits_where_it_would_not_fit() {
        let latents = Latents {
            tap: [0.5; 64],
            ..Latents::whole([-0.25; 64]).shifted(Shift {
                rough_db: 5.1,
                ..Shift::default()
            })
        };
        let edit = Sliders {
            rougher: 20.0,
            ..Sliders::default()
        };
        let source = Ingredient::new("x", Some("y"), &latents);
        assert_eq!(source.latents(), Some(latents));
        let mut history = History::of(Origin::Blend {
            a: source.clone(),
            b: source,
            t: 0.5,
        });
        history.steps.push(Step::new(edit, &latents));
        let read: History = serde_json::from_str(&history.json()).unwrap();
        assert_eq!(read, history);
        assert_eq!(read.steps[0].before(), Some(latents));
        for n in 0..100 {
            let harder = Sliders {
                harder: f64::from(n),
                ..Sliders::default()
            };
            history.steps.push(Step::new(harder, &latents));
        }
        let json = history.json();
        assert!(json.len() <= MAX_HISTORY_BYTES);
        let read: History = serde_json::from_str(&json).unwrap();
        assert!(read.steps.len() < 101 && read.made == history.made);
        assert_eq!(read.steps.last(), history.steps.last());
    }
}
