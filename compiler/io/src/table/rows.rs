//! Which separator parts the rows, which columns hold numbers, and which line names them.

use super::cell::{has_decimal_comma, label, number, seconds};
use csv::{ReaderBuilder, StringRecord, Trim};

/// Rows that tell the separator: the last ones of the head.
const SAMPLE: usize = 32;
/// Part of the numbers of a usual row that the first one has.
const FIRST_ROW: f64 = 0.5;
/// Prefixes of comments; `#` begins one anywhere.
pub(super) const COMMENTS: [char; 3] = ['#', '%', '/'];

/// A line of the head: its number from 1, its text and the bytes up to its end.
pub(super) struct Line {
    pub(super) number: u64,
    pub(super) text: String,
    pub(super) end: usize,
}

/// Separator of the columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    /// A single occurrence of this byte.
    Byte(u8),
    /// Spaces and tabs, however many.
    Blanks,
}

impl Separator {
    /// The first of those that do equally well.
    const ALL: [Self; 4] = [
        Self::Byte(b','),
        Self::Byte(b';'),
        Self::Byte(b'\t'),
        Self::Blanks,
    ];

    pub(super) const fn byte(self) -> u8 {
        match self {
            Self::Byte(byte) => byte,
            Self::Blanks => b'\t',
        }
    }

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Byte(b',') => "commas",
            Self::Byte(b';') => "semicolons",
            Self::Byte(b'\t') => "tabs",
            Self::Byte(_) => "characters of its own",
            Self::Blanks => "spaces",
        }
    }

    /// The fields of a line.
    pub(super) fn fields(self, line: &str) -> Vec<String> {
        if self == Self::Blanks {
            return line.split_whitespace().map(str::to_owned).collect();
        }
        let mut reader = ReaderBuilder::new()
            .delimiter(self.byte())
            .has_headers(false)
            .trim(Trim::All)
            .from_reader(line.as_bytes());
        let mut record = StringRecord::new();
        // A text in memory that is UTF-8 can be read.
        let _ = reader.read_record(&mut record);
        record.iter().map(str::to_owned).collect()
    }
}

/// The rows as a separator parts them.
pub(super) struct Rows {
    pub(super) separator: Separator,
    pub(super) width: usize,
    /// Numbers and times in a hundred thousand fields.
    pub(super) numbers: usize,
    pub(super) labelled: bool,
    pub(super) decimal_comma: bool,
    /// Which columns hold numbers.
    pub(super) numeric: Vec<bool>,
}

impl Rows {
    pub(super) fn of(plain: &[&Line], stated: Option<Separator>) -> Self {
        let sample = &plain[plain.len().saturating_sub(SAMPLE)..];
        let all = stated.map_or(Separator::ALL.to_vec(), |separator| vec![separator]);
        let parted = all
            .into_iter()
            .map(|separator| Self::parted(sample, separator));
        let none = Self::parted(&[], Separator::Byte(b','));
        // The first of those that are equal.
        parted.fold(none, |best, next| {
            let better = (next.numbers, next.width.min(2)) > (best.numbers, best.width.min(2));
            // A text may hold blanks, and numbers between them.
            let is_text = next.separator == Separator::Blanks && next.numeric.contains(&false);
            if better && !(is_text && best.width > 1) || best.width == 0 {
                next
            } else {
                best
            }
        })
    }

    fn parted(sample: &[&Line], separator: Separator) -> Self {
        let parted: Vec<Vec<String>> = sample
            .iter()
            .map(|line| separator.fields(&line.text))
            .collect();
        let count = |width: usize| parted.iter().filter(|row| row.len() == width).count();
        let widths = parted.iter().map(Vec::len);
        // The widest of those that are equal: the rows stand behind narrower lines.
        let width = widths
            .max_by_key(|&width| (count(width), width))
            .unwrap_or(0);
        let rows: Vec<&Vec<String>> = parted.iter().filter(|row| row.len() == width).collect();
        let labelled = !rows.is_empty()
            && rows
                .iter()
                .all(|row| row.iter().all(|field| label(field).is_some()));
        let surely = separator == Separator::Byte(b',');
        let decimal_comma = width > 1
            && rows
                .iter()
                .flat_map(|row| row.iter())
                .any(|field| has_decimal_comma(field, surely));
        let is_number = |field: &String| number(field, decimal_comma).is_some() || labelled;
        let share = |column: usize| rows.iter().filter(|row| is_number(&row[column])).count();
        let numeric = (0..width).map(|column| 2 * share(column) > rows.len());
        let all: usize = parted.iter().map(Vec::len).sum();
        let is_told = |field: &&String| is_number(field) || seconds(field).is_some();
        let numbers = rows
            .iter()
            .flat_map(|row| row.iter())
            .filter(is_told)
            .count();
        Self {
            separator,
            width,
            numbers: 100_000 * numbers / all.max(1),
            labelled,
            decimal_comma,
            numeric: numeric.collect(),
        }
    }

    /// The fields of a header, which may have a separator of its own over columns that blanks separate. Anywhere
    /// else, two separators mean that the one of the rows is wrong.
    pub(super) fn names(&self, text: &str) -> Vec<String> {
        let own = self.separator.fields(text);
        if self.separator != Separator::Blanks || self.fits(&own) {
            return own;
        }
        let parted = text
            .split("  ")
            .map(str::trim)
            .filter(|name| !name.is_empty());
        let others = Separator::ALL.into_iter().map(|other| other.fields(text));
        let mut others = others.chain([parted.map(str::to_owned).collect()]);
        others
            .find(|names| names.len() == self.width)
            .unwrap_or(own)
    }

    /// Returns true if there are as many names as columns; LabVIEW names one more, for comments. NumPy writes names
    /// with commas over columns that blanks separate: these are not parted yet.
    pub(super) fn fits(&self, names: &[String]) -> bool {
        let count = names.len();
        let is_parted = !names.iter().any(|name| name.ends_with([',', ';']));
        let has_comment = || count == self.width + 1 && is_remark(&names[self.width]);
        is_parted && (count == self.width || has_comment())
    }

    /// Fraction of the numeric columns that hold no word in a line; `None` for a line of another width or without a
    /// number.
    fn filled(&self, text: &str) -> Option<f64> {
        let fields = self.separator.fields(text);
        let has_end = fields.len() == self.width + 1;
        if fields.len() != self.width && !has_end {
            return None;
        }
        let numeric: Vec<usize> = (0..self.width).filter(|&at| self.numeric[at]).collect();
        let told = numeric.iter().filter(|&&at| !fields[at].is_empty());
        let (numbers, words): (Vec<usize>, Vec<usize>) =
            told.partition(|&&at| number(&fields[at], self.decimal_comma).is_some());
        let part = 1.0 - words.len() as f64 / numeric.len().max(1) as f64;
        (!numbers.is_empty()).then_some(part)
    }

    /// The places of the header and of the first row among the lines that are no comments.
    pub(super) fn header(
        &self,
        plain: &[&Line],
        is_unit: &dyn Fn(&str) -> bool,
    ) -> (Option<usize>, Option<usize>) {
        if !self.numeric.contains(&true) {
            // All is text, or the header is all there is.
            return ((!plain.is_empty()).then_some(0), None);
        }
        let first = plain.iter().position(|line| {
            self.filled(&line.text)
                .is_some_and(|part| part >= FIRST_ROW)
        });
        let names_then = |least: f64, words_alone: bool| {
            (0..plain.len().saturating_sub(1)).find(|&at| {
                let names = self.names(&plain[at].text);
                let is_named = |at: usize| !is_number(&names[at]) && seconds(&names[at]).is_none();
                let numeric = (0..self.width).filter(|&at| self.numeric[at]);
                if !self.fits(&names) || !names.iter().any(|name| !name.is_empty()) {
                    return false;
                }
                let named = if words_alone {
                    !names.iter().any(|name| !name.is_empty() && is_number(name))
                } else {
                    numeric.clone().any(is_named)
                };
                let units = self.separator.fields(&plain[at + 1].text);
                let below = at + 1 + usize::from(units_of(&units, self.width, is_unit));
                let part = plain.get(below).and_then(|line| self.filled(&line.text));
                named && part.is_some_and(|part| part >= least)
            })
        };
        let header = names_then(FIRST_ROW, true).or_else(|| names_then(1.0, false));
        // A header of another width, which the first row then contradicts.
        let odd = || {
            let before = first?.checked_sub(1)?;
            if plain[before].text.starts_with(COMMENTS) {
                return None;
            }
            let names = self.separator.fields(&plain[before].text);
            let words = names
                .iter()
                .all(|name| !name.is_empty() && !is_number(name));
            (words && (names.len() > 1 || self.width == 1)).then_some(before)
        };
        (header.or_else(odd), first)
    }
}

pub(super) fn is_number(text: &str) -> bool {
    !text.is_empty() && number(text, false).is_some()
}

/// Returns true for the name of a column of comments.
pub(super) fn is_remark(name: &str) -> bool {
    name.is_empty() || name.eq_ignore_ascii_case("comment") || name.eq_ignore_ascii_case("comments")
}

/// Returns true if the fields of a line form a row of units.
pub(super) fn units_of(fields: &[String], width: usize, is_unit: &dyn Fn(&str) -> bool) -> bool {
    let mut told = fields.iter().filter(|field| !field.is_empty()).peekable();
    fields.len() == width && told.peek().is_some() && told.all(|field| is_unit(field))
}
