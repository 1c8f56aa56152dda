//! Every tick as a line of CSV.

use crate::servo::{Record, Stage};
use std::io::{self, Write};

/// Writes a line for each record, in the order they come.
#[derive(Debug)]
pub struct Series<W> {
    writer: W,
    first_due_ns: Option<u64>,
}

impl<W: Write> Series<W> {
    /// Writes the heading: `period,t_s,missed`, and the stages in ns, which are empty where a tick
    /// did not get so far.
    ///
    /// # Errors
    /// The writer's.
    pub fn new(mut writer: W) -> io::Result<Self> {
        write!(writer, "period,t_s,missed")?;
        for stage in Stage::ALL {
            write!(writer, ",{}_ns", stage.name())?;
        }
        writeln!(writer)?;
        Ok(Self {
            writer,
            first_due_ns: None,
        })
    }

    /// Writes a record.
    ///
    /// # Errors
    /// The writer's.
    pub fn record(&mut self, record: &Record) -> io::Result<()> {
        let due_ns = record.times.due_ns;
        let first_ns = *self.first_due_ns.get_or_insert(due_ns);
        let t_s = 1e-9 * due_ns.saturating_sub(first_ns) as f64;
        write!(self.writer, "{},{t_s:.6},{}", record.period, record.missed)?;
        for stage in Stage::ALL {
            match record.times.of(stage) {
                Some(ns) => write!(self.writer, ",{ns}")?,
                None => write!(self.writer, ",")?,
            }
        }
        writeln!(self.writer)
    }

    /// Writes what is buffered and gives the writer back.
    ///
    /// # Errors
    /// The writer's.
    pub fn finish(mut self) -> io::Result<W> {
        self.writer.flush()?;
        Ok(self.writer)
    }
}
