//! Records of a list: cells between separators, as spreadsheets write them.
//!
//! It is stricter than CSV readers usually are, because what they forgive loses rows: a quote that is
//! never closed, text behind a closing quote, and a quote that takes in whole rows are errors.

use std::ops::Range;

/// Separators that a header may choose; the first of those that occur equally often is taken.
const SEPARATORS: [char; 3] = [',', ';', '\t'];

/// A line of a text, 1-based, and why it cannot be read.
pub(super) type Broken = (usize, String);

/// The cells of one record, and the line where it begins.
#[derive(Debug, PartialEq)]
pub(super) struct Record {
    pub(super) line: usize,
    pub(super) cells: Vec<String>,
}

impl Record {
    /// Returns true if all cells are empty: spreadsheets write such rows below a table.
    pub(super) fn is_blank(&self) -> bool {
        self.cells.iter().all(|cell| cell.trim().is_empty())
    }
}

/// Reads one record after the other.
pub(super) struct Records<'t> {
    text: &'t str,
    at: usize,
    line: usize,
    separator: char,
    /// Where the cells in quotes of the record lie.
    quotes: Vec<Range<usize>>,
    /// Cells of the header, once it was read.
    pub(super) columns: Option<usize>,
}

impl<'t> Records<'t> {
    /// The records of a text, whose header decides the separator; a first line `sep=;`, as
    /// spreadsheets write it, decides before.
    pub(super) fn new(text: &'t str) -> Self {
        let mut records = Self {
            text,
            at: 0,
            line: 1,
            separator: ',',
            quotes: Vec::new(),
            columns: None,
        };
        let first = text.lines().next().unwrap_or_default();
        let stated = first
            .strip_prefix("sep=")
            .map(|rest| rest.trim_end_matches('\r'));
        let stated = stated.and_then(|rest| rest.parse::<char>().ok());
        if let Some(separator) = stated.filter(|c| SEPARATORS.contains(c)) {
            records.separator = separator;
            records.at = first.trim_end_matches('\r').len();
            records.line_break();
        } else {
            records.separator = separator(text.trim_start());
        }
        records
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    /// Steps over one line break, if there is one: LF, CR LF, or CR alone.
    fn line_break(&mut self) -> bool {
        let rest = self.rest();
        let length = match rest.as_bytes() {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            _ => return false,
        };
        self.at += length;
        self.line += 1;
        true
    }

    /// Steps over spaces, and over tabs where they separate nothing.
    fn spaces(&mut self) {
        let separator = self.separator;
        let is_space = |c: char| matches!(c, ' ' | '\t') && c != separator;
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start_matches(is_space).len();
    }

    fn cell(&mut self) -> Result<String, Broken> {
        let start = self.at;
        self.spaces();
        if self.rest().starts_with('"') {
            return self.quoted();
        }
        self.at = start;
        let rest = self.rest();
        let ends = |c: char| c == self.separator || c == '\n' || c == '\r';
        let length = rest.find(ends).unwrap_or(rest.len());
        self.at += length;
        Ok(rest[..length].to_owned())
    }

    /// A cell in quotes, in which a doubled quote is one quote.
    fn quoted(&mut self) -> Result<String, Broken> {
        let (start, opened) = (self.at, self.line);
        let mut cell = String::new();
        loop {
            self.at += 1;
            let rest = self.rest();
            let Some(length) = rest.find('"') else {
                let message = "a quote is opened in this line and never closed".to_owned();
                return Err((opened, message));
            };
            cell.push_str(&rest[..length]);
            self.line += breaks(&rest[..length]);
            self.at += length + 1;
            if !self.rest().starts_with('"') {
                break;
            }
            cell.push('"');
        }
        self.quotes.push(start..self.at);
        self.spaces();
        if self.rest().starts_with([self.separator, '\n', '\r']) || self.rest().is_empty() {
            return Ok(cell);
        }
        let closed = self.line;
        let message = format!(
            "text follows the quote that is opened in this line and closed in line {closed}; \
             within quotes, a quote is written twice"
        );
        Err((opened, message))
    }

    /// Refuses a record of several lines one of which is a row by itself: its quote was forgotten.
    /// A separator in quotes before a space or a line break is punctuation.
    fn swallowed(&self, range: Range<usize>, line: usize) -> Result<(), Broken> {
        let Some(columns) = self.columns else {
            return Ok(());
        };
        let mut at = range.start;
        for content in self.text[range.clone()].split_inclusive(is_break) {
            let (mut inside, mut outside) = (0, 0);
            for (offset, _) in content.match_indices(self.separator) {
                let rest = &content[offset + self.separator.len_utf8()..];
                if !self
                    .quotes
                    .iter()
                    .any(|quoted| quoted.contains(&(at + offset)))
                {
                    outside += 1;
                } else if !(rest.is_empty() || rest.starts_with([' ', '\n', '\r'])) {
                    inside += 1;
                }
            }
            if (inside > 0 || columns == 1) && inside + outside + 1 == columns {
                let number = line + breaks(&self.text[range.start..at]);
                let message = format!(
                    "a quote takes in line {number}, which has the cells of a row; close the \
                     quote that is opened here, or write the cell in one line"
                );
                return Err((line, message));
            }
            at += content.len();
        }
        Ok(())
    }
}

impl Iterator for Records<'_> {
    type Item = Result<Record, Broken>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest().is_empty() {
            return None;
        }
        let (start, line) = (self.at, self.line);
        self.quotes.clear();
        let mut cells = Vec::new();
        loop {
            match self.cell() {
                Ok(cell) => cells.push(cell),
                Err(broken) => {
                    self.at = self.text.len();
                    return Some(Err(broken));
                }
            }
            if !self.rest().starts_with(self.separator) {
                break;
            }
            self.at += self.separator.len_utf8();
        }
        let swallowed = if self.line > line {
            self.swallowed(start..self.at, line)
        } else {
            Ok(())
        };
        self.line_break();
        Some(swallowed.map(|()| Record { line, cells }))
    }
}

/// The separator of a header: the one that it has most of, outside quotes.
fn separator(text: &str) -> char {
    let mut counts = [0; SEPARATORS.len()];
    let mut quoted = false;
    for c in text.chars() {
        match c {
            '"' => quoted = !quoted,
            '\n' | '\r' if !quoted => break,
            _ if quoted => {}
            _ => {
                let at = SEPARATORS.iter().position(|separator| *separator == c);
                at.into_iter().for_each(|at| counts[at] += 1);
            }
        }
    }
    let most = counts.iter().copied().max().unwrap_or_default();
    let first = counts.iter().position(|count| *count == most);
    SEPARATORS[first.unwrap_or_default()]
}

fn is_break(c: char) -> bool {
    matches!(c, '\n' | '\r')
}

/// Line breaks of a text.
fn breaks(text: &str) -> usize {
    let ends = text.matches(is_break).count();
    ends - text.matches("\r\n").count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str, columns: usize) -> Result<Vec<(usize, Vec<String>)>, Broken> {
        let mut records = Records::new(text);
        records.columns = Some(columns);
        records
            .map(|record| record.map(|record| (record.line, record.cells)))
            .collect()
    }

    fn cells(text: &str, columns: usize) -> Vec<Vec<String>> {
        let records = all(text, columns).unwrap();
        records.into_iter().map(|(_, cells)| cells).collect()
    }

    #[test]
    fn cells_are_what_a_spreadsheet_shows() {
        for (text, want) in [
            ("a,b\n", vec!["a", "b"]),
            ("a;b,c", vec!["a;b", "c"]),
            ("a;b;\"c,d\"", vec!["a", "b", "c,d"]),
            ("a\t\"b\tc\"\t", vec!["a", "b\tc", ""]),
            (
                "\"a \"\"quoted\"\" word\", \"b\" ,2\" pipe",
                vec!["a \"quoted\" word", "b", "2\" pipe"],
            ),
            ("sep=;\r\na,b;c", vec!["a,b", "c"]),
        ] {
            assert_eq!(cells(text, 9), [want], "{text:?}");
        }
    }

    #[test]
    fn every_record_knows_its_line() {
        for end in ["\n", "\r\n", "\r"] {
            let text = ["a,b,c", "\"wet,", "ice\",x,y", "", "p,q,r"].join(end);
            let found = all(&text, 3).unwrap();
            let lines: Vec<usize> = found.iter().map(|(line, _)| *line).collect();
            assert_eq!(lines, [1, 2, 4, 5], "{end:?}");
            assert_eq!(found[1].1[0], format!("wet,{end}ice"));
        }
    }

    #[test]
    fn a_quote_that_is_left_open_is_named_where_it_opens() {
        for (text, line, what) in [
            ("a,b\nc,\"d\ne,f\ng,h\n", 2, "never closed"),
            ("a,b\nc,\"d\ne,\"f\ng,h\n", 2, "closed in line 3"),
            ("a,b\nc,\"d\ne,f\"\ng,h\n", 2, "takes in line 3"),
            ("a,b\n\"c,d\ne\",f\n", 2, "takes in line 2"),
            ("a,b\nc,\"d\"e\n", 2, "closed in line 2"),
            ("\"a,b\nc,d\n", 1, "never closed"),
        ] {
            let (found, message) = all(text, 2).unwrap_err();
            assert_eq!(found, line, "{text:?}: {message}");
            assert!(message.contains(what), "{text:?}: {message}");
        }
    }
}
