//! The files of a learned model, embedded or read from a folder.

use asperity_io::{
    diagnostic::Fault,
    input::{self, InputKind},
};
use std::{borrow::Cow, fmt::Display, path::Path};

/// The files of a model folder, embedded or read.
#[derive(Debug, Clone)]
pub struct Files {
    /// `model.json`.
    pub description: Cow<'static, str>,
    /// `text_projection.onnx`.
    pub text_projection: Cow<'static, [u8]>,
    /// `ar_decoder.onnx`.
    pub ar_decoder: Cow<'static, [u8]>,
    /// `tap_decoder.onnx`.
    pub tap_decoder: Cow<'static, [u8]>,
    /// `encoder.onnx`.
    pub encoder: Cow<'static, [u8]>,
    /// Their [`Files::checksum`] where it was computed ahead of time, so that 20 MB need not be read
    /// for it.
    pub known_crc32: Option<u32>,
}

impl Files {
    /// CRC-32 of all files, which tells one model from another.
    #[must_use]
    pub fn crc32(&self) -> u32 {
        self.known_crc32.unwrap_or_else(|| self.checksum())
    }

    /// CRC-32 of all files, computed.
    #[must_use]
    pub fn checksum(&self) -> u32 {
        let mut crc = crc32fast::Hasher::new();
        self.parts().into_iter().for_each(|part| crc.update(part));
        crc.finalize()
    }

    /// The bytes of each.
    pub(super) fn parts(&self) -> [&[u8]; 5] {
        [
            self.description.as_bytes(),
            &self.text_projection,
            &self.ar_decoder,
            &self.tap_decoder,
            &self.encoder,
        ]
    }

    /// Reads a model folder.
    ///
    /// # Errors
    /// [`Fault`] with the file.
    pub fn read(folder: &Path) -> Result<Self, Fault> {
        let bytes = |name: &str| {
            let path = folder.join(name);
            input::read(&path, InputKind::Network).map_err(|problem| Fault::from(problem).at(path))
        };
        let path = folder.join("model.json");
        let description = input::read_text(&path, InputKind::Description);
        let description = description.map_err(|problem| Fault::from(problem).at(path))?;
        Ok(Self {
            description: description.into(),
            text_projection: bytes("text_projection.onnx")?.into(),
            ar_decoder: bytes("ar_decoder.onnx")?.into(),
            tap_decoder: bytes("tap_decoder.onnx")?.into(),
            encoder: bytes("encoder.onnx")?.into(),
            known_crc32: None,
        })
    }
}

/// Returns the fault of a file of the folder: of its description, or of a network.
pub(crate) fn wrong_file(file: &str, what: impl Display) -> Fault {
    let remedy = "write the folder anew with `asperity-train fit`, or leave --model out for the embedded model";
    Fault::new(what, remedy).at(file)
}

/// Returns the fault of a text vector of another width than the projection takes.
pub(crate) fn wrong_width(expected: usize, found: usize) -> Fault {
    let what = format!(
        "text_projection.onnx takes vectors of {expected} numbers, the text encoder gives {found}"
    );
    let remedy = "train a projection for this encoder: asperity-train fit --text-encoder clip:DIR";
    Fault::new(what, remedy)
}
