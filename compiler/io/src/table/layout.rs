//! Where the rows of a table are, what separates their columns, and how these are called.
//!
//! The rows tell: that separator is taken by which the most fields are numbers, and the header is the first line with
//! names for as many columns that rows follow. It may stand after `#`, behind a preamble, and before a row of units.

use super::{
    TableError,
    cell::label,
    rows::{COMMENTS, Line, Rows, Separator, is_number, is_remark, units_of},
};

/// Bytes in which the header is looked for, with all that comes before it; a binary file has no line end for long.
pub(super) const HEAD: usize = 64 * 1024;

/// The layout of a table, detected from its head.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Entries of the row of units below the header, per column; empty where there is no such row.
    pub units: Vec<String>,
    /// Entries of the rows above the header, per column, from top to bottom.
    pub groups: Vec<String>,
    /// Line of the header, from 1.
    pub header: u64,
    /// Separator of the columns.
    pub(super) separator: Separator,
    /// True if numbers have a comma in place of a point.
    pub decimal_comma: bool,
    /// True if each field is `name:value`.
    pub(super) labelled: bool,
    /// True if rows may end in a comment.
    pub(super) comment: bool,
    /// Columns that hold text.
    pub(super) texts: Vec<usize>,
    /// Bytes and lines before the first row.
    pub(super) start: u64,
    pub(super) lines: u64,
}

impl Layout {
    /// The layout of a table by its first bytes, at most 64 KiB. `is_unit` says whether a field may stand in a row of
    /// units.
    ///
    /// # Errors
    /// [`TableError`] where it is no text in UTF-8 or has no header.
    pub fn of(head: &[u8], is_unit: &dyn Fn(&str) -> bool) -> Result<Self, TableError> {
        if head.starts_with(&[0xff, 0xfe]) || head.starts_with(&[0xfe, 0xff]) {
            let remedy = "save it in UTF-8; Excel calls that \"CSV UTF-8\"";
            return Err(TableError::damaged(None, "is text in UTF-16", remedy));
        }
        if head.contains(&0) {
            let what = "is no text: it holds bytes of 0";
            return Err(TableError::damaged(None, what, "save it as CSV in UTF-8"));
        }
        let mut lines = lines(head);
        if head.len() == HEAD && !head.ends_with(b"\n") {
            // The last line may be cut.
            lines.pop();
        }
        let stated = lines.iter().take(3).find_map(|line| {
            match line.text.strip_prefix("sep=")?.as_bytes() {
                &[byte] => Some(Separator::Byte(byte)),
                _ => None,
            }
        });
        let told: Vec<&Line> = lines
            .iter()
            .filter(|line| !line.text.is_empty() && !line.text.starts_with("sep="))
            .collect();
        let plain: Vec<&Line> = told
            .iter()
            .copied()
            .filter(|line| !is_comment(line))
            .collect();
        let rows = Rows::of(&plain, stated);
        if rows.labelled {
            return Ok(Self::labelled(&rows, &plain));
        }
        let (header, first) = rows.header(&plain, is_unit);
        match (header, first) {
            (Some(header), _) => Ok(Self::below(&rows, &plain, header, is_unit)),
            (None, Some(first)) => Self::after_comment(&rows, &told, plain[first]),
            (None, None) => Err(TableError::damaged(
                Some(1),
                "has no header: no line in its first 64 KiB names columns",
                HEADER,
            )),
        }
    }

    /// Returns true if most rows hold text in a column.
    #[must_use]
    pub fn is_text(&self, column: usize) -> bool {
        self.texts.contains(&column)
    }

    fn new(rows: &Rows, columns: Vec<String>, line: &Line) -> Self {
        let texts = (0..rows.width).filter(|&at| !rows.numeric.get(at).is_none_or(|is| *is));
        Self {
            texts: texts.collect(),
            columns,
            units: Vec::new(),
            groups: Vec::new(),
            header: line.number,
            separator: rows.separator,
            decimal_comma: rows.decimal_comma,
            labelled: rows.labelled,
            comment: false,
            start: line.end as u64,
            lines: line.number,
        }
    }

    /// Rows that name their columns themselves.
    fn labelled(rows: &Rows, plain: &[&Line]) -> Self {
        let names = |line: &Line| -> Option<Vec<String>> {
            let fields = rows.separator.fields(&line.text);
            let names = fields.iter().map(|field| Some(label(field)?.0.to_owned()));
            names
                .collect::<Option<_>>()
                .filter(|_| fields.len() == rows.width)
        };
        let first = plain.iter().position(|line| names(line).is_some());
        let first = first.unwrap_or(0);
        let columns = names(plain[first]).unwrap_or_default();
        let mut layout = Self::new(rows, columns, plain[first]);
        layout.start = first
            .checked_sub(1)
            .map_or(0, |before| plain[before].end as u64);
        layout.lines = first
            .checked_sub(1)
            .map_or(0, |before| plain[before].number);
        layout
    }

    /// A header, the rows above it and the units below.
    fn below(rows: &Rows, plain: &[&Line], header: usize, is_unit: &dyn Fn(&str) -> bool) -> Self {
        let mut columns = rows.names(&plain[header].text);
        let comment = columns.len() == rows.width + 1 && is_remark(&columns[rows.width]);
        if comment {
            columns.pop();
        }
        let next_to = (1..=plain[header].number).rev();
        let above = plain[..header].iter().rev().zip(next_to);
        let above: Vec<Vec<String>> = above
            .take_while(|(line, number)| line.number + 1 == *number)
            .map(|(line, _)| rows.separator.fields(&line.text))
            .take_while(|fields| fields.len() == columns.len())
            .collect();
        let groups = (0..columns.len()).map(|at| {
            let parts = above.iter().rev().map(|fields| fields[at].as_str());
            parts
                .filter(|part| !part.is_empty())
                .collect::<Vec<_>>()
                .join(" ")
        });
        let mut layout = Self::new(rows, Vec::new(), plain[header]);
        layout.groups = if above.is_empty() {
            Vec::new()
        } else {
            groups.collect()
        };
        if let Some(below) = plain.get(header + 1) {
            let units = rows.separator.fields(&below.text);
            if units_of(&units, columns.len(), is_unit) {
                layout.units = units;
                layout.start = below.end as u64;
                layout.lines = below.number;
            }
        }
        layout.comment = comment;
        layout.columns = columns;
        layout
    }

    /// A header in the last comment before the first row that has as many names.
    fn after_comment(rows: &Rows, told: &[&Line], first: &Line) -> Result<Self, TableError> {
        let before = told.iter().take_while(|line| line.number < first.number);
        let before: Vec<&&Line> = before.collect();
        // With the separator of the rows first: any comment has words.
        let names = |line: &Line, own: bool| {
            let text = line.text.trim_start_matches(COMMENTS).trim();
            let names = if own {
                rows.separator.fields(text)
            } else {
                rows.names(text)
            };
            let is_header = rows.fits(&names) && !names.iter().all(|name| is_number(name));
            is_header.then_some(names)
        };
        let named = [true, false].into_iter().find_map(|own| {
            let mut last = before.iter().rev();
            last.find_map(|line| Some((names(line, own)?, **line)))
        });
        let Some((columns, line)) = named else {
            let between = if rows.width > 1 {
                format!(" that {} separate", rows.separator.name())
            } else {
                String::new()
            };
            let what =
                format!("begins with numbers{between}: it has no header that names its columns");
            return Err(TableError::damaged(Some(first.number), what, HEADER));
        };
        let mut layout = Self::new(rows, columns, line);
        if let Some(last) = before.last() {
            layout.start = last.end as u64;
            layout.lines = last.number;
        }
        Ok(layout)
    }
}

const HEADER: &str = "write one line with the names of the columns before the first row";

fn is_comment(line: &&Line) -> bool {
    line.text.starts_with('#')
}

/// The lines of a text, trimmed. Bytes that are no UTF-8 are taken for Latin-1, as Excel and LabVIEW write it.
fn lines(head: &[u8]) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut at = 0;
    while at < head.len() {
        let rest = &head[at..];
        let length = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let length = length.unwrap_or(rest.len());
        let end = if rest[length..].starts_with(b"\r\n") {
            2
        } else {
            1
        };
        at = (at + length + end).min(head.len());
        let bytes = &rest[..length];
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let text = match std::str::from_utf8(bytes) {
            Ok(text) => text.to_owned(),
            Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
        };
        lines.push(Line {
            number: lines.len() as u64 + 1,
            text: trimmed(&text).to_owned(),
            end: at,
        });
    }
    lines
}

/// Without spaces around it. A tab at an end may separate an empty field.
fn trimmed(text: &str) -> &str {
    if text.trim().is_empty() {
        return "";
    }
    text.trim_matches(|c: char| c.is_whitespace() && c != '\t')
}
