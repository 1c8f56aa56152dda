//! What a file really is, told by its first bytes or by the keys of its JSON.

use super::trailing_commas::without_trailing_commas;
use serde::de::{
    DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor,
};
use std::fmt;

/// First lines of a Git LFS pointer, of today and of its first versions.
const POINTERS: [&[u8]; 2] = [
    b"version https://git-lfs.github.com/spec/",
    b"version https://hawser.github.com/spec/",
];
/// Most bytes of a pointer.
pub(super) const POINTER_BYTES: u64 = 1024;
/// Bytes in which the parts of an archive or the root of a document are looked for.
pub const HEAD: usize = 8192;
/// Keys of an object that are looked at.
const KEYS: usize = 64;
/// Header of a unit of an HMPG, bytes.
const UNIT: usize = 9;

/// A format that is known, whether it is read or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// What Git LFS leaves in the place of a file that was not fetched.
    LfsPointer,
    /// An asset of ours.
    Asset,
    /// A library of ours.
    Library,
    /// A model of ours, JSON.
    Model,
    /// A material of the HaTT.
    Hatt,
    /// The Apple Haptic and Audio Pattern.
    Ahap,
    /// `.haptic`, version 1.
    Haptic,
    /// The version of `.haptic` before 1.
    Vij,
    /// MPEG haptics as JSON.
    Hjif,
    /// MPEG haptics as a binary stream.
    Hmpg,
    /// bHaptics `.tact`.
    Tact,
    /// Interhaptics `.haps`.
    Haps,
    /// A project of Haptics Studio.
    Hasp,
    /// A scene, as JSON or binary.
    Gltf,
    /// MATLAB data.
    Matlab,
    /// HDF5 data.
    Hdf5,
    /// A NumPy array.
    Numpy,
    /// Many NumPy arrays.
    NumpyArchive,
    /// LabVIEW data.
    Tdms,
    /// Columns of Parquet, Arrow or Feather.
    Parquet,
    /// Messages of ROS.
    RosBag,
    /// A database.
    Sqlite,
    /// An Excel workbook.
    Excel,
    /// Sound or a recording.
    Wav,
    /// A picture.
    Png,
    /// A page.
    Pdf,
    /// A page of the web, often an error instead of a download.
    Html,
    /// A zip archive.
    Zip,
    /// A gzip archive.
    Gzip,
}

impl Format {
    /// The format of a file, or of its beginning; `None` for one that is not known.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Option<Self> {
        Self::of_magic(bytes).or_else(|| Self::of_json(bytes))
    }

    /// The format by the first bytes alone.
    pub(super) fn of_magic(bytes: &[u8]) -> Option<Self> {
        let head = &bytes[..bytes.len().min(HEAD)];
        let has = |part: &[u8]| head.windows(part.len()).any(|window| window == part);
        let text = head
            .strip_prefix(b"\xef\xbb\xbf")
            .unwrap_or(head)
            .trim_ascii_start();
        let opens = |tag: &str| {
            text.get(..tag.len())
                .is_some_and(|start| start.eq_ignore_ascii_case(tag.as_bytes()))
        };
        let magics: [(&[u8], Self); 16] = [
            (b"ASPT", Self::Asset),
            (b"ASPL", Self::Library),
            (b"glTF", Self::Gltf),
            (b"MATLAB 5.0 MAT-file", Self::Matlab),
            (b"MATLAB 7.3 MAT-file", Self::Matlab),
            (b"\x89HDF\r\n\x1a\n", Self::Hdf5),
            (b"\x93NUMPY", Self::Numpy),
            (b"TDSm", Self::Tdms),
            (b"PAR1", Self::Parquet),
            (b"ARROW1", Self::Parquet),
            (b"#ROSBAG V", Self::RosBag),
            (b"\x89MCAP", Self::RosBag),
            (b"SQLite format 3\0", Self::Sqlite),
            (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", Self::Excel),
            (b"\x89PNG\r\n\x1a\n", Self::Png),
            (b"%PDF-", Self::Pdf),
        ];
        if POINTERS.iter().any(|start| text.starts_with(start)) {
            Some(Self::LfsPointer)
        } else if let Some((_, format)) = magics.iter().find(|(magic, _)| head.starts_with(magic)) {
            Some(*format)
        } else if head.starts_with(b"RIFF") && head.get(8..12) == Some(b"WAVE") {
            Some(Self::Wav)
        } else if head.starts_with(b"PK\x03\x04") {
            Some(match (has(b"xl/"), has(b".npy")) {
                (true, _) => Self::Excel,
                (_, true) => Self::NumpyArchive,
                _ => Self::Zip,
            })
        } else if head.starts_with(b"\x1f\x8b") {
            Some(Self::Gzip)
        } else if opens("<!doctype html") || opens("<html") {
            Some(Self::Html)
        } else if opens("<") && has(b"<modelSet") {
            Some(Self::Hatt)
        } else {
            is_hmpg(bytes).then_some(Self::Hmpg)
        }
    }

    fn of_json(bytes: &[u8]) -> Option<Self> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        if bytes.trim_ascii_start().first() != Some(&b'{') {
            return None;
        }
        // A part of a file may end within a character.
        let text = match std::str::from_utf8(bytes) {
            Ok(text) => text,
            Err(error) => std::str::from_utf8(&bytes[..error.valid_up_to()]).ok()?,
        };
        let mut keys = Vec::new();
        let text = without_trailing_commas(text);
        // A fault behind the keys that tell is for the reader of the format to name.
        let _ = Keys(&mut keys).deserialize(&mut serde_json::Deserializer::from_str(&text));
        let of = |key: &str| {
            keys.iter()
                .find(|(name, _)| name == key)
                .map(|(_, value)| value)
        };
        let has = |key: &str| of(key).is_some();
        let within = |key: &str, inner: &[&str]| match of(key) {
            Some(Shape::Object(names)) => names.iter().any(|name| inner.contains(&name.as_str())),
            _ => false,
        };
        if of("format") == Some(&Shape::Text("asperity-model".into())) {
            Some(Self::Model)
        } else if has("Pattern") {
            Some(Self::Ahap)
        } else if has("signals") {
            Some(Self::Haptic)
        } else if of("version") == Some(&Shape::Number) && has("tracks") {
            Some(Self::Vij)
        } else if has("perceptions") {
            Some(Self::Hjif)
        } else if has("m_vibration") || has("m_version") || has("m_stiffness") || has("m_texture") {
            Some(Self::Haps)
        } else if within("project", &["layout", "tracks"]) {
            Some(Self::Tact)
        } else if has("clips") && has("version") {
            Some(Self::Hasp)
        } else if within("asset", &["version"]) {
            Some(Self::Gltf)
        } else {
            None
        }
    }

    /// Its name, with an article.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::LfsPointer => "a Git LFS pointer",
            Self::Asset => "an asset of asperity (.asp)",
            Self::Library => "a library of asperity (.aspl)",
            Self::Model => "an asperity model (JSON)",
            Self::Hatt => "a HaTT material (XML)",
            Self::Ahap => "an AHAP (Apple Haptic and Audio Pattern)",
            Self::Haptic => "a .haptic file of version 1",
            Self::Vij => "a .haptic file of version 0 (.vij)",
            Self::Hjif => "an HJIF file (MPEG haptics)",
            Self::Hmpg => "an HMPG stream (MPEG haptics)",
            Self::Tact => "a bHaptics .tact file",
            Self::Haps => "an Interhaptics .haps file",
            Self::Hasp => "a Haptics Studio project (.hasp)",
            Self::Gltf => "a glTF scene",
            Self::Matlab => "a MATLAB file (.mat)",
            Self::Hdf5 => "an HDF5 file",
            Self::Numpy => "a NumPy array",
            Self::NumpyArchive => "an archive of NumPy arrays (.npz)",
            Self::Tdms => "a LabVIEW TDMS file (.tdms)",
            Self::Parquet => "a file of Parquet or Arrow columns",
            Self::RosBag => "a bag of ROS messages",
            Self::Sqlite => "an SQLite database",
            Self::Excel => "an Excel workbook",
            Self::Wav => "a WAV file",
            Self::Png => "a PNG picture",
            Self::Pdf => "a PDF document",
            Self::Html => "a web page (HTML)",
            Self::Zip => "a zip archive",
            Self::Gzip => "a gzip archive",
        }
    }

    /// Whether the numbers of a recording may be in it.
    #[must_use]
    pub const fn holds_data(self) -> bool {
        matches!(
            self,
            Self::Matlab
                | Self::Hdf5
                | Self::Numpy
                | Self::NumpyArchive
                | Self::Tdms
                | Self::Parquet
                | Self::RosBag
                | Self::Sqlite
                | Self::Excel
                | Self::Wav
                | Self::Zip
                | Self::Gzip
                | Self::LfsPointer
        )
    }

    /// The command that reads it, or how it becomes something that is read.
    #[must_use]
    pub const fn remedy(self) -> &'static str {
        match self {
            Self::LfsPointer => "run `git lfs pull` in its repository, which fetches the file",
            Self::Asset | Self::Library => {
                "it is compiled already: `asperity inspect FILE` shows it"
            }
            Self::Model => "run `asperity import model FILE -o OUT.asp`",
            Self::Hatt => "run `asperity import hatt FILE -o OUT.asp`",
            Self::Ahap => "run `asperity import ahap FILE -o OUT.asp`",
            Self::Haptic => "run `asperity import haptic FILE -o OUT.asp`",
            Self::Vij => {
                "export it again as .haptic of version 1, then run `asperity import haptic`"
            }
            Self::Hjif => "run `asperity import hjif FILE -o OUT.asp`",
            Self::Hmpg => {
                "decode it to HJIF with the Decoder of MPEG's haptic reference software, then run \
                 `asperity import hjif`"
            }
            Self::Tact | Self::Haps => {
                "it is not read: export the effect as AHAP, .haptic or HJIF, then run `asperity import \
                 ahap`, `haptic` or `hjif`"
            }
            Self::Hasp => {
                "export its clip from Haptics Studio as .haptic, then run `asperity import haptic`"
            }
            Self::Gltf => {
                "a scene is not read: give the effect that it refers to, such as an HJIF, to `asperity \
                 import hjif`"
            }
            Self::Matlab
            | Self::Hdf5
            | Self::Numpy
            | Self::NumpyArchive
            | Self::Tdms
            | Self::Parquet
            | Self::RosBag
            | Self::Sqlite => {
                "export its numbers as CSV; a recording goes to `asperity import recording`"
            }
            Self::Excel => "save the sheet as CSV",
            Self::Wav => "a recording goes to `asperity import recording`",
            Self::Png | Self::Pdf => "give the file that this was made of",
            Self::Html => "download the file itself, not the page that shows it",
            Self::Zip | Self::Gzip => "unpack it, and give the file in it",
        }
    }
}

/// Whether units fill the file: first one of the kind of metadata, then those of known kinds.
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

/// As much of a value as tells formats apart.
#[derive(Debug, PartialEq)]
enum Shape {
    Number,
    Text(String),
    Object(Vec<String>),
    Other,
}

/// Collects keys and shapes, up to the first fault.
struct Keys<'a>(&'a mut Vec<(String, Shape)>);

impl<'de> DeserializeSeed<'de> for Keys<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Keys<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            if self.0.len() == KEYS {
                return Err(A::Error::custom("no format has so many keys"));
            }
            self.0.push((key, Shape::Other));
            let shape = map.next_value_seed(ShapeOf)?;
            if let Some(last) = self.0.last_mut() {
                last.1 = shape;
            }
        }
        Ok(())
    }
}

struct ShapeOf;

impl<'de> DeserializeSeed<'de> for ShapeOf {
    type Value = Shape;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Shape, D::Error> {
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for ShapeOf {
    type Value = Shape;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E>(self) -> Result<Shape, E> {
        Ok(Shape::Other)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Shape, E> {
        Ok(Shape::Other)
    }

    fn visit_i64<E>(self, _: i64) -> Result<Shape, E> {
        Ok(Shape::Number)
    }

    fn visit_u64<E>(self, _: u64) -> Result<Shape, E> {
        Ok(Shape::Number)
    }

    fn visit_f64<E>(self, _: f64) -> Result<Shape, E> {
        Ok(Shape::Number)
    }

    fn visit_str<E>(self, text: &str) -> Result<Shape, E> {
        Ok(Shape::Text(text.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Shape, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Shape::Other)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Shape, A::Error> {
        let mut names = Vec::new();
        while let Some((name, _)) = map.next_entry::<String, IgnoredAny>()? {
            if names.len() < KEYS {
                names.push(name);
            }
        }
        Ok(Shape::Object(names))
    }
}
