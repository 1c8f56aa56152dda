//! The values of fields, each of its type and in its range. What is not is a fault, and the check
//! goes on.

use super::{
    entry::EntryLocation,
    row::{Field, Value},
};
use crate::{
    edit_memory::Sliders,
    passes::{reduce::Fidelity, rerate},
    sources::{
        Registry,
        latents::{Edit, not_understood},
        prompt::phrase::relative,
    },
    views::preview,
};
use asperity_io::{diagnostic::Fault, input::Reach, shown::suggestion};
use std::path::Path;

/// Remedy for a path that leaves the folder of its list.
pub(crate) const CONFINED_REMEDY: &str =
    "copy the file next to the manifest, or leave out --confined if you trust its author";

/// Keys of a texture's options.
pub(super) const OPTIONS: [&str; 6] = ["seed", "fidelity", "rate", "preview", "loudness", "edit"];
/// Accepted values of `preview`.
const PREVIEW: &str = "true, false or a size";
/// Range of `loudness`, dB re 1 N RMS.
const LOUDNESS_DB: (f64, f64) = (-120.0, 0.0);

/// Options as far as a row or the defaults state them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct PartialOptions {
    pub(super) seed: Option<u64>,
    pub(super) fidelity: Option<Fidelity>,
    pub(super) rate_hz: Option<f64>,
    /// Pixels, 0 for none.
    pub(super) preview_px: Option<u32>,
    pub(super) loudness_db: Option<f64>,
    pub(super) edit: Option<Edit>,
    /// Options that only some sources have.
    pub(super) own: Vec<Field>,
}

impl PartialOptions {
    /// These, and `outer` where they say nothing.
    pub(super) fn within(&self, outer: &Self) -> Self {
        Self {
            seed: self.seed.or(outer.seed),
            fidelity: self.fidelity.or(outer.fidelity),
            rate_hz: self.rate_hz.or(outer.rate_hz),
            preview_px: self.preview_px.or(outer.preview_px),
            loudness_db: self.loudness_db.or(outer.loudness_db),
            edit: self.edit.clone().or_else(|| outer.edit.clone()),
            own: {
                let said = |field: &&Field| !self.own.iter().any(|own| own.key == field.key);
                let outer = outer.own.iter().filter(said);
                self.own.iter().chain(outer).cloned().collect()
            },
        }
    }
}

/// Takes the faults of a file.
pub(super) struct Checker<'a> {
    pub(super) file: &'a EntryLocation,
    pub(super) folder: &'a Path,
    pub(super) reach: &'a Reach,
    pub(super) errors: &'a mut Vec<Fault>,
    pub(super) registry: &'a Registry,
    /// Columns of a CSV file that are no keys, and are reported already.
    pub(super) columns: Vec<String>,
}

impl Checker<'_> {
    pub(super) fn fault(&mut self, line: usize, key: &str, fault: Fault) {
        self.errors.push(self.file.fault(line, key, fault));
    }

    /// Returns true if the manifest may name a path, and else reports a fault. A folder is checked with all its
    /// contents.
    pub(super) fn reaches(&mut self, field: &Field, key: &str, stated: &str, folder: bool) -> bool {
        let (path, seen) = (Path::new(stated), self.folder.join(stated));
        let checked = if folder {
            self.reach.check_folder(path, &seen)
        } else {
            self.reach.check(path, &seen)
        };
        if let Err(outside) = checked {
            let what =
                format!("{stated:?} is {outside}, and the manifest is confined to its folder");
            self.fault(field.line, key, Fault::new(what, CONFINED_REMEDY));
        }
        checked.is_ok()
    }

    pub(super) fn text<'v>(&mut self, field: &'v Field, key: &str) -> Option<&'v str> {
        match &field.value {
            Value::Text(text) => Some(text),
            other => self.wrong_type(field.line, key, "a text", other),
        }
    }

    pub(super) fn wrong_type<T>(
        &mut self,
        line: usize,
        key: &str,
        wanted: &str,
        found: &Value,
    ) -> Option<T> {
        self.fault(line, key, of_type(wanted, found.kind()));
        None
    }

    fn wrong_value<T>(
        &mut self,
        line: usize,
        key: &str,
        wanted: String,
        found: String,
    ) -> Option<T> {
        let what = format!("{found:?} must be {wanted}");
        self.fault(line, key, Fault::new(what, "correct the value"));
        None
    }

    pub(super) fn number(
        &mut self,
        field: &Field,
        key: &str,
        (low, high): (f64, f64),
        untyped: bool,
    ) -> Option<f64> {
        let number = match &field.value {
            Value::Number(number) => *number,
            Value::Whole(number) => *number as f64,
            // A text that is none is a NaN, which is in no range.
            Value::Text(text) if untyped => text.trim().parse().unwrap_or(f64::NAN),
            other => return self.wrong_type(field.line, key, "a number", other),
        };
        if (low..=high).contains(&number) {
            Some(number)
        } else {
            let wanted = format!("a number from {low} to {high}, with a point before its fraction");
            self.wrong_value(field.line, key, wanted, field.value.shown())
        }
    }

    /// A whole number, also where it is written as 3.0 or 1E+05.
    fn whole(&mut self, field: &Field, key: &str, untyped: bool) -> Option<u64> {
        const WANTED: &str = "a whole number, 0 or more";
        match &field.value {
            Value::Whole(_) | Value::Number(_) => {}
            Value::Text(_) if untyped => {}
            other => return self.wrong_type(field.line, key, WANTED, other),
        }
        field.value.whole(untyped).or_else(|| {
            let wanted = format!("{WANTED}, in digits alone, such as 1000");
            self.wrong_value(field.line, key, wanted, field.value.shown())
        })
    }

    /// `false` for 0 pixels, `true` for the usual size, or a size.
    fn preview(&mut self, field: &Field, untyped: bool) -> Option<u32> {
        let is = |text: &str, word: &str| untyped && text.trim().eq_ignore_ascii_case(word);
        match &field.value {
            Value::Bool(drawn) => return Some(if *drawn { preview::SIZE } else { 0 }),
            // Spreadsheets write them in capitals.
            Value::Text(text) if is(text, "true") => return Some(preview::SIZE),
            Value::Text(text) if is(text, "false") => return Some(0),
            Value::Whole(_) | Value::Number(_) => {}
            Value::Text(_) if untyped => {}
            other => return self.wrong_type(field.line, "preview", PREVIEW, other),
        }
        let size = field
            .value
            .whole(untyped)
            .and_then(|size| u32::try_from(size).ok());
        let drawn = size.filter(|size| preview::SIZES.contains(size));
        drawn.or_else(|| {
            let (low, high) = (preview::SIZES.start(), preview::SIZES.end());
            let wanted = format!("{PREVIEW} of {low} to {high} pixels");
            self.wrong_value(field.line, "preview", wanted, field.value.shown())
        })
    }

    pub(super) fn unknown(&mut self, field: &Field, prefix: &str, known: &[&str]) {
        let key = format!("{prefix}{}", field.key);
        self.fault(field.line, &key, unknown_key(field, known));
    }

    /// Reports a key that does not go with the source.
    pub(super) fn misplaced(&mut self, line: usize, key: &str, origin: &str) {
        let what = format!("cannot be combined with {origin}");
        self.fault(line, key, Fault::new(what, "remove the key"));
    }

    /// Reads an option. Returns true if the key is one.
    pub(super) fn option(
        &mut self,
        field: &Field,
        untyped: bool,
        stated: &mut PartialOptions,
    ) -> bool {
        let key = field.key.as_str();
        match key {
            "seed" => stated.seed = self.whole(field, key, untyped),
            "fidelity" => stated.fidelity = self.fidelity(field, untyped),
            "rate" => {
                stated.rate_hz = self.number(field, key, rerate::RATE_RANGE_HZ, untyped);
            }
            "preview" => stated.preview_px = self.preview(field, untyped),
            "loudness" => {
                stated.loudness_db = self.number(field, key, LOUDNESS_DB, untyped);
            }
            "edit" => stated.edit = self.edit(field, untyped),
            _ if self.registry.options().any(|own| own == key) => stated.own.push(field.clone()),
            _ => return false,
        }
        true
    }

    fn fidelity(&mut self, field: &Field, untyped: bool) -> Option<Fidelity> {
        let text = match (field.value.whole(untyped), &field.value) {
            (Some(order), _) => order.to_string(),
            (None, Value::Text(text)) => text.trim().to_owned(),
            (None, Value::Number(number)) => number.to_string(),
            (None, other) => {
                return self.wrong_type(field.line, "fidelity", "full, auto or an order", other);
            }
        };
        match text.parse() {
            Ok(fidelity) => Some(fidelity),
            Err(wanted) => self.wrong_value(field.line, "fidelity", wanted, text),
        }
    }

    fn edit(&mut self, field: &Field, untyped: bool) -> Option<Edit> {
        const KEYS: [&str; 5] = ["rougher", "sharper", "harder", "slipperier", "prompt"];
        let Value::Table(inner) = &field.value else {
            return self.wrong_type(field.line, "edit", "a table", &field.value);
        };
        if let Some(words) = inner.iter().find(|inner| inner.key == "prompt") {
            return self.words(words, inner, &KEYS);
        }
        let mut sliders = Sliders::default();
        for slider in inner {
            let place = match slider.key.as_str() {
                "rougher" => &mut sliders.rougher,
                "sharper" => &mut sliders.sharper,
                "harder" => &mut sliders.harder,
                "slipperier" => &mut sliders.slipperier,
                _ => {
                    self.unknown(slider, "edit.", &KEYS);
                    continue;
                }
            };
            let key = format!("edit.{}", slider.key);
            let range = (-Sliders::LARGEST, Sliders::LARGEST);
            if let Some(step) = self.number(slider, &key, range, untyped) {
                *place = step;
            }
        }
        Some(Edit::Steps(sliders))
    }

    /// An edit in words, which has no sliders beside it.
    fn words(&mut self, words: &Field, inner: &[Field], known: &[&str]) -> Option<Edit> {
        for other in inner.iter().filter(|other| other.key != "prompt") {
            if known.contains(&other.key.as_str()) {
                let key = format!("edit.{}", other.key);
                self.misplaced(other.line, &key, "edit.prompt");
            } else {
                self.unknown(other, "edit.", known);
            }
        }
        let text = self.text(words, "edit.prompt")?.trim();
        if relative(text).is_nothing() {
            let fault = not_understood(format_args!("{text:?}"));
            self.fault(words.line, "edit.prompt", fault);
            return None;
        }
        Some(Edit::Words(text.to_owned()))
    }
}

/// Returns the fault of a value of another type.
pub(super) fn of_type(wanted: &str, found: &str) -> Fault {
    let what = format!("must be {wanted}, but is {found}");
    Fault::new(what, "correct the value")
}

/// Returns the fault of a key that is not known there.
pub(super) fn unknown_key(field: &Field, known: &[&str]) -> Fault {
    let what = format!("no such key; known keys are {}", known.join(", "));
    let suggestion = suggestion(&field.key, known.iter().copied());
    Fault::new(what, "correct the key, or remove it").suggest(suggestion)
}
