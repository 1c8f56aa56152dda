//! NumPy's `.npy`: one array of numbers, a row a sample, in C order.
//!
//! The format is ten bytes and a Python dictionary of three entries. Crates that read it bring a
//! parser generator along, so these lines read it.

use super::{EachRow, Header};
use crate::{file, remedy::unreadable};
use asperity_io::diagnostic::Fault;
use std::{
    fs::File,
    io::{BufReader, Read},
    path::Path,
};

/// Longest header, bytes.
const MAX_HEADER: usize = 64 * 1024;
/// Most columns.
const MAX_COLUMNS: usize = 256;

/// The numbers of an array.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Number {
    F32,
    F64,
    I16,
    I32,
}

struct Array {
    reader: BufReader<File>,
    number: Number,
    big_endian: bool,
    rows: u64,
    columns: usize,
}

fn open(path: &Path) -> Result<Array, Fault> {
    let refused = |what: &str, remedy: &str| Fault::new(what, remedy).at(path);
    let damaged = |what: &str| refused(what, "save it again with numpy.save");
    let mut reader = BufReader::new(file::open(path)?);
    let mut start = [0; 8];
    reader.read_exact(&mut start).map_err(unreadable(path))?;
    if start[..6] != *b"\x93NUMPY" {
        return Err(damaged("is no NumPy array"));
    }
    let length = if start[6] == 1 {
        let mut bytes = [0; 2];
        reader.read_exact(&mut bytes).map_err(unreadable(path))?;
        usize::from(u16::from_le_bytes(bytes))
    } else {
        let mut bytes = [0; 4];
        reader.read_exact(&mut bytes).map_err(unreadable(path))?;
        u32::from_le_bytes(bytes) as usize
    };
    if length > MAX_HEADER {
        return Err(damaged("has a header of more than 64 KiB"));
    }
    let mut header = vec![0; length];
    reader.read_exact(&mut header).map_err(unreadable(path))?;
    let header = String::from_utf8_lossy(&header).into_owned();
    let value = |key: &str| {
        let after = header.split_once(&format!("'{key}':"))?.1.trim_start();
        Some(after.to_owned())
    };
    let kind = value("descr").ok_or_else(|| damaged("has a header without 'descr'"))?;
    let (big_endian, number) = match kind.get(1..4) {
        Some("<f4") => (false, Number::F32),
        Some("<f8") => (false, Number::F64),
        Some("<i2") => (false, Number::I16),
        Some("<i4") => (false, Number::I32),
        Some(">f4") => (true, Number::F32),
        Some(">f8") => (true, Number::F64),
        _ => {
            return Err(refused(
                "holds other numbers than f4, f8, i2 or i4",
                "save it with .astype('f8')",
            ));
        }
    };
    if value("fortran_order").is_some_and(|order| order.starts_with("True")) {
        return Err(refused(
            "is in Fortran order",
            "save numpy.ascontiguousarray of it",
        ));
    }
    let shape = value("shape").ok_or_else(|| damaged("has a header without 'shape'"))?;
    let sizes: Vec<u64> = shape
        .trim_start_matches('(')
        .split(')')
        .next()
        .unwrap_or_default()
        .split(',')
        .filter_map(|size| size.trim().parse().ok())
        .collect();
    let (rows, columns) = match sizes[..] {
        [rows] => (rows, 1),
        [rows, columns] if (1..=MAX_COLUMNS as u64).contains(&columns) => (rows, columns as usize),
        _ => return Err(damaged("is no array of rows with 1 to 256 columns")),
    };
    Ok(Array {
        reader,
        number,
        big_endian,
        rows,
        columns,
    })
}

pub(super) fn header(path: &Path) -> Result<Header, Fault> {
    let columns = open(path)?.columns;
    Ok(Header {
        columns: (0..columns).map(|column| column.to_string()).collect(),
        ..Header::default()
    })
}

pub(super) fn rows(path: &Path, each: &mut EachRow<'_>) -> Result<(), Fault> {
    let mut array = open(path)?;
    let mut row = vec![0.0; array.columns];
    for index in 1..=array.rows {
        for value in &mut row {
            *value = array.next().map_err(|_| {
                let what = format!("is cut: it ends before row {index} of {}", array.rows);
                let remedy = "copy it again; numpy.load fails on it as well";
                Fault::new(what, remedy).at(path).line(index)
            })?;
        }
        if !each(index, &row)? {
            break;
        }
    }
    Ok(())
}

impl Array {
    fn next(&mut self) -> std::io::Result<f64> {
        Ok(match self.number {
            Number::F32 => f64::from(f32::from_le_bytes(self.bytes()?)),
            Number::F64 => f64::from_le_bytes(self.bytes()?),
            Number::I16 => f64::from(i16::from_le_bytes(self.bytes()?)),
            Number::I32 => f64::from(i32::from_le_bytes(self.bytes()?)),
        })
    }

    /// The next bytes, least first.
    fn bytes<const N: usize>(&mut self) -> std::io::Result<[u8; N]> {
        let mut bytes = [0; N];
        self.reader.read_exact(&mut bytes)?;
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }
}
