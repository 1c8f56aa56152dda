//! Explanation of a reading: the role assigned to each word of a prompt.

use super::Reading;
use crate::{
    lexicon::is_name,
    phrase::{self, Changes, Phrase},
    words::{grade::Grade, singular},
};
use serde::Serialize;

/// Role assigned to a word, or to several that form a name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Interpretation {
    /// The words as they were read.
    pub text: String,
    /// `name`, `number`, `quality`, `degree`, or `word` for any other word that is encoded; for words that are not,
    /// `object` for the carrier of the surface, `denied`, `tool`, or `left out`.
    pub role: &'static str,
}

impl Reading {
    /// Returns the role of every word, those that are not encoded at the end.
    #[must_use]
    pub fn interpretations(&self) -> Vec<Interpretation> {
        let role = |text: &String| match text.as_str() {
            text if Grade::of(text).is_some() => "number",
            text if phrase::is_quality(text) => "quality",
            text if is_name(text) => "name",
            text if phrase::is_degree(text) => "degree",
            _ => "word",
        };
        let kept = self.words.iter().map(|text| (text, role(text)));
        let others = self.others.iter().map(|(role, text)| (text, role.name()));
        let said = |text: &&String| {
            let mut others = self.others.iter();
            others.any(|(_, other)| {
                other
                    .split(' ')
                    .any(|word| singular(word) == singular(text))
            })
        };
        let gone = self.ignored.iter().filter(|text| !said(text));
        let gone = gone.map(|text| (text, "left out")).chain(others);
        let interpretation = |(text, role): (&String, _)| Interpretation {
            text: text.clone(),
            role,
        };
        kept.chain(gone).map(interpretation).collect()
    }

    /// Returns the meaning of the words together, in a line.
    #[must_use]
    pub fn together(&self) -> String {
        match &self.phrase {
            Phrase::Plain if self.words.iter().all(|word| is_name(word)) => self.words.join(" "),
            Phrase::Plain if self.says => format!("what its words lie near: {}", self.text()),
            Phrase::Plain => "nothing that names something, or says how it feels".into(),
            Phrase::Changed { base, changes } => format!("{base}, {}", moved(changes)),
            Phrase::Graded { base, grades } => {
                let grades: Vec<String> = grades.iter().map(Grade::to_string).collect();
                format!("{base} at {}", grades.join(", "))
            }
            Phrase::Made { material, object } => {
                format!("stroked as {material}, and yielding as {object} of it")
            }
            Phrase::Part { name, part } => format!("{part}, as rough, slippery and hard as {name}"),
            Phrase::Between(first, second) => format!("half way between {first} and {second}"),
            Phrase::Covered { inside, cover } => {
                format!("stroked as {cover}, and yielding as {inside} under it")
            }
        }
    }
}

/// Changes in steps: "rough +1.0 to +1.5 steps".
fn moved(changes: &Changes) -> String {
    let all = [
        ("rough", changes.rough),
        ("slippery", changes.slippery),
        ("hard", changes.hard),
    ];
    let moved = all.into_iter().filter_map(|(attribute, change)| {
        let change = change?;
        Some(format!(
            "{attribute} {:+.1} to {:+.1} steps",
            change.least, change.most
        ))
    });
    moved.collect::<Vec<_>>().join(", ")
}
