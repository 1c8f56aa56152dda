//! A texture on the page: its bytes, and what the page shows of it.

use crate::{command_line, error::ApiError, http::Status, worklet_asset};
use asperity::{
    edit::{LatentEditor, explain},
    inspect::{self, Document},
    pipeline::{Clock, Request},
    preview::{self, PreviewError, SIZE, WIDTH_MM},
    prompt::{self, Options, Prompt, PromptCompiler},
    raise::raise,
    sources::Tools,
    textures::Textures,
    verify::VerifyError,
};
use asperity_formats::{Asset, FormatError};
use asperity_io::{clock::now, diagnostic::Diagnostic};
use serde::Serialize;
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use std::{
    fmt::Write as _,
    path::Path,
    sync::{Arc, OnceLock},
};

/// Bytes of the hash that names a texture: no two textures share it, even where someone tries.
const ID_BYTES: usize = 16;

/// A texture with what was found of it. What is rarely asked for is computed when it is.
pub(crate) struct Texture {
    id: String,
    asset: Arc<[u8]>,
    document: Document,
    pixels: u32,
    compiled: Option<Value>,
    command: Option<String>,
    worklet: OnceLock<Result<Arc<[u8]>, ApiError>>,
    pictures: OnceLock<Result<Pictures, ApiError>>,
}

/// The pictures of a texture as PNG.
#[derive(Clone)]
pub(crate) struct Pictures {
    /// What it looks like: as the asset holds it, or newly drawn where it holds none.
    pub(crate) color: Arc<[u8]>,
    /// Normals in tangent space, green up.
    pub(crate) normal: Arc<[u8]>,
    /// Heights, linear, 16 bits.
    pub(crate) height: Arc<[u8]>,
}

/// The answer of the interface.
#[derive(Serialize)]
struct Shown<'a> {
    id: &'a str,
    name: &'a str,
    seed: u64,
    asset_bytes: usize,
    model_rate_hz: f64,
    worklet_rate_hz: f64,
    preview: Size,
    inspect: &'a Document,
    compiled: &'a Option<Value>,
    command: &'a Option<String>,
}

#[derive(Serialize)]
struct Size {
    /// Width and height.
    pixels: u32,
    width_mm: f64,
}

impl Texture {
    /// Compiles a prompt with the options that `asperity compile` has without any.
    ///
    /// # Errors
    /// As the command.
    pub(crate) fn compiled(
        prompt_compiler: &PromptCompiler,
        text: &str,
        seed: u64,
    ) -> Result<Self, ApiError> {
        prompt::check(text).map_err(|e| ApiError::of(&e))?;
        let request: Request = Options::default().request;
        let source = Prompt {
            text: text.to_owned(),
            seed,
            picture: None,
        };
        let tools = Tools {
            clock: Clock(now),
            ..Tools::of(prompt_compiler)
        };
        let compiled = asperity::driver::compile(&source, &request, &tools)
            .map_err(|failure| ApiError::of(failure.as_ref()))?;
        let explanation =
            explain(&LatentEditor::new(prompt_compiler), text).map_err(|e| ApiError::of(&e))?;
        let mut report = compiled.json();
        explanation.add_to(&mut report);
        let command = command_line::compile(text, seed, &compiled.texture.name);
        Self::of(compiled.lowered.bytes, None, Some(report), command).map_err(damaged)
    }

    /// Opens the bytes of an asset, or of a library with one texture. `file` names them in errors.
    ///
    /// # Errors
    /// As a command that opens such a file.
    pub(crate) fn opened(file: &str, bytes: Vec<u8>) -> Result<Self, ApiError> {
        let refused = |error: &dyn Diagnostic| ApiError {
            status: Status::Unprocessable,
            ..ApiError::of(error)
        };
        let mut textures =
            Textures::from_reader(Path::new(file), &bytes[..]).map_err(|e| refused(&e))?;
        let name = textures.chosen_name(None).map_err(|e| refused(&e))?;
        let asset = textures.choose(None).map_err(|e| refused(&e))?;
        Self::of(asset, name, None, None).map_err(|e| refused(&textures.error(None, e.into())))
    }

    fn of(
        asset: Vec<u8>,
        name: Option<String>,
        compiled: Option<Value>,
        command: Option<String>,
    ) -> Result<Self, FormatError> {
        let parsed = Asset::parse(&asset)?;
        let stored = parsed
            .preview_png()
            .and_then(|png| preview::stored(png).ok());
        let digest = Sha256::digest(&asset);
        let id = digest[..ID_BYTES]
            .iter()
            .fold(String::new(), |mut id, byte| {
                // Writing to a string cannot fail.
                let _ = write!(id, "{byte:02x}");
                id
            });
        Ok(Self {
            id,
            document: match name {
                Some(name) => Document::named(&parsed, name),
                None => Document::of(&parsed),
            },
            pixels: stored.map_or(SIZE, |picture| picture.width),
            asset: asset.into(),
            compiled,
            command,
            worklet: OnceLock::new(),
            pictures: OnceLock::new(),
        })
    }

    /// What names it: a hash of its bytes.
    pub(crate) fn id(&self) -> &str {
        &self.id
    }

    /// The asset.
    pub(crate) fn asset(&self) -> &Arc<[u8]> {
        &self.asset
    }

    /// What `asperity inspect --json` prints of it.
    pub(crate) fn inspected(&self) -> String {
        inspect::json(&self.document) + "\n"
    }

    /// The answer of the interface, JSON.
    pub(crate) fn shown(&self) -> String {
        let rate_hz = self.document.ar.sample_rate_hz;
        inspect::json(&Shown {
            id: &self.id,
            name: &self.document.name,
            seed: self.document.provenance.seed,
            asset_bytes: self.asset.len(),
            model_rate_hz: rate_hz,
            worklet_rate_hz: worklet_asset::rate_hz(rate_hz),
            preview: Size {
                pixels: self.pixels,
                width_mm: WIDTH_MM,
            },
            inspect: &self.document,
            compiled: &self.compiled,
            command: &self.command,
        })
    }

    /// The asset for the AudioWorklet.
    ///
    /// # Errors
    /// Where its models cannot be converted to a rate that the worklet serves.
    pub(crate) fn worklet(&self) -> Result<Arc<[u8]>, ApiError> {
        let computed = self.worklet.get_or_init(|| {
            let asset = worklet_asset::worklet_asset(&self.asset);
            asset
                .map(Arc::from)
                .map_err(|failure| ApiError::of(failure.as_ref()))
        });
        computed.clone()
    }

    /// Its pictures.
    ///
    /// # Errors
    /// Where they cannot be drawn.
    pub(crate) fn pictures(&self) -> Result<Pictures, ApiError> {
        let drawn = self.pictures.get_or_init(|| {
            let asset = Asset::parse(&self.asset).map_err(damaged)?;
            self.draw(&asset).map_err(|e| ApiError::of(&e))
        });
        drawn.clone()
    }

    fn draw(&self, asset: &Asset<'_>) -> Result<Pictures, PreviewError> {
        let stored = asset.preview_png();
        let stored = stored.filter(|png| preview::stored(png).is_ok());
        let sizes = preview::SIZES;
        let size_px = self.pixels.clamp(*sizes.start(), *sizes.end());
        let picture = preview::draw(&raise(asset), size_px)?;
        Ok(Pictures {
            color: match stored {
                Some(png) => png.into(),
                None => picture.png()?.into(),
            },
            normal: picture.normal_png()?.into(),
            height: picture.height_png()?.into(),
        })
    }
}

fn damaged(error: FormatError) -> ApiError {
    ApiError::of(&VerifyError::from(error))
}
