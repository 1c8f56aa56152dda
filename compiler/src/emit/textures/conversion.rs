//! Assets and libraries that something took for text on their way.

use asperity_formats::Asset;
use std::fmt::{self, Display, Formatter};

/// Text conversion that damaged a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Conversion {
    /// Line feeds became CR LF, or CR LF became line feeds.
    LineEnds,
    /// They were read as text in some encoding, and written in UTF-8.
    Utf8,
    /// They were read as text, and written in UTF-16.
    Utf16,
}

impl Display for Conversion {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::LineEnds => {
                "damaged: its line ends were converted, as git and text mode do with text"
            }
            Self::Utf8 => "damaged: it was read as text and written again in UTF-8",
            Self::Utf16 => {
                "damaged: it was read as text and written again in UTF-16, as PowerShell's > does"
            }
        })
    }
}

/// PNG's signature after a conversion of CR LF to line feeds.
const PNG_LF: &[u8] = b"\x89PNG\n\x1a\n";
/// So many bytes of assets hold a CR LF by chance, but for one file in 3,000.
const ENOUGH: usize = 1 << 19;
/// Largest plausible mean spacing of line feeds, bytes; chance gives 256.
const LINE: usize = 512;
/// Most bytes that are read to find the place of one lost CR.
const TRIED: usize = 1 << 25;
/// Fewer bytes may be a text by chance; no asset has so few.
const LEAST: usize = 256;

impl Conversion {
    /// Detects the conversion of bytes that begin as an asset or a library, and do not parse as one.
    pub(super) fn of(bytes: &[u8]) -> Option<Self> {
        let plain = |start: &[u8]| bytes.starts_with(start);
        if plain(b"\xff\xfeA\0S\0P\0") || plain(b"\xfe\xff\0A\0S\0P") {
            return Some(Self::Utf16);
        }
        if !plain(b"ASP") && !plain(b"\xef\xbb\xbfASP") {
            return None;
        }
        // No asset is a text by chance: it is made of numbers.
        let is_text = match std::str::from_utf8(bytes) {
            Ok(_) => true,
            Err(error) => error.error_len().is_none(),
        };
        if is_text && !bytes.is_ascii() && bytes.len() >= LEAST {
            return Some(Self::Utf8);
        }
        let ends = bytes.iter().filter(|byte| **byte == b'\n').count();
        let pairs = bytes.windows(2).filter(|pair| pair == b"\r\n").count();
        // Of 256 line feeds, chance puts one behind a CR.
        let to_crlf = pairs >= 2 && pairs == ends;
        let to_lf = pairs == 0
            && (bytes.len() >= ENOUGH && ends >= bytes.len() / LINE
                || bytes.windows(PNG_LF.len()).any(|part| part == PNG_LF)
                || lacks_one(bytes));
        (to_crlf || to_lf).then_some(Self::LineEnds)
    }
}

/// Returns true if an asset parses again with a CR inserted before one of its line feeds.
fn lacks_one(bytes: &[u8]) -> bool {
    let stated = bytes.get(8..12).and_then(|len| len.try_into().ok());
    if stated.map(u32::from_le_bytes) != u32::try_from(bytes.len() + 1).ok() {
        return false;
    }
    let ends = bytes.iter().enumerate().filter(|(_, b)| **b == b'\n');
    let mut tried = ends.take(TRIED / bytes.len());
    tried.any(|(at, _)| Asset::parse(&[&bytes[..at], b"\r", &bytes[at..]].concat()).is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        emit::{
            lower::lower,
            textures::{Textures, TexturesProblem, tests::library_of},
        },
        sources::builtin,
    };
    use asperity_io::diagnostic::Diagnostic as _;
    use std::path::Path;

    fn replaced(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
        let (mut out, mut at) = (Vec::new(), 0);
        while at < bytes.len() {
            if bytes[at..].starts_with(from) {
                out.extend(to);
                at += from.len();
            } else {
                out.push(bytes[at]);
                at += 1;
            }
        }
        out
    }

    /// The refusal of a file, and its remedy.
    fn told(bytes: &[u8]) -> (TexturesProblem, String) {
        let opened = Textures::from_bytes(Path::new("x"), bytes.to_vec());
        let error = opened
            .and_then(|mut file| file.choose(Some("0")))
            .unwrap_err();
        let remedy = error.remedy();
        (error.problem, remedy)
    }

    #[test]
    fn what_was_taken_for_text_is_told_by_what_was_done_to_it() {
        let texture = builtin::texture();
        let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
        let drawn = lower(&texture, Some(png)).unwrap().bytes;
        let plain = lower(&texture, None).unwrap().bytes;
        let names: Vec<String> = (0..300).map(|n| format!("t{n:03}")).collect();
        let library = library_of(&names, &drawn);
        let utf8 = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned().into_bytes();
        let latin = |bytes: &[u8]| -> String { bytes.iter().map(|&b| char::from(b)).collect() };
        let utf16 = |bytes: &[u8]| -> Vec<u8> {
            let text = latin(bytes);
            let units = text.encode_utf16().flat_map(u16::to_le_bytes);
            [0xff, 0xfe].into_iter().chain(units).collect()
        };
        for original in [&drawn, &plain, &library] {
            let lf = replaced(original, b"\r\n", b"\n");
            // Git keeps the CR LF that are there; text mode gives them another CR.
            let git = replaced(&lf, b"\n", b"\r\n");
            let text_mode = replaced(original, b"\n", b"\r\n");
            let (read, recoded) = (utf8(original), latin(original).into_bytes());
            for (bytes, expected) in [
                (git, Conversion::LineEnds),
                (text_mode, Conversion::LineEnds),
                (read.clone(), Conversion::Utf8),
                (recoded, Conversion::Utf8),
                ([b"\xef\xbb\xbf".to_vec(), read].concat(), Conversion::Utf8),
                (utf16(original), Conversion::Utf16),
            ] {
                let (problem, remedy) = told(&bytes);
                assert!(
                    matches!(problem, TexturesProblem::Converted(found) if found == expected),
                    "{expected:?}: {problem}"
                );
                assert!(remedy.contains("fetch it again"), "{remedy}");
            }
            if lf.len() < original.len() {
                let (problem, remedy) = told(&lf);
                assert!(
                    matches!(problem, TexturesProblem::Converted(_)),
                    "{problem}"
                );
                assert!(remedy.contains("*.asp"), "{remedy}");
            }
        }
        // One CR LF that a name brings, and that no picture gives away.
        let mut two = texture.clone();
        two.provenance.notes = "a\r\nb".into();
        let bytes = replaced(&lower(&two, None).unwrap().bytes, b"\r\n", b"\n");
        assert!(matches!(told(&bytes).0, TexturesProblem::Converted(_)));
    }

    #[test]
    fn other_damage_is_not_called_a_conversion() {
        let texture = builtin::texture();
        let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
        let drawn = lower(&texture, Some(png)).unwrap().bytes;
        let plain = lower(&texture, None).unwrap().bytes;
        let library = library_of(&["a".into(), "b".into()], &plain);
        for original in [&drawn, &plain, &library] {
            for len in [4, 20, 27, 100, original.len() / 2, original.len() - 1] {
                let (problem, _) = told(&original[..len]);
                assert!(
                    matches!(problem, TexturesProblem::Format(_)),
                    "{len}: {problem}"
                );
            }
            for at in (4..original.len()).step_by(131) {
                let mut bytes = original.clone();
                bytes[at] ^= 0x55;
                let opened = Textures::from_bytes(Path::new("x"), bytes);
                if let Err(error) = opened.and_then(|mut file| file.choose(Some("0"))) {
                    let problem = error.problem;
                    assert!(
                        matches!(problem, TexturesProblem::Format(_)),
                        "{at}: {problem}"
                    );
                }
            }
            let longer = [&original[..], b"\r\n"].concat();
            assert!(matches!(told(&longer).0, TexturesProblem::Format(_)));
        }
    }
}
