//! The formats that are known, with their names and remedies.

/// Bytes in which the parts of an archive or the root of a document are looked for.
pub const HEAD: usize = 8192;

/// A format that is known, whether it is read or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// A Git LFS pointer, left in place of a file that was not fetched.
    LfsPointer,
    /// An asset of ours.
    Asset,
    /// A library of ours.
    Library,
    /// A model of ours, JSON.
    Model,
    /// A material of the HaTT.
    Hatt,
    /// XML of no other format here.
    Xml,
    /// The Apple Haptic and Audio Pattern.
    Ahap,
    /// `.haptic`, version 1.
    Haptic,
    /// MPEG haptics as JSON.
    Hjif,
    /// MPEG haptics as a binary stream.
    Hmpg,
    /// A NumPy array.
    Numpy,
    /// Sound or a recording.
    Wav,
    /// A PNG picture.
    Png,
    /// A TIFF picture.
    Tiff,
    /// A JPEG picture.
    Jpeg,
    /// A known format that no command reads.
    Unread(&'static Unread),
}

/// A format that is named, and not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unread {
    /// Its name, with an article.
    pub name: &'static str,
    /// The way to convert it into a format that is read.
    pub remedy: &'static str,
    /// True if it may hold the samples of a recording.
    pub holds_data: bool,
}

impl Format {
    /// Its name, with an article.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::LfsPointer => "a Git LFS pointer",
            Self::Asset => "an asset of asperity (.asp)",
            Self::Library => "a library of asperity (.aspl)",
            Self::Model => "an asperity model (JSON)",
            Self::Hatt => "a HaTT material (XML)",
            Self::Xml => "an XML document",
            Self::Ahap => "an AHAP (Apple Haptic and Audio Pattern)",
            Self::Haptic => "a .haptic file of version 1",
            Self::Hjif => "an HJIF file (MPEG haptics)",
            Self::Hmpg => "an HMPG stream (MPEG haptics)",
            Self::Numpy => "a NumPy array",
            Self::Wav => "a WAV file",
            Self::Png => "a PNG picture",
            Self::Tiff => "a TIFF picture",
            Self::Jpeg => "a JPEG picture",
            Self::Unread(unread) => unread.name,
        }
    }

    /// Returns true if it may hold the samples of a recording.
    #[must_use]
    pub const fn holds_data(self) -> bool {
        match self {
            Self::LfsPointer | Self::Numpy | Self::Wav => true,
            Self::Unread(unread) => unread.holds_data,
            _ => false,
        }
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
            Self::Xml => "give the file that was meant",
            Self::Ahap => "run `asperity import ahap FILE -o OUT.asp`",
            Self::Haptic => "run `asperity import haptic FILE -o OUT.asp`",
            Self::Hjif => "run `asperity import hjif FILE -o OUT.asp`",
            Self::Hmpg => {
                "decode it to HJIF with the Decoder of MPEG's haptic reference software, then run \
                 `asperity import hjif`"
            }
            Self::Numpy => AS_CSV,
            Self::Wav => "a recording goes to `asperity import recording`",
            Self::Png | Self::Tiff | Self::Jpeg => {
                "give the file that it was made of; a map of heights goes to `asperity import surface`"
            }
            Self::Unread(unread) => unread.remedy,
        }
    }
}

/// Remedy for arrays and tables of numbers.
pub(super) const AS_CSV: &str =
    "export its numbers as CSV; a recording goes to `asperity import recording`";
