//! Sizes and functions of a firmware's ELF.

use crate::package::Result;
use asperity_session::LIBRARY;
use object::{Object, ObjectSection, ObjectSymbol, SectionFlags, SymbolKind, elf};
use std::{fs, path::Path};

/// A function with its code.
#[derive(Debug)]
pub(crate) struct Function {
    /// Demangled.
    pub(crate) name: String,
    pub(crate) start: u32,
    pub(crate) code: Vec<u8>,
    /// Address ranges that hold constants, not instructions.
    pub(crate) data: Vec<(u32, u32)>,
}

/// Sizes and functions of an ELF file.
#[derive(Debug)]
pub(crate) struct Elf {
    /// Bytes of code and constants in flash, without the library.
    pub(crate) flash_bytes: u64,
    /// Bytes of initial values in flash, from which statics are filled at start.
    pub(crate) initial_bytes: u64,
    /// Bytes of statics in RAM.
    pub(crate) ram_bytes: u64,
    /// By address.
    pub(crate) functions: Vec<Function>,
}

/// Reads an ELF.
pub(crate) fn read(path: &Path) -> Result<Elf> {
    let bytes = fs::read(path)?;
    if !bytes.windows(LIBRARY.len()).any(|window| window == LIBRARY) {
        return Err("the firmware does not hold the library in one piece".into());
    }
    let file = object::File::parse(bytes.as_slice())?;
    let (mut flash_bytes, mut initial_bytes, mut ram_bytes) = (0, 0, 0);
    for section in file.sections() {
        let SectionFlags::Elf { sh_flags } = section.flags() else {
            continue;
        };
        if sh_flags & u64::from(elf::SHF_ALLOC) == 0 {
            continue;
        }
        let writable = sh_flags & u64::from(elf::SHF_WRITE) != 0;
        // .bss has no bytes in the file.
        let stored = section.file_range().map_or(0, |(_, size)| size);
        if writable {
            ram_bytes += section.size();
            initial_bytes += stored;
        } else {
            flash_bytes += stored;
        }
    }
    Ok(Elf {
        flash_bytes: flash_bytes - LIBRARY.len() as u64,
        initial_bytes,
        ram_bytes,
        functions: functions(&file)?,
    })
}

fn functions(file: &object::File<'_>) -> Result<Vec<Function>> {
    let mut symbols: Vec<_> = file
        .symbols()
        .filter(|symbol| symbol.kind() == SymbolKind::Text && symbol.size() > 0)
        .filter_map(|symbol| {
            let name = rustc_demangle::demangle(symbol.name().ok()?);
            let start = symbol.address() as u32 & !1;
            Some((
                start,
                symbol.size() as u32,
                format!("{name:#}"),
                symbol.section_index()?,
            ))
        })
        .collect();
    symbols.sort_by_key(|symbol| symbol.0);
    let marks = mapping_symbols(file);
    symbols
        .into_iter()
        .map(|(start, size, name, section)| {
            let section = file.section_by_index(section)?;
            let code = section
                .data_range(u64::from(start), u64::from(size))?
                .ok_or_else(|| format!("{name}: no code"))?;
            Ok(Function {
                data: data_ranges(&marks, start, start + size),
                code: code.to_vec(),
                name,
                start,
            })
        })
        .collect()
}

/// `$t` and `$d`: where code and where data starts.
fn mapping_symbols(file: &object::File<'_>) -> Vec<(u32, bool)> {
    let mut marks: Vec<_> = file
        .symbols()
        .filter_map(|symbol| {
            let name = symbol.name().ok()?;
            let is_data = name.starts_with("$d");
            (is_data || name.starts_with("$t")).then(|| (symbol.address() as u32, is_data))
        })
        .collect();
    marks.sort_unstable();
    marks
}

fn data_ranges(marks: &[(u32, bool)], start: u32, end: u32) -> Vec<(u32, u32)> {
    let nexts = marks.iter().skip(1).map(|mark| mark.0).chain([u32::MAX]);
    marks
        .iter()
        .zip(nexts)
        .filter(|((at, is_data), _)| *is_data && (start..end).contains(at))
        .map(|((at, _), next)| (*at, next.min(end)))
        .collect()
}
