//! The files of a texture: the bytes that commands write of it with their defaults.

use crate::{error::ApiError, texture::Texture};
use asperity::{
    interchange::{self, ClipFormat, Format, Language, Options, SourceOptions, export_source},
    views::{
        listen::{self, Gesture},
        plot,
    },
};
use std::{path::Path, sync::Arc};

/// Which file of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Download {
    Asset,
    /// The asset for the AudioWorklet.
    Worklet,
    /// The output of `asperity inspect --json`.
    Json,
    /// Its picture, stored or drawn.
    Picture,
    /// The colours that the page lights.
    Unlit,
    Normals,
    Heights,
    /// As `asperity plot`.
    Plot,
    /// As `asperity listen`.
    Sound,
    /// As `asperity export`.
    Export(Format),
    /// The header beside a C source.
    Header,
}

impl Download {
    /// The file with this ending.
    pub(crate) fn of(ending: &str) -> Option<Self> {
        Some(match ending {
            "asp" => Self::Asset,
            "worklet.asp" => Self::Worklet,
            "json" => Self::Json,
            "png" => Self::Picture,
            "unlit.png" => Self::Unlit,
            "normal.png" => Self::Normals,
            "height.png" => Self::Heights,
            "plot.png" => Self::Plot,
            "listen.wav" => Self::Sound,
            "export.h" => Self::Header,
            _ => {
                let wanted = ending.strip_prefix("export.")?;
                let mut formats = Format::ALL.into_iter();
                Self::Export(formats.find(|format| format.extension() == wanted)?)
            }
        })
    }

    /// Its type: that of what browsers show, and else bytes to be saved.
    pub(crate) const fn content_type(self) -> &'static str {
        match self {
            Self::Json => "application/json",
            Self::Picture | Self::Unlit | Self::Normals | Self::Heights | Self::Plot => "image/png",
            Self::Sound | Self::Export(Format::Clip(ClipFormat::Wav)) => "audio/wav",
            _ => "application/octet-stream",
        }
    }

    /// Its bytes.
    ///
    /// # Errors
    /// As the command.
    pub(crate) fn bytes(self, texture: &Texture) -> Result<Arc<[u8]>, ApiError> {
        Ok(match self {
            Self::Asset => Arc::clone(texture.asset()),
            Self::Worklet => texture.worklet()?,
            Self::Json => texture.inspected().into_bytes().into(),
            Self::Picture => texture.picture()?,
            Self::Unlit => texture.pictures()?.unlit,
            Self::Normals => texture.pictures()?.normal,
            Self::Heights => texture.pictures()?.height,
            Self::Plot => {
                let sheet = plot::of_asset(&texture.parsed()?);
                sheet.map_err(|e| ApiError::of(&e))?.into()
            }
            Self::Sound => {
                let session = Gesture::asked(None, None, false);
                let heard = listen::listen(&texture.parsed()?, &session, None, 0);
                heard.map_err(|e| ApiError::of(&e))?.wav.into()
            }
            Self::Export(Format::Source(language)) => source(texture, language)?.0.into(),
            Self::Header => source(texture, Language::C)?.1.unwrap_or_default().into(),
            Self::Export(Format::Clip(format)) => {
                let exported = interchange::export(&texture.parsed()?, format, &Options::default());
                exported.map_err(|e| ApiError::of(&e))?.bytes.into()
            }
        })
    }
}

/// Source text of the asset, and the header of a C source, which it includes by the name of the texture's file.
fn source(texture: &Texture, language: Language) -> Result<(Vec<u8>, Option<Vec<u8>>), ApiError> {
    let asset = texture.parsed()?;
    let header = Path::new(&texture.file()).with_extension("h");
    let header = header.to_string_lossy();
    let options = SourceOptions {
        header: (language == Language::C).then_some(&header),
        ..SourceOptions::default()
    };
    let written = export_source(language, asset.name(), texture.asset(), &options);
    let written = written.map_err(|e| ApiError::of(&e))?;
    Ok((written.text, written.header))
}
