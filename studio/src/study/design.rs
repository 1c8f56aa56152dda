//! The design of a study: a TOML file, read and checked.

use asperity_io::{diagnostic::Fault, shown::suggestion, toml_error::TomlError};
use serde::{Deserialize, Serialize};
use std::{
    fs,
    path::{Path, PathBuf},
};
use toml::Spanned;

/// Bytes of a study's file, and of one with a form's items.
const FILE_BYTES: u64 = 1 << 20;
/// Ratings of one participant: a day of work.
const MOST_RATINGS: usize = 2000;

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
    pub(crate) participants: Spanned<usize>,
    #[serde(default)]
    pub(crate) seed: u64,
    /// Level of the sound, dB of full scale, one for all.
    #[serde(default = "volume_db")]
    pub(crate) volume_db: Spanned<f64>,
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

fn participants() -> Spanned<usize> {
    Spanned::new(0..0, 99)
}

fn volume_db() -> Spanned<f64> {
    Spanned::new(0..0, -12.0)
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

/// A file with its text, which a fault points into.
#[derive(Debug, Clone)]
pub(crate) struct Text {
    pub(crate) path: PathBuf,
    pub(crate) text: String,
}

impl Text {
    /// Reads a file of UTF-8, as large as one that a person writes.
    pub(crate) fn read(path: &Path) -> Result<Self, Fault> {
        let failed = |error: std::io::Error| {
            Fault::new(
                format!("cannot be read: {error}"),
                "check its path and its permissions",
            )
            .at(path)
        };
        let size = fs::metadata(path).map_err(failed)?.len();
        if size > FILE_BYTES {
            let what = format!("{size} bytes are too many for a study");
            return Err(Fault::new(what, "give the TOML file of a study").at(path));
        }
        let bytes = fs::read(path).map_err(failed)?;
        let text = String::from_utf8(bytes)
            .map_err(|_| Fault::new("not UTF-8", "save it as UTF-8").at(path))?;
        let path = path.to_owned();
        Ok(Self { path, text })
    }

    /// Reads it as TOML.
    pub(crate) fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, Fault> {
        toml::from_str(&self.text).map_err(|error| {
            let error = TomlError::new(&self.text, &error);
            let remedy = "correct this line; docs/studies.md has every field";
            Fault::new(&error.message, remedy)
                .at(&self.path)
                .line(error.line as u64)
        })
    }

    /// A fault of what stands at a place.
    pub(crate) fn fault<T>(
        &self,
        at: &Spanned<T>,
        field: String,
        what: String,
        remedy: &str,
    ) -> Fault {
        let start = at.span().start.min(self.text.len());
        let line = 1 + self.text[..start].matches('\n').count() as u64;
        Fault::new(what, remedy)
            .at(&self.path)
            .line(line)
            .field(field)
    }
}

impl Design {
    /// The design of a file.
    ///
    /// # Errors
    /// Every [`Fault`] of it, with line and field; at least one.
    pub(crate) fn read(text: &Text) -> Result<Self, Vec<Fault>> {
        let design: Self = text.parse().map_err(|fault| vec![fault])?;
        let faults = design.faults(text);
        if faults.is_empty() {
            Ok(design)
        } else {
            Err(faults)
        }
    }

    /// Ratings of one participant, practice and repeated ones included.
    pub(crate) fn ratings_of(&self, textures: usize) -> usize {
        let Ratings {
            repeats,
            practice,
            catch_trials,
            ..
        } = self.ratings;
        textures
            .saturating_mul(repeats)
            .saturating_add(practice)
            .saturating_add(catch_trials)
    }

    fn faults(&self, text: &Text) -> Vec<Fault> {
        let mut faults = Vec::new();
        let mut wrong = |fault| faults.push(fault);
        if !is_word(self.name.get_ref()) {
            let what = format!("`{}` cannot be in the name of a file", self.name.get_ref());
            wrong(text.fault(
                &self.name,
                "name".into(),
                what,
                "give 1 to 40 letters and digits without spaces",
            ));
        }
        if self.consent.get_ref().trim().is_empty() {
            let remedy = "say who asks, what is recorded, how long it takes, and that one may stop at any time";
            wrong(text.fault(
                &self.consent,
                "consent".into(),
                "nothing to agree to".into(),
                remedy,
            ));
        }
        if !(1..=9999).contains(self.participants.get_ref()) {
            let what = format!("{} participants", self.participants.get_ref());
            wrong(text.fault(
                &self.participants,
                "participants".into(),
                what,
                "give 1 to 9999",
            ));
        }
        if !(-60.0..=0.0).contains(self.volume_db.get_ref()) {
            let what = format!("a level of {} dB", self.volume_db.get_ref());
            wrong(text.fault(
                &self.volume_db,
                "volume_db".into(),
                what,
                "give −60 to 0, dB of full scale",
            ));
        }
        if self.textures.is_empty() && self.prompts.is_none() {
            wrong(
                Fault::new(
                    "a study without textures",
                    "add a [[texture]] with a name and a prompt or a file, or [prompts]",
                )
                .at(&text.path),
            );
        }
        if !self.textures.is_empty() && self.attributes.is_empty() {
            let what = "textures without an attribute to rate";
            wrong(
                Fault::new(
                    what,
                    "add an [[attribute]] with name, question, low and high",
                )
                .at(&text.path),
            );
        }
        self.check_numbers(text, &mut wrong);
        self.check_textures(text, &mut wrong);
        let names = self
            .attributes
            .iter()
            .map(|it| (it, it.get_ref().name.as_str()));
        named(text, "attribute", names, &mut wrong);
        let names = self.forms.iter().map(|it| (it, it.get_ref().name.as_str()));
        named(text, "form", names, &mut wrong);
        faults
    }

    fn check_numbers(&self, text: &Text, wrong: &mut impl FnMut(Fault)) {
        let ratings = &self.ratings;
        let counts = [
            ("ratings.repeats", ratings.repeats, 1, 100),
            ("ratings.practice", ratings.practice, 0, 100),
            ("ratings.catch", ratings.catch_trials, 0, 100),
            (
                "prompts.count",
                self.prompts.as_ref().map_or(1, |it| it.count),
                1,
                100,
            ),
            (
                "prompts.refinements",
                self.prompts.as_ref().map_or(0, |it| it.refinements),
                0,
                10,
            ),
        ];
        for (field, value, least, most) in counts {
            if !(least..=most).contains(&value) {
                let fault = Fault::new(value, format!("give {least} to {most}"));
                wrong(fault.at(&text.path).field(field));
            }
        }
        let Simulate {
            noise,
            bias,
            dominance,
            spread,
        } = self.simulate;
        let reals = [
            ("explore.seconds", self.explore.seconds, 0.0, 600.0),
            ("ratings.break_s", ratings.break_s, 0.0, 3600.0),
            ("simulate.noise", noise, 0.0, 100.0),
            ("simulate.bias", bias, 0.0, 100.0),
            ("simulate.dominance", dominance, -0.5, 0.5),
            ("simulate.spread", spread, 0.0, 1.0),
        ];
        for (field, value, least, most) in reals {
            if !(least..=most).contains(&value) {
                let fault = Fault::new(value, format!("give {least} to {most}"));
                wrong(fault.at(&text.path).field(field));
            }
        }
    }

    fn check_textures(&self, text: &Text, wrong: &mut impl FnMut(Fault)) {
        let names = self
            .textures
            .iter()
            .map(|it| (it, it.get_ref().name.as_str()));
        named(text, "texture", names, wrong);
        for (at, entry) in self.textures.iter().enumerate() {
            let TextureEntry {
                prompt,
                file,
                between,
                t,
                ..
            } = entry.get_ref();
            let sources = [prompt.is_some(), file.is_some(), between.is_some()];
            if sources.into_iter().filter(|is| *is).count() != 1 {
                let what = "not one source of this texture".to_owned();
                wrong(text.fault(
                    entry,
                    format!("texture[{at}]"),
                    what,
                    "give one of prompt, file and between",
                ));
            }
            if !(0.0..=1.0).contains(t) {
                let what = format!("{t} between two textures");
                wrong(text.fault(entry, format!("texture[{at}].t"), what, "give 0 to 1"));
            }
            for other in between.iter().flatten() {
                let mut earlier = self.textures[..at]
                    .iter()
                    .map(|it| it.get_ref().name.as_str());
                if !earlier.any(|name| name == other) {
                    let all = self.textures.iter().map(|it| it.get_ref().name.as_str());
                    let like = suggestion(other, all);
                    let what = format!("no texture `{other}` stands before this one");
                    let remedy = "name two textures that stand above it in the file";
                    wrong(
                        text.fault(entry, format!("texture[{at}].between"), what, remedy)
                            .suggest(like),
                    );
                }
            }
        }
        let anchors = self
            .textures
            .iter()
            .filter(|it| it.get_ref().anchor)
            .count();
        if self.midpoints && anchors < 2 {
            let what = format!("midpoints of {anchors} anchors");
            wrong(
                Fault::new(what, "set anchor = true for two textures or more")
                    .at(&text.path)
                    .field("midpoints"),
            );
        }
        let rated = self.textures.len()
            + if self.midpoints {
                anchors * anchors.saturating_sub(1) / 2
            } else {
                0
            };
        if self.ratings_of(rated) > MOST_RATINGS {
            let what = format!("{} ratings a participant", self.ratings_of(rated));
            wrong(
                Fault::new(what, format!("ask for at most {MOST_RATINGS}"))
                    .at(&text.path)
                    .field("ratings"),
            );
        }
        if self.ratings.catch_trials > rated && rated > 0 {
            let what = format!("{} ratings to repeat of {rated}", self.ratings.catch_trials);
            wrong(
                Fault::new(what, "repeat fewer")
                    .at(&text.path)
                    .field("ratings.catch"),
            );
        }
    }
}

/// Names that become names of files or columns, each of them once.
fn named<'a, T: 'a>(
    text: &Text,
    kind: &str,
    entries: impl Iterator<Item = (&'a Spanned<T>, &'a str)>,
    wrong: &mut impl FnMut(Fault),
) {
    let mut seen: Vec<&str> = Vec::new();
    for (at, (entry, name)) in entries.enumerate() {
        let field = format!("{kind}[{at}].name");
        if !is_name(name) {
            let what = format!("`{name}` cannot be a name here");
            wrong(text.fault(entry, field, what, "give 1 to 40 letters, digits, - and _"));
        } else if seen.iter().any(|other| other.eq_ignore_ascii_case(name)) {
            let what = format!("two {kind}s are named `{name}`");
            wrong(text.fault(entry, field, what, "name one of them otherwise"));
        }
        seen.push(name);
    }
}

fn is_word(name: &str) -> bool {
    (1..=40).contains(&name.len()) && name.bytes().all(|b| b.is_ascii_alphanumeric())
}

fn is_name(name: &str) -> bool {
    let letter = |b: u8| b.is_ascii_alphanumeric() || b == b'-' || b == b'_';
    (1..=40).contains(&name.len()) && name.bytes().all(letter)
}
