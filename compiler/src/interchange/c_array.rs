//! An asset or a library as a C array: the image that a device keeps in flash, with its header.
//!
//! The array is aligned and constant, so a linker puts it into read-only memory, and
//! `asperity_texture_load_asset` or `asperity_library_*` read it where it lies.

use std::fmt::Write as _;

/// Alignment of the array, bytes: that of the largest load any processor makes of it.
const ALIGNMENT: usize = 8;
/// Bytes in a line.
const LINE: usize = 16;

/// The declaration and the array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Source {
    /// The header: declarations alone.
    pub(super) header: Vec<u8>,
    /// The source: the array, which includes the header.
    pub(super) source: Vec<u8>,
}

/// Writes bytes as an array called `symbol`; `header` is the name of the header's file, or `None` for a
/// source without one.
pub(super) fn write(symbol: &str, about: &[String], bytes: &[u8], header: Option<&str>) -> Source {
    let guard = format!("{}_H", symbol.to_uppercase());
    let size = format!("{}_SIZE", symbol.to_uppercase());
    let comment: String = about
        .iter()
        .map(|line| format!(" * {}\n", safe(line)))
        .collect();
    let align = format!(
        "#if defined(__cplusplus)\n#define {guard}_ALIGNED alignas({ALIGNMENT})\n\
         #elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L\n\
         #define {guard}_ALIGNED _Alignas({ALIGNMENT})\n\
         #elif defined(_MSC_VER)\n#define {guard}_ALIGNED __declspec(align({ALIGNMENT}))\n\
         #else\n#define {guard}_ALIGNED __attribute__((aligned({ALIGNMENT})))\n#endif\n"
    );
    let declarations = format!(
        "#ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n\
         /* Bytes of the image. */\n#define {size} {}u\n\n\
         extern const unsigned char {symbol}[{size}];\n\n\
         #ifdef __cplusplus\n}}\n#endif\n",
        bytes.len()
    );
    let head =
        format!("/*\n{comment} */\n#ifndef {guard}\n#define {guard}\n\n{declarations}\n#endif\n");
    let mut source = format!("/*\n{comment} */\n");
    match header {
        Some(file) => {
            // Writing to a string cannot fail.
            let _ = writeln!(source, "#include \"{file}\"\n");
        }
        None => {
            source += &format!("#ifndef {guard}\n#define {guard}\n\n{declarations}\n#endif\n\n")
        }
    }
    source += &align;
    let _ = writeln!(
        source,
        "\n{guard}_ALIGNED const unsigned char {symbol}[{size}] = {{"
    );
    for line in bytes.chunks(LINE) {
        source.push_str("   ");
        for byte in line {
            let _ = write!(source, " {byte},");
        }
        source.push('\n');
    }
    source.push_str("};\n");
    Source {
        header: head.into_bytes(),
        source: source.into_bytes(),
    }
}

/// A line that ends no comment: printable ASCII without `*/` and `\`.
pub(super) fn safe(text: &str) -> String {
    let printable = |c: char| matches!(c, ' '..='~') && !matches!(c, '\\' | '*' | '?');
    text.chars()
        .map(|c| if printable(c) { c } else { '_' })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_texture_is_called_ends_no_comment() {
        let about = ["*/ int main(void) { } /* ??/ \\".to_owned()];
        let source = String::from_utf8(write("a", &about, &[1, 2], None).source).unwrap();
        assert_eq!(source.matches("*/").count(), source.matches("/*").count());
        assert!(!source.contains("??/") && !source.contains('\\'));
    }
}
