//! Questionnaires: the public ones that are built in, and those that a file supplies.

use super::{
    design::{Design, FormEntry},
    text::Text,
};
use asperity_io::diagnostic::Fault;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::path::Path;

/// Letters of an answer in words.
const TEXT_LETTERS: usize = 4000;

/// A question of a form: a scale from `least` to `most`, or words.
#[derive(Debug, Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Item {
    pub(crate) name: String,
    pub(crate) question: String,
    #[serde(default)]
    pub(crate) low: String,
    #[serde(default)]
    pub(crate) high: String,
    #[serde(default = "one")]
    pub(crate) least: f64,
    #[serde(default = "seven")]
    pub(crate) most: f64,
    #[serde(default = "one")]
    pub(crate) step: f64,
    /// The factor whose mean it enters.
    #[serde(default)]
    pub(crate) factor: Option<String>,
    /// True if a high answer means little of its factor.
    #[serde(default)]
    pub(crate) reversed: bool,
    /// True if it is answered in words.
    #[serde(default)]
    pub(crate) text: bool,
}

fn one() -> f64 {
    1.0
}

fn seven() -> f64 {
    7.0
}

/// A questionnaire with its items.
#[derive(Debug, Clone)]
pub(crate) struct Form {
    pub(crate) name: String,
    pub(crate) heading: String,
    pub(crate) text: String,
    pub(crate) items: Vec<Item>,
    pub(crate) after: super::design::After,
}

/// A file of items.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Items {
    #[serde(rename = "item")]
    items: Vec<Item>,
}

/// The forms of a study whose file lies in `folder`.
///
/// # Errors
/// [`Fault`] for a form without items, a file that cannot be read, and impossible scales.
pub(crate) fn forms(design: &Design, text: &Text, folder: &Path) -> Result<Vec<Form>, Fault> {
    let entries = design.forms.iter().enumerate();
    let form = |(at, entry): (usize, &toml::Spanned<FormEntry>)| {
        let FormEntry {
            name,
            heading,
            text: about,
            file,
            items,
            after,
        } = entry.get_ref();
        let (built_in_heading, built_in) = built_in(name);
        let items = match file {
            Some(file) => Text::read(&folder.join(file))?.parse::<Items>()?.items,
            None if items.is_empty() => built_in,
            None => items.clone(),
        };
        let field = format!("form[{at}]");
        if items.is_empty() {
            let what = format!("the form `{name}` has no items");
            let remedy = "name tlx, usefulness or ease, or give it a file or [[form.item]] entries";
            return Err(text.fault(entry, field, what, remedy));
        }
        for (k, item) in items.iter().enumerate() {
            let sensible = item.least < item.most
                && item.step > 0.0
                && item.most.is_finite()
                && item.least.is_finite();
            let is_twice = items[..k].iter().any(|other| other.name == item.name);
            if !item.text && !sensible || is_twice || item.name.is_empty() {
                let what = format!(
                    "item {} of the form `{name}` has no scale or no name of its own",
                    k + 1
                );
                let remedy = "give it another name, and least < most with a positive step";
                return Err(text.fault(entry, field, what, remedy));
            }
        }
        Ok(Form {
            name: name.clone(),
            heading: heading.clone().unwrap_or(built_in_heading),
            text: about.clone(),
            items,
            after: *after,
        })
    };
    entries.map(form).collect()
}

impl Form {
    /// The form as the page gets it.
    pub(crate) fn shown(&self) -> Value {
        let items: Vec<Value> = self.items.iter().map(Item::shown).collect();
        json!({ "form": self.name, "heading": self.heading, "text": self.text, "items": items })
    }

    /// The answers in the order of the items.
    ///
    /// # Errors
    /// In words, for an answer that is missing, unknown or beyond its scale.
    pub(crate) fn checked(&self, given: &Map<String, Value>) -> Result<Value, String> {
        if let Some(unknown) = given
            .keys()
            .find(|key| self.items.iter().all(|item| item.name != **key))
        {
            return Err(format!("response.{unknown}: no such item"));
        }
        let mut response = Map::new();
        for item in &self.items {
            let answer = given.get(&item.name).filter(|answer| item.takes(answer));
            let answer =
                answer.ok_or_else(|| format!("response.{}: missing or impossible", item.name))?;
            response.insert(item.name.clone(), answer.clone());
        }
        Ok(response.into())
    }
}

impl Item {
    fn shown(&self) -> Value {
        let Self {
            name,
            question,
            low,
            high,
            least,
            most,
            step,
            ..
        } = self;
        if self.text {
            return json!({ "name": name, "question": question, "text": true });
        }
        json!({ "name": name, "question": question, "low": low, "high": high, "least": least, "most": most, "step": step })
    }

    fn takes(&self, answer: &Value) -> bool {
        if self.text {
            return answer
                .as_str()
                .is_some_and(|text| text.chars().count() <= TEXT_LETTERS);
        }
        answer
            .as_f64()
            .is_some_and(|number| (self.least..=self.most).contains(&number))
    }
}

/// Heading and items of the forms that are public: NASA-TLX (Hart & Staveland 1988), unweighted, and the paper's two questions
/// in words of our own.
fn built_in(name: &str) -> (String, Vec<Item>) {
    let scale =
        |name: &str, question: &str, [low, high]: [&str; 2], [least, most, step]: [f64; 3]| Item {
            name: name.into(),
            question: question.into(),
            low: low.into(),
            high: high.into(),
            least,
            most,
            step,
            factor: None,
            reversed: false,
            text: false,
        };
    let load = |name, question, ends| scale(name, question, ends, [0.0, 100.0, 5.0]);
    let likert = |name, question| {
        scale(
            name,
            question,
            ["strongly disagree", "strongly agree"],
            [1.0, 7.0, 1.0],
        )
    };
    match name {
        "tlx" => (
            "How was the work?".into(),
            vec![
                load(
                    "mental",
                    "How mentally demanding was the task?",
                    ["very low", "very high"],
                ),
                load(
                    "physical",
                    "How physically demanding was the task?",
                    ["very low", "very high"],
                ),
                load(
                    "temporal",
                    "How hurried or rushed was the pace of the task?",
                    ["very low", "very high"],
                ),
                load(
                    "performance",
                    "How successful were you in accomplishing what you were asked to do?",
                    ["perfect", "failure"],
                ),
                load(
                    "effort",
                    "How hard did you have to work to accomplish your level of performance?",
                    ["very low", "very high"],
                ),
                load(
                    "frustration",
                    "How insecure, discouraged, irritated, stressed and annoyed were you?",
                    ["very low", "very high"],
                ),
            ],
        ),
        "usefulness" => (
            "How useful was it?".into(),
            vec![
                likert(
                    "faster",
                    "With this tool I could make textures faster than without it.",
                ),
                likert(
                    "better",
                    "With this tool I could make better textures than without it.",
                ),
                likert("useful", "This tool would be useful in my work."),
            ],
        ),
        "ease" => (
            "How easy was it?".into(),
            vec![
                likert("learned", "It was easy to learn how to use this tool."),
                likert(
                    "controlled",
                    "It was easy to get the texture that I wanted.",
                ),
                likert("used", "This tool was easy to use."),
            ],
        ),
        _ => (String::new(), Vec::new()),
    }
}
