//! Tables of numbers in text, in whatever dialect a logger or a spreadsheet writes them.
//!
//! Columns are separated by commas, semicolons, tabs or blanks, and numbers may have a decimal comma. Lines may precede
//! the header, and a row of units may follow it; `name:value` pairs name their own columns. Whatever is ambiguous is
//! refused with its line, never guessed.

mod blanks;
mod cell;
mod layout;
mod lines;
mod rows;

pub use cell::{number, seconds, time_unit};
pub use layout::Layout;

use blanks::Blanks;
use csv::{ByteRecord, ReaderBuilder, Trim};
use layout::HEAD;
use lines::{BUFFER, Lines, MAX_ROW, TooLong};
use rows::Separator;
use std::{
    borrow::Cow,
    cell::Cell,
    io::{self, Chain, Cursor, Read},
    rc::Rc,
};
use thiserror::Error;

/// A fault in a table, and its place.
#[derive(Debug, Error)]
#[error("{}{problem}", line.map(|line| format!("line {line} ")).unwrap_or_default())]
pub struct TableError {
    /// The line at fault, from 1.
    pub line: Option<u64>,
    /// The fault.
    pub problem: TableProblem,
}

/// A fault in a table.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TableProblem {
    /// The input failed.
    #[error("cannot be read ({0})")]
    Unreadable(#[source] io::Error),
    /// It is no table, or damaged.
    #[error("{what}")]
    Damaged {
        /// Description of the fault.
        what: String,
        /// Step for the user.
        remedy: &'static str,
    },
}

impl TableError {
    fn damaged(line: Option<u64>, what: impl Into<String>, remedy: &'static str) -> Self {
        let what = what.into();
        let problem = TableProblem::Damaged { what, remedy };
        Self { line, problem }
    }

    fn unreadable(error: io::Error) -> Self {
        let problem = TableProblem::Unreadable(error);
        Self {
            line: None,
            problem,
        }
    }
}

/// The head that was looked at, and the rest.
type Input<R> = Lines<Chain<Cursor<Vec<u8>>, R>>;

/// The rows of a table, one at a time: a table is never held in memory as a whole.
#[derive(Debug)]
pub struct Table<R> {
    layout: Layout,
    reader: csv::Reader<Blanks<Input<R>>>,
    record: ByteRecord,
    /// Bytes of the row that is read.
    row_bytes: Rc<Cell<usize>>,
    /// The last row and its number of values, where it has not as many as the others.
    odd: Option<(u64, usize)>,
}

/// A row: its line, and the text in its columns.
#[derive(Debug, Clone, Copy)]
pub struct TableRow<'a> {
    /// The line, from 1.
    pub line: u64,
    record: &'a ByteRecord,
    layout: &'a Layout,
}

impl<R: Read> Table<R> {
    /// Finds the header in the first 64 KiB of the input. `is_unit` says whether a field may stand in a row of units.
    ///
    /// # Errors
    /// [`TableError`] for what cannot be read, is no text in UTF-8 or has no header.
    pub fn open(mut input: R, is_unit: &dyn Fn(&str) -> bool) -> Result<Self, TableError> {
        let mut head = Vec::new();
        (&mut input)
            .take(HEAD as u64)
            .read_to_end(&mut head)
            .map_err(TableError::unreadable)?;
        let layout = Layout::of(&head, is_unit)?;
        let mut head = Cursor::new(head);
        head.set_position(layout.start);
        let row_bytes = Rc::new(Cell::new(0));
        let input = Lines::new(head.chain(input), Rc::clone(&row_bytes));
        let input = Blanks::new(input, layout.separator == Separator::Blanks);
        let reader = ReaderBuilder::new()
            .delimiter(layout.separator.byte())
            .comment(Some(b'#'))
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .buffer_capacity(BUFFER)
            .from_reader(input);
        Ok(Self {
            layout,
            reader,
            record: ByteRecord::new(),
            row_bytes,
            odd: None,
        })
    }

    /// Where its rows are and how its columns are called.
    pub const fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The next row. A last row that is not whole is left out; [`Self::cut`] tells it.
    ///
    /// # Errors
    /// [`TableError`] for a row whose number of values is wrong, or names in place of numbers.
    pub fn next_row(&mut self) -> Result<Option<TableRow<'_>>, TableError> {
        loop {
            self.row_bytes.set(0);
            let line = self.reader.position().line();
            let more = self.reader.read_byte_record(&mut self.record);
            if !more.map_err(|error| self.failed(line, error))? {
                return Ok(None);
            }
            if let Some((line, values)) = self.odd.take() {
                let what = format!("has {values} values where the header has {}", self.width());
                let remedy =
                    "correct or remove this line; a comma in a number counts as a separator";
                return Err(TableError::damaged(Some(line), what, remedy));
            }
            // The parser begins a row with the blank lines before it.
            let begin = self.record.position().map_or(0, csv::Position::line);
            let line = self.layout.lines + begin.max(self.reader.position().line() - 1);
            if self.is_header_of_another() {
                let what = "holds names in place of numbers: another table begins here";
                let remedy = "save each table as a file of its own";
                return Err(TableError::damaged(Some(line), what, remedy));
            }
            if !self.is_whole() {
                self.odd = Some((line, self.record.len()));
                continue;
            }
            let (record, layout) = (&self.record, &self.layout);
            return Ok(Some(TableRow {
                line,
                record,
                layout,
            }));
        }
    }

    /// The line of a last row that was left out because it is not whole, and how many values it has.
    pub const fn cut(&self) -> Option<(u64, usize)> {
        self.odd
    }

    fn width(&self) -> usize {
        self.layout.columns.len()
    }

    /// Returns true if every column has a value; a separator or a comment may follow.
    fn is_whole(&self) -> bool {
        let (values, width) = (self.record.len(), self.width());
        let end = self.record.get(width);
        values == width
            || values == width + 1 && (self.layout.comment || end.is_some_and(<[u8]>::is_empty))
    }

    /// Returns true if a row holds only words, two at least, where the table has numbers.
    fn is_header_of_another(&self) -> bool {
        let decimal_comma = self.layout.decimal_comma;
        let is_word = |field: &[u8]| match std::str::from_utf8(field) {
            Ok(text) => {
                text.contains(char::is_alphabetic)
                    && number(text, decimal_comma).is_none()
                    && seconds(text).is_none()
            }
            Err(_) => false,
        };
        let texts = &self.layout.texts;
        let mut told = (0..)
            .zip(&self.record)
            .filter(|(at, _)| !texts.contains(at));
        !self.layout.labelled
            && self.record.len() > 1
            && self.record.len() > texts.len() + 1
            && told.all(|(_, field)| is_word(field))
    }

    fn failed(&self, line: u64, error: csv::Error) -> TableError {
        let line = Some(self.layout.lines + line);
        match error.into_kind() {
            csv::ErrorKind::Io(error) if error.get_ref().is_some_and(|e| e.is::<TooLong>()) => {
                let what = format!("takes more than {MAX_ROW} bytes");
                TableError::damaged(line, what, "close its quotation mark, or break the line")
            }
            csv::ErrorKind::Io(error) => TableError::unreadable(error),
            other => {
                let what = format!("is no row of a table ({other:?})");
                TableError::damaged(line, what, "save it as CSV in UTF-8")
            }
        }
    }
}

impl<'a> TableRow<'a> {
    /// The text in a column, without its label where the rows name their columns; bytes that are no UTF-8 are
    /// replaced. Empty where the row has no such column.
    #[must_use]
    pub fn text(&self, column: usize) -> Cow<'a, str> {
        let field = self.record.get(column).unwrap_or_default();
        let text = String::from_utf8_lossy(field);
        if !self.layout.labelled {
            return text;
        }
        let name = self.layout.columns.get(column);
        match cell::label(&text).filter(|(label, _)| name.is_some_and(|name| name == label)) {
            Some((_, value)) => Cow::Owned(value.to_owned()),
            None => text,
        }
    }

    /// The number in a column, NaN where it is missing; seconds where it is a time as text. `None` for any other text.
    #[must_use]
    pub fn number(&self, column: usize) -> Option<f64> {
        let text = self.text(column);
        number(&text, self.layout.decimal_comma).or_else(|| seconds(&text))
    }
}

#[cfg(test)]
mod tests;
