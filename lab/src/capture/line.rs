//! The line protocol: a sample is a line of numbers with commas between them.
//!
//! `#t_us,ax_g,ay_g,az_g` names the columns. It may come again, and must then be the same. Lines end
//! with LF or CR LF. The first line is not used unless it is a header: a port is opened at any time, and
//! half a line may look like a whole one.

use super::columns::{Column, Layout};
use super::error::SensorError;
use super::samples::{Counts, Samples};
use super::stamps::Stamps;

/// Longest line, bytes.
const LONGEST: usize = 1024;
/// Most bytes of lines before a header: five seconds of a fast line.
const HEADLESS: usize = 1 << 20;
/// Lines in a row that are no samples, at most.
const BAD_IN_A_ROW: u32 = 64;

/// Makes samples of bytes.
#[derive(Debug)]
pub struct LineDecoder {
    name: String,
    layout: Option<Layout>,
    /// The columns were given beside the lines, and no header changes them.
    is_given: bool,
    line: Vec<u8>,
    is_first: bool,
    in_a_row: u32,
    /// Bytes of lines before the header.
    headless: usize,
    counts: Counts,
    row: Vec<f32>,
    /// Values of the clock or the count.
    stamps: Stamps,
    /// Number of the last sample of a sensor that tells none.
    last: Option<f64>,
}

enum Line {
    Good(f64),
    Bad,
}

impl LineDecoder {
    /// A decoder for a port with this name. Without `layout`, a header must come.
    #[must_use]
    pub fn new(name: &str, layout: Option<Layout>) -> Self {
        Self {
            name: name.to_owned(),
            is_given: layout.is_some(),
            layout,
            line: Vec::with_capacity(LONGEST),
            is_first: true,
            in_a_row: 0,
            headless: 0,
            counts: Counts::default(),
            row: Vec::new(),
            stamps: Stamps::default(),
            last: None,
        }
    }

    /// The columns, once they are known.
    #[must_use]
    pub fn layout(&self) -> Option<&Layout> {
        self.layout.as_ref()
    }

    /// Returns the counts so far.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Takes bytes in pieces of any size, and appends the samples that they complete.
    ///
    /// # Errors
    /// [`SensorError`] for what is not the protocol, a header that changes, and a clock that starts
    /// anew.
    pub fn feed(&mut self, bytes: &[u8], into: &mut Samples) -> Result<(), SensorError> {
        for part in bytes.split_inclusive(|byte| *byte == b'\n') {
            if self.line.len() + part.len() > LONGEST {
                return Err(SensorError::LongLine {
                    name: self.name.clone(),
                    most: LONGEST,
                });
            }
            self.line.extend_from_slice(part);
            if part.ends_with(b"\n") {
                let line = std::mem::take(&mut self.line);
                let taken = self.take(line.trim_ascii(), into);
                self.line = line;
                self.line.clear();
                taken?;
            }
        }
        Ok(())
    }

    fn take(&mut self, line: &[u8], into: &mut Samples) -> Result<(), SensorError> {
        let is_first = std::mem::replace(&mut self.is_first, false);
        if line.is_empty() {
            return Ok(());
        }
        if let Some(header) = line.strip_prefix(b"#") {
            return self.header(header, is_first);
        }
        if is_first {
            // The rest of a line that began before the port was opened, which may look like one.
            return Ok(());
        }
        if self.layout.is_none() {
            // Whoever waits for samples tells that no header comes.
            self.counts.bad_lines += 1;
            self.headless += line.len();
            if self.headless > HEADLESS {
                return Err(SensorError::Header {
                    name: self.name.clone(),
                    why: format!("did not come in {HEADLESS} bytes"),
                });
            }
            return Ok(());
        }
        match self.sample(line)? {
            Line::Good(own) => {
                self.in_a_row = 0;
                self.push(own, into);
            }
            Line::Bad => {
                self.counts.bad_lines += 1;
                self.in_a_row += 1;
                if self.in_a_row >= BAD_IN_A_ROW {
                    return Err(self.garbage(line));
                }
                self.lose(into);
            }
        }
        Ok(())
    }

    fn header(&mut self, header: &[u8], is_first: bool) -> Result<(), SensorError> {
        let fail = |why: String| SensorError::Header {
            name: self.name.clone(),
            why,
        };
        if self.is_given {
            return Ok(());
        }
        let text = String::from_utf8_lossy(header);
        match (Layout::parse(&text), &self.layout) {
            (Ok(new), Some(old)) if new == *old => Ok(()),
            (Ok(_), Some(_)) => Err(fail("changed while samples came".into())),
            (Ok(new), None) => {
                self.layout = Some(new);
                // What came before could not be read, and was not damaged.
                self.counts.bad_lines = 0;
                Ok(())
            }
            // A comment, or a header that was cut.
            (Err(_), Some(_)) => Ok(()),
            (Err(_), None) if is_first => Ok(()),
            (Err(why), None) => Err(fail(why)),
        }
    }

    /// Reads a line into `row`.
    fn sample(&mut self, line: &[u8]) -> Result<Line, SensorError> {
        let Some(layout) = &self.layout else {
            return Ok(Line::Bad);
        };
        let Ok(text) = std::str::from_utf8(line) else {
            return Ok(Line::Bad);
        };
        self.row.clear();
        let mut time = None;
        let mut fields = text.split(',');
        for column in layout.columns() {
            let Some(field) = fields.next().map(str::trim) else {
                return Ok(Line::Bad);
            };
            match column {
                Column::Skipped => {}
                Column::Clock(_) | Column::Count => match field.parse::<f64>() {
                    Ok(value) if value.is_finite() && value >= 0.0 => time = Some((value, *column)),
                    _ => return Ok(Line::Bad),
                },
                Column::Channel(_) => match value(field) {
                    Some(value) => self.row.push(value),
                    None => return Ok(Line::Bad),
                },
            }
        }
        if fields.next().is_some() {
            return Ok(Line::Bad);
        }
        match time {
            Some((value, column)) => Ok(Line::Good(self.unwrapped(value, column)?)),
            None => Ok(Line::Good(self.next_number())),
        }
    }

    /// Number of the next sample of a sensor that tells none.
    fn next_number(&mut self) -> f64 {
        let next = self.last.map_or(0.0, |last| last + 1.0);
        self.last = Some(next);
        next
    }

    /// A clock or a count without its wraps, in seconds or samples.
    fn unwrapped(&mut self, value: f64, column: Column) -> Result<f64, SensorError> {
        let stamp = self.stamps.take(value);
        let stamp = stamp.map_err(|before| SensorError::Restarted {
            name: self.name.clone(),
            before,
            now: value,
        })?;
        let unit = match column {
            Column::Clock(unit_s) => unit_s,
            _ => 1.0,
        };
        Ok(stamp * unit)
    }

    fn push(&mut self, own: f64, into: &mut Samples) {
        self.counts.samples += 1;
        self.counts.missing += self.row.iter().filter(|x| x.is_nan()).count() as u64;
        into.own.push(own);
        into.values.extend_from_slice(&self.row);
    }

    /// A line that was damaged counts as a sample without values, unless the sensor itself tells
    /// when the next one was taken.
    fn lose(&mut self, into: &mut Samples) {
        let Some(layout) = &self.layout else { return };
        let is_timed = layout
            .columns()
            .iter()
            .any(|column| matches!(column, Column::Clock(_) | Column::Count));
        if is_timed || self.last.is_none() {
            return;
        }
        let width = layout.channels().count();
        let own = self.next_number();
        into.own.push(own);
        into.values.resize(into.values.len() + width, f32::NAN);
    }

    fn garbage(&self, line: &[u8]) -> SensorError {
        let shown = &line[..line.len().min(40)];
        SensorError::Garbage {
            name: self.name.clone(),
            count: self.in_a_row,
            example: shown.escape_ascii().to_string(),
        }
    }
}

/// A value; NaN for one that is missing or not finite.
fn value(field: &str) -> Option<f32> {
    if field.is_empty() {
        return Some(f32::NAN);
    }
    let value: f32 = field.parse().ok()?;
    Some(if value.is_finite() { value } else { f32::NAN })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoder() -> LineDecoder {
        LineDecoder::new("port", None)
    }

    fn fed(decoder: &mut LineDecoder, bytes: &[u8]) -> Result<Samples, SensorError> {
        let mut samples = Samples::default();
        decoder.feed(bytes, &mut samples).map(|()| samples)
    }

    #[test]
    fn pieces_of_any_size_give_the_same_samples() {
        let text = b"9.5,1\n#t_ms,ax_g,fz_N\r\n10,0.5,1\r\n\n11,-0.25,nan\r\n12,inf,\r\n";
        let whole = fed(&mut decoder(), text).expect("samples");
        assert_eq!(whole.own, [0.01, 0.011, 0.012]);
        assert_eq!(whole.values[..3], [0.5, 1.0, -0.25]);
        assert!(whole.values[3..].iter().all(|x| x.is_nan()));
        for size in 1..text.len() {
            let mut pieces = decoder();
            let mut samples = Samples::default();
            for piece in text.chunks(size) {
                pieces.feed(piece, &mut samples).expect("samples");
            }
            assert_eq!(samples.own, whole.own, "pieces of {size}");
            assert_eq!(pieces.counts().missing, 3);
            assert_eq!(pieces.counts().bad_lines, 0);
        }
    }

    #[test]
    fn a_damaged_line_is_a_missing_sample_where_nothing_else_counts() {
        let mut lines = LineDecoder::new("port", Layout::parse("ax,ay").ok());
        let samples = fed(&mut lines, b",7\n1,2\n1,\xff\n1,2,3\n5,6\n").expect("samples");
        assert_eq!(samples.own, [0.0, 1.0, 2.0, 3.0]);
        assert!(samples.values[2..6].iter().all(|x| x.is_nan()));
        assert_eq!(samples.values[6..], [5.0, 6.0]);
        assert_eq!(lines.counts().bad_lines, 2);
    }

    #[test]
    fn a_clock_of_32_bits_wraps_and_one_that_restarts_is_an_error() {
        let mut lines = decoder();
        let samples = fed(&mut lines, b"#t_us,a\n4294967290,1\n4,1\n").expect("a wrap");
        assert!((samples.own[1] - samples.own[0] - 10e-6).abs() < 1e-9);
        let again: String = (0..70).map(|n| format!("{n},1\n")).collect();
        fed(&mut lines, b"9000,1\n".repeat(64).as_slice()).expect("one time");
        let error = fed(&mut lines, again.as_bytes()).expect_err("a restart");
        assert!(matches!(error, SensorError::Restarted { .. }), "{error}");
    }

    #[test]
    fn garbage_is_told_with_an_example_and_without_control_characters() {
        let mut lines = LineDecoder::new("port", Layout::parse("ax").ok());
        let error = fed(&mut lines, &b"\x1b[31m\xfe\n".repeat(70)).expect_err("garbage");
        assert!(matches!(error, SensorError::Garbage { .. }), "{error}");
        assert!(!error.to_string().contains('\x1b'));
        let mut no_header = decoder();
        assert!(
            fed(&mut no_header, &b"1,2,3\n".repeat(700))
                .expect("it waits")
                .is_empty()
        );
        assert_eq!(no_header.counts().bad_lines, 699);
        fed(&mut no_header, b"#ax,ay,az\n1,2,3\n").expect("a header");
        assert_eq!(
            (no_header.counts().bad_lines, no_header.counts().samples),
            (0, 1)
        );
        let error = fed(&mut decoder(), &[0; 5000]).expect_err("a long line");
        assert!(matches!(error, SensorError::LongLine { .. }), "{error}");
    }

    #[test]
    fn a_header_may_come_again_and_not_change() {
        let mut lines = decoder();
        fed(&mut lines, b"#ax\n1\n#ax\n#a comment\n2\n").expect("samples");
        assert_eq!(lines.counts().samples, 2);
        let error = fed(&mut lines, b"#ax,ay\n").expect_err("another header");
        assert!(error.to_string().contains("changed"), "{error}");
        let error = fed(&mut decoder(), b"\n#t_us,speed\n").expect_err("a wrong header");
        assert!(error.to_string().contains("`speed`"), "{error}");
    }
}
