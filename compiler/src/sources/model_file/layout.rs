//! Layout of a file: indented down to the vertices, each of which is a line.

use serde_json::ser::Formatter;
use std::io::{Result, Write};

/// Objects and lists nested deeper than this stay on one line.
const INDENTED: usize = 3;

/// Indents the outer levels only.
#[derive(Debug, Default)]
pub(super) struct Shallow {
    depth: usize,
    /// True if the list or object that ends has an entry.
    filled: bool,
}

impl Shallow {
    fn open<W: Write + ?Sized>(&mut self, writer: &mut W, bracket: &[u8]) -> Result<()> {
        self.depth += 1;
        self.filled = false;
        writer.write_all(bracket)
    }

    fn close<W: Write + ?Sized>(&mut self, writer: &mut W, bracket: &[u8]) -> Result<()> {
        let indented = self.depth <= INDENTED && self.filled;
        self.depth -= 1;
        // What it stands in has an entry: itself.
        self.filled = true;
        if indented {
            self.new_line(writer)?;
        }
        writer.write_all(bracket)
    }

    fn entry<W: Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> Result<()> {
        self.filled = true;
        if self.depth <= INDENTED {
            if !first {
                writer.write_all(b",")?;
            }
            return self.new_line(writer);
        }
        writer.write_all(if first { b"" } else { b", " })
    }

    fn new_line<W: Write + ?Sized>(&self, writer: &mut W) -> Result<()> {
        writer.write_all(b"\n")?;
        (0..self.depth).try_for_each(|_| writer.write_all(b"  "))
    }
}

impl Formatter for Shallow {
    fn begin_array<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        self.open(writer, b"[")
    }

    fn end_array<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        self.close(writer, b"]")
    }

    fn begin_array_value<W: Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> Result<()> {
        self.entry(writer, first)
    }

    fn begin_object<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        self.open(writer, b"{")
    }

    fn end_object<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> Result<()> {
        self.entry(writer, first)
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        writer.write_all(b": ")
    }
}
