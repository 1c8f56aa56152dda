//! Formats by their first bytes.

use super::format::{AS_CSV, Format, HEAD, Unread};

/// First lines of a Git LFS pointer, of today and of its first versions.
const POINTERS: [&[u8]; 2] = [
    b"version https://git-lfs.github.com/spec/",
    b"version https://hawser.github.com/spec/",
];
/// Most bytes of a pointer.
pub(super) const POINTER_BYTES: u64 = 1024;
/// Header of a unit of an HMPG, bytes.
const UNIT: usize = 9;

const SOURCE: &str = "give the file that this was made of";
const SOUND: &str = "convert it to WAV; a recording goes to `asperity import recording`";
const UNPACK: &str = "unpack it, and give the file in it";
const MEANT: &str = "give the file that was meant";

/// First bytes of formats that nothing here reads, with their names and remedies.
static UNREAD: [(&[u8], Unread); 26] = [
    (b"glTF", GLTF),
    (b"bplist00", PLIST),
    (b"MATLAB 5.0 MAT-file", data("a MATLAB file (.mat)", AS_CSV)),
    (b"MATLAB 7.3 MAT-file", data("a MATLAB file (.mat)", AS_CSV)),
    (b"\x89HDF\r\n\x1a\n", data("an HDF5 file", AS_CSV)),
    // Not the head of a table, such as PAR1,PAR2.
    (b"PAR1\x15", data("a Parquet file", AS_CSV)),
    (b"PAR1\0", data("a Parquet file", AS_CSV)),
    (b"ARROW1\0", data("an Arrow file", AS_CSV)),
    (b"TDSm", data("a LabVIEW TDMS file (.tdms)", AS_CSV)),
    (b"#ROSBAG V", data("a bag of ROS messages", AS_CSV)),
    (b"\x89MCAP", data("a bag of ROS messages (MCAP)", AS_CSV)),
    (b"SQLite format 3\0", data("an SQLite database", AS_CSV)),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", EXCEL),
    (b"GIF89a", unread("a GIF picture", SOURCE)),
    (b"%PDF-", unread("a PDF document", SOURCE)),
    (
        b"MThd\0\0",
        unread("a MIDI file", "export the effect as AHAP, .haptic or HJIF"),
    ),
    (b"OggS\0", unread("an Ogg sound", SOUND)),
    (b"fLaC\0", unread("a FLAC sound", SOUND)),
    (b"ID3\x03", unread("an MP3 sound", SOUND)),
    (b"ID3\x04", unread("an MP3 sound", SOUND)),
    (b"\x1f\x8b", data("a gzip archive", UNPACK)),
    (b"\xfd7zXZ\0", data("an xz archive", UNPACK)),
    (b"\x28\xb5\x2f\xfd", data("a zstd archive", UNPACK)),
    (b"7z\xbc\xaf\x27\x1c", data("a 7z archive", UNPACK)),
    (b"Rar!\x1a\x07", data("a RAR archive", UNPACK)),
    (b"\x7fELF", unread("a program", MEANT)),
];
pub(super) const GLTF: Unread = unread(
    "a glTF scene",
    "a scene is not read: give the effect that it refers to, such as an HJIF, to `asperity import hjif`",
);
pub(super) const PLIST: Unread = unread(
    "a property list (plist)",
    "convert it with `plutil -convert json`; an AHAP is JSON, and goes to `asperity import ahap`",
);
const EXCEL: Unread = data("an Excel workbook", "save the sheet as CSV");
const ZIP: Unread = data("a zip archive", UNPACK);
const NPZ: Unread = data("an archive of NumPy arrays (.npz)", AS_CSV);
const BZIP2: Unread = data("a bzip2 archive", UNPACK);
const TAR: Unread = data("a tar archive", UNPACK);

/// A format that holds no recording.
pub(super) const fn unread(name: &'static str, remedy: &'static str) -> Unread {
    Unread {
        name,
        remedy,
        holds_data: false,
    }
}

/// An unread format that may hold the samples of a recording.
const fn data(name: &'static str, remedy: &'static str) -> Unread {
    Unread {
        holds_data: true,
        ..unread(name, remedy)
    }
}

/// An unread format by its name and remedy.
macro_rules! named {
    ($name:expr, $remedy:expr $(,)?) => {
        Some(Format::Unread(
            &const { $crate::input::signatures::unread($name, $remedy) },
        ))
    };
}
pub(super) use named;

/// The format that begins with these bytes.
pub(super) fn of(bytes: &[u8]) -> Option<Format> {
    let head = &bytes[..bytes.len().min(HEAD)];
    let has = |part: &[u8]| head.windows(part.len()).any(|window| window == part);
    let text = without_mark(head).trim_ascii_start();
    let known = UNREAD.iter().find(|(magic, ..)| head.starts_with(magic));
    if POINTERS.iter().any(|start| text.starts_with(start)) {
        Some(Format::LfsPointer)
    } else if head.starts_with(b"ASPT") {
        Some(Format::Asset)
    } else if head.starts_with(b"ASPL") {
        Some(Format::Library)
    } else if head.starts_with(b"\x93NUMPY") {
        Some(Format::Numpy)
    } else if head.starts_with(b"\x89PNG\r\n\x1a\n") {
        Some(Format::Png)
    } else if head.starts_with(b"II*\0") || head.starts_with(b"MM\0*") {
        Some(Format::Tiff)
    } else if head.starts_with(b"\xff\xd8\xff") {
        Some(Format::Jpeg)
    } else if let Some((_, unread)) = known {
        Some(Format::Unread(unread))
    } else if let (b"RIFF", Some(kind)) = (head.get(..4).unwrap_or_default(), head.get(8..12)) {
        match kind {
            b"WAVE" => Some(Format::Wav),
            b"WEBP" => named!("a WebP picture", SOURCE),
            b"AVI " => named!("a video (AVI)", SOURCE),
            _ => None,
        }
    } else if head.starts_with(b"FORM") && head.get(8..11) == Some(b"AIF") {
        named!("an AIFF sound", SOUND)
    } else if head.starts_with(b"\0\0\0") && head.get(4..8) == Some(b"ftyp") {
        named!("a video or a sound (MP4)", SOURCE)
    } else if head.get(257..262) == Some(b"ustar") {
        Some(Format::Unread(&TAR))
    } else if head.starts_with(b"BZh") && head.get(4..10) == Some(b"1AY&SY") {
        Some(Format::Unread(&BZIP2))
    } else if head.starts_with(b"PK\x03\x04") {
        Some(Format::Unread(match (has(b"xl/"), has(b".npy")) {
            (true, _) => &EXCEL,
            (_, true) => &NPZ,
            _ => &ZIP,
        }))
    } else {
        is_hmpg(bytes).then_some(Format::Hmpg)
    }
}

/// The bytes of a text without its byte order mark.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// Returns true if HMPG units fill the file: first a metadata unit, then units of known kinds.
fn is_hmpg(bytes: &[u8]) -> bool {
    let mut rest = bytes;
    let mut units = 0;
    while let Some((header, after)) = rest.split_at_checked(UNIT) {
        let header = header
            .iter()
            .fold(0_u128, |sum, byte| sum << 8 | u128::from(*byte));
        let (kind, length) = (header >> 66, (header >> 4 & 0xffff_ffff) as usize);
        if kind > 4 || (units == 0 && (kind != 0 || length == 0)) {
            return false;
        }
        let Some(next) = after.get(length..) else {
            return false;
        };
        rest = next;
        units += 1;
    }
    units > 0 && rest.is_empty()
}
