//! An asset or a library as source text: under which symbol, with which bytes, and what the text says of them.

use super::{
    c_array,
    export::{Format, Language},
    rust_source,
};
use crate::emit::{
    pack::{NamedAsset, encode, encode_scene},
    sections::without_preview,
};
use asperity_formats::{EncodeError, Library, SceneSurface};
use asperity_io::diagnostic::Fault;
use serde_json::{Value, json};
use std::{
    error::Error,
    path::{Path, PathBuf},
};

/// Before every symbol that is made of a name. No name of the C face begins so, nor will one.
const PREFIX: &str = "asperity_image";
/// Longest symbol that all compilers tell apart to its end (C11, 5.2.4.1).
const LONGEST: usize = 63;

/// Options of source text.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SourceOptions<'a> {
    /// Name of the file that declares the array of a C source, if there is one.
    pub header: Option<&'a str>,
    /// Symbol of the array, an [identifier](parse_symbol); made of the name if `None`.
    pub symbol: Option<&'a str>,
    /// True if previews stay in the image. A runtime does not read them.
    pub keep_preview: bool,
}

/// An image as source text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceText {
    /// The file.
    pub text: Vec<u8>,
    /// The header, if [`SourceOptions::header`] names one.
    pub header: Option<Vec<u8>>,
    /// Symbol of the array.
    pub symbol: String,
    /// Bytes of the image.
    pub image_len: usize,
    /// Bytes of the previews that were left out.
    pub left_out: usize,
}

impl SourceText {
    /// The report for machines, of the asset or library of this name.
    #[must_use]
    pub fn json(&self, language: Language, name: &str) -> Value {
        json!({
            "format": Format::Source(language).name(),
            "name": name,
            "symbol": self.symbol,
            "bytes": { "image": self.image_len, "written": self.text.len(), "left_out": self.left_out },
            "lossless": true,
        })
    }
}

/// The header that goes beside a source file: `NAME.h` beside `NAME.c`.
#[must_use]
pub fn header_beside(language: Language, source: &Path) -> Option<PathBuf> {
    let is_c = source.extension().is_some_and(|end| end == "c");
    (language == Language::C && is_c).then(|| source.with_extension("h"))
}

/// The bytes of an asset or a library as source text that says what they are. The name is that of the texture, or of
/// the library's file.
///
/// # Errors
/// [`Fault`] for bytes that are neither.
pub fn export_source(
    language: Language,
    name: &str,
    bytes: &[u8],
    options: &SourceOptions<'_>,
) -> Result<SourceText, Fault> {
    let image = if options.keep_preview {
        bytes.to_owned()
    } else {
        let remedy = "give an asset or a library that this version of asperity wrote";
        without_previews(bytes).map_err(|error| Fault::new(error, remedy))?
    };
    let symbol = options.symbol.map_or_else(|| symbol(name), str::to_owned);
    let about = [
        format!(
            "{name}: {} bytes, written by asperity {}",
            image.len(),
            env!("CARGO_PKG_VERSION")
        ),
        "An asset of Asperity, or a library; formats/SPEC.md says what each byte means.".to_owned(),
    ];
    let image_len = image.len();
    let left_out = bytes.len().saturating_sub(image_len);
    let (text, header) = match language {
        Language::Rust => (rust_source::write(&symbol, &about, &image), None),
        Language::C => {
            let included = options.header.filter(|name| can_be_included(name));
            let written = c_array::write(&symbol, &about, &image, included);
            (written.source, options.header.map(|_| written.header))
        }
    };
    Ok(SourceText {
        text,
        header,
        symbol,
        image_len,
        left_out,
    })
}

/// An asset or a library without previews.
fn without_previews(bytes: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let Ok(library) = Library::parse(bytes) else {
        return Ok(without_preview(bytes)?);
    };
    let mut assets = Vec::new();
    for (index, entry) in library.index().entries().enumerate() {
        let asset = library.bytes(index).map_err(EncodeError::from)?;
        assets.push((entry.name, without_preview(asset)?));
    }
    let named: Vec<NamedAsset<'_>> = assets
        .iter()
        .map(|(name, bytes)| NamedAsset { name, bytes })
        .collect();
    Ok(match library.scene() {
        None => encode(&named)?,
        Some(scene) => {
            let surfaces: Vec<SceneSurface> = scene.surfaces().collect();
            encode_scene(&named, &surfaces)?
        }
    })
}

/// The symbol of a name: its ASCII letters and digits in lower case behind a prefix. Where these are not the whole
/// name, because it has other letters or is too long, its CRC-32 tells it from others.
fn symbol(name: &str) -> String {
    let mut symbol = PREFIX.to_owned();
    let mut gap = true;
    for c in name.chars() {
        if c.is_ascii_alphanumeric() {
            if gap {
                symbol.push('_');
            }
            symbol.push(c.to_ascii_lowercase());
            gap = false;
        } else {
            gap = true;
        }
    }
    let digest = format!("_{:08x}", crc32fast::hash(name.as_bytes()));
    let is_told = name.is_ascii() && symbol.len() > PREFIX.len() && symbol.len() <= LONGEST;
    if !is_told {
        symbol.truncate(LONGEST - digest.len());
        symbol += &digest;
    }
    symbol
}

/// A symbol that a user names: an identifier of C and of Rust.
///
/// # Errors
/// What it must be.
pub fn parse_symbol(text: &str) -> Result<String, String> {
    let starts = text.starts_with(|c: char| c.is_ascii_alphabetic());
    let is_identifier = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if starts && is_identifier && text.len() <= LONGEST {
        Ok(text.to_owned())
    } else {
        Err(format!(
            "an identifier: a letter, then letters, digits and _, at most {LONGEST} in all"
        ))
    }
}

/// Returns true if `#include "…"` can name a file: it has no escapes. A source without it declares the array itself.
fn can_be_included(name: &str) -> bool {
    !name
        .chars()
        .any(|c| c.is_control() || matches!(c, '"' | '\\' | '?'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_becomes_a_symbol_and_different_names_different_ones() {
        assert_eq!(symbol("Built-in Grit"), "asperity_image_built_in_grit");
        assert_eq!(symbol("tick"), "asperity_image_tick");
        let crc = |name: &str| format!("{:08x}", crc32fast::hash(name.as_bytes()));
        assert_eq!(symbol("木 2"), format!("asperity_image_2_{}", crc("木 2")));
        assert_eq!(symbol("🔥"), format!("asperity_image_{}", crc("🔥")));
        assert_eq!(symbol("!"), format!("asperity_image_{}", crc("!")));
        let names = ["木", "林", "🔥", "!", "Käse", "Kuse", "2", "木 2"];
        let long = ["x".repeat(64), format!("{}y", "x".repeat(63))];
        let mut symbols: Vec<String> = names.into_iter().map(symbol).collect();
        symbols.extend(long.iter().map(|name| symbol(name)));
        for symbol in &symbols {
            assert_eq!(parse_symbol(symbol).as_ref(), Ok(symbol));
        }
        symbols.sort();
        symbols.dedup();
        assert_eq!(symbols.len(), names.len() + long.len());
    }

    #[test]
    fn a_symbol_of_a_user_is_an_identifier() {
        assert_eq!(parse_symbol("grit_2"), Ok("grit_2".to_owned()));
        for wrong in ["", "2", "_a", "a-b", "ä", "a b", "a;b", &"x".repeat(64)] {
            assert!(parse_symbol(wrong).is_err(), "{wrong:?}");
        }
    }
}
