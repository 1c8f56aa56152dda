//! An asset or a library as Rust: a `static` that is aligned.

use super::c_array::safe;
use std::fmt::Write as _;

/// Bytes in a line.
const LINE: usize = 16;

/// Writes bytes as a static called `symbol`.
pub(super) fn write(symbol: &str, about: &[String], bytes: &[u8]) -> Vec<u8> {
    let name = symbol.to_uppercase();
    let mut text = String::new();
    // Writing to a string cannot fail.
    for line in about {
        let _ = writeln!(text, "// {}", safe(line));
    }
    let len = bytes.len();
    let _ = write!(
        text,
        "\n/// The image, e.g. for `asperity_formats::Asset::parse`; it begins at a multiple of 8.\n\
         #[rustfmt::skip]\npub static {name}: &[u8] = {{\n\
         #[repr(C, align(8))]\nstruct Aligned([u8; {len}]);\n\
         static IMAGE: Aligned = Aligned([\n"
    );
    for line in bytes.chunks(LINE) {
        text.push_str("   ");
        for byte in line {
            let _ = write!(text, " {byte},");
        }
        text.push('\n');
    }
    text.push_str("]);\n&IMAGE.0\n};\n");
    text.into_bytes()
}
