//! The design of a study: a TOML file, read and checked.

use super::{checks, text::Text};
use asperity_io::diagnostic::Fault;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toml::Spanned;

/// A study as its file states it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Design {
    /// Letters and digits, for names of files.
    pub(crate) name: Spanned<String>,
    pub(crate) title: String,
    /// The text that a participant agrees to.
    pub(crate) consent: Spanned<String>,
    /// The last words.
    #[serde(default = "thanks")]
    pub(crate) thanks: String,
    /// Participants at most.
    #[serde(default = "participants")]
    pub(crate) participants: usize,
    #[serde(default)]
    pub(crate) seed: u64,
    /// Level of the sound, dB of full scale, one for all.
    #[serde(default = "volume_db")]
    pub(crate) volume_db: f64,
    /// True if a texture is shown with its picture.
    #[serde(default)]
    pub(crate) picture: bool,
    /// True if every pair of anchors also gets its midpoint.
    #[serde(default)]
    pub(crate) midpoints: bool,
    #[serde(default)]
    pub(crate) explore: Explore,
    #[serde(default)]
    pub(crate) ratings: Ratings,
    #[serde(default, rename = "texture")]
    pub(crate) textures: Vec<Spanned<TextureEntry>>,
    #[serde(default, rename = "attribute")]
    pub(crate) attributes: Vec<Spanned<Attribute>>,
    #[serde(default, rename = "form")]
    pub(crate) forms: Vec<Spanned<FormEntry>>,
    /// Phase II: prompts of the participant's own.
    pub(crate) prompts: Option<Prompts>,
    #[serde(default)]
    pub(crate) simulate: Simulate,
}

fn thanks() -> String {
    "That was all. Thank you!".into()
}

fn participants() -> usize {
    99
}

fn volume_db() -> f64 {
    -12.0
}

/// The exploration that a texture needs before it can be rated.
#[derive(Debug, Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Explore {
    pub(crate) strokes: u32,
    pub(crate) taps: u32,
    /// In contact, s.
    pub(crate) seconds: f64,
}

impl Default for Explore {
    fn default() -> Self {
        Self {
            strokes: 3,
            taps: 1,
            seconds: 4.0,
        }
    }
}

/// The order and number of ratings.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Ratings {
    pub(crate) order: Order,
    /// Blocks, in each of which every texture comes once.
    pub(crate) repeats: usize,
    /// Ratings before the first block, which no analysis counts.
    pub(crate) practice: usize,
    /// Ratings of a block that come once more, unannounced, to measure how consistent a participant is.
    #[serde(rename = "catch")]
    pub(crate) catch_trials: usize,
    /// A break after so many ratings; 0 is none.
    pub(crate) break_every: usize,
    /// Least length of a break, s.
    pub(crate) break_s: f64,
}

impl Default for Ratings {
    fn default() -> Self {
        Self {
            order: Order::Latin,
            repeats: 1,
            practice: 2,
            catch_trials: 0,
            break_every: 15,
            break_s: 30.0,
        }
    }
}

/// Orders of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Order {
    /// A row of a balanced Latin square: each texture follows each other one equally often (Williams 1949).
    Latin,
    /// Shuffled by the study's seed, anew for each participant and block.
    Seeded,
}

/// A texture that is rated.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TextureEntry {
    pub(crate) name: String,
    pub(crate) prompt: Option<String>,
    #[serde(default)]
    pub(crate) seed: u64,
    /// An asset, or what `asperity import` reads, such as a HaTT material; relative to the study's file.
    pub(crate) file: Option<PathBuf>,
    /// Two textures that it lies between.
    pub(crate) between: Option<[String; 2]>,
    /// Where between them.
    #[serde(default = "middle")]
    pub(crate) t: f64,
    #[serde(default)]
    pub(crate) anchor: bool,
}

fn middle() -> f64 {
    0.5
}

/// The question of a slider from 0 to 100.
#[derive(Debug, Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Attribute {
    pub(crate) name: String,
    pub(crate) question: String,
    pub(crate) low: String,
    pub(crate) high: String,
}

/// A questionnaire.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FormEntry {
    /// `tlx`, `usefulness`, `ease`, or any name where a file or items are given.
    pub(crate) name: String,
    pub(crate) heading: Option<String>,
    #[serde(default)]
    pub(crate) text: String,
    /// A file with its items, for questionnaires that are not ours to ship, such as the Haptic Experience Inventory.
    pub(crate) file: Option<PathBuf>,
    #[serde(default, rename = "item")]
    pub(crate) items: Vec<super::forms::Item>,
    #[serde(default)]
    pub(crate) after: After,
}

/// The part that a form follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum After {
    #[default]
    Ratings,
    Prompts,
}

/// Prompts that a participant types.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Prompts {
    pub(crate) text: String,
    /// Number that a participant makes.
    pub(crate) count: usize,
    /// Times that each may be refined.
    #[serde(default = "once")]
    pub(crate) refinements: usize,
}

fn once() -> usize {
    1
}

/// Participants that nobody asked.
#[derive(Debug, Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Simulate {
    /// Standard deviation of a rating, points of 100.
    pub(crate) noise: f64,
    /// Standard deviation of a participant's own shift of an attribute, points.
    pub(crate) bias: f64,
    /// Shift of a midpoint beyond its place, towards its higher anchor, as a share of their distance.
    pub(crate) dominance: f64,
    /// Share of the scale that is used: people avoid its ends.
    pub(crate) spread: f64,
}

impl Default for Simulate {
    fn default() -> Self {
        Self {
            noise: 6.0,
            bias: 4.0,
            dominance: 0.0,
            spread: 0.6,
        }
    }
}

impl Design {
    /// The design of a file.
    ///
    /// # Errors
    /// Every [`Fault`] of it, with line and field; at least one.
    pub(crate) fn read(text: &Text) -> Result<Self, Vec<Fault>> {
        let design: Self = text.parse().map_err(|fault| vec![fault])?;
        let faults = checks::faults(&design, text);
        if faults.is_empty() {
            Ok(design)
        } else {
            Err(faults)
        }
    }
}
