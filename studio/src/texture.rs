//! A texture on the page: its bytes, and what the page shows of it.

use crate::{
    error::ApiError,
    prompts::Loaded,
    recipe::{Operation, Recipe},
    worklet_asset,
};
use asperity::{
    emit::{raise::raise, verify::VerifyError},
    learned::Certainty,
    sources::latents::{AXES, Axis, Memory, remembered},
    views::{
        inspect::{self, Document},
        preview::{self, SIZE, WIDTH_MM, not_encoded},
    },
};
use asperity_formats::{Asset, FormatError};
use asperity_io::{diagnostic::Fault, output::FileNames};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use sha2::{Digest as _, Sha256};
use std::{
    fmt::Write as _,
    sync::{Arc, OnceLock},
};

/// Bytes of the hash that names a texture.
const ID_BYTES: usize = 16;
/// Letters of that name.
pub(crate) const ID_LETTERS: usize = 2 * ID_BYTES;

/// A texture with what was found of it. What is rarely asked for is computed when it is.
pub(crate) struct Texture {
    id: String,
    asset: Arc<[u8]>,
    document: Document,
    pixels: u32,
    compiled: Option<Value>,
    made: Option<Value>,
    recipe: Option<Recipe>,
    worklet: OnceLock<Result<Arc<[u8]>, ApiError>>,
    pictures: OnceLock<Result<Pictures, ApiError>>,
}

/// The pictures of a texture as PNG.
#[derive(Clone)]
pub(crate) struct Pictures {
    /// Its appearance: as stored in the asset, or drawn where the asset has none.
    pub(crate) color: Arc<[u8]>,
    /// The same without its light, where it was drawn here: what the page lights by the normals.
    pub(crate) unlit: Arc<[u8]>,
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
    made: &'a Option<Value>,
    places: Map<String, Value>,
    editable: bool,
    certainty: Option<Certainty>,
    file: String,
    command: Option<String>,
    link: Option<String>,
}

#[derive(Serialize)]
struct Size {
    /// Width and height.
    pixels: u32,
    width_mm: f64,
}

/// What the bytes of a texture do not say of it, for a project.
#[derive(Serialize, Deserialize)]
pub(crate) struct Record {
    name: String,
    compiled: Option<Value>,
    made: Option<Value>,
    recipe: Option<Recipe>,
}

/// Provenance of a texture, as far as it is known.
#[derive(Default)]
pub(crate) struct Making<'a> {
    /// The report of a prompt's compilation.
    pub(crate) compiled: Option<Value>,
    /// The report of a mixture or an edit.
    pub(crate) made: Option<Value>,
    /// The name in the index of the library that it was opened from.
    pub(crate) indexed: Option<String>,
    /// The textures that it was derived from.
    pub(crate) others: &'a [&'a Texture],
}

impl Texture {
    /// The texture of these bytes; `operation` says how a command comes to them, from what names them.
    ///
    /// # Errors
    /// For damaged bytes.
    pub(crate) fn new(
        asset: Vec<u8>,
        making: Making<'_>,
        operation: impl FnOnce(&str) -> Operation,
    ) -> Result<Self, FormatError> {
        let name = match making.indexed {
            Some(name) => name,
            None => Asset::parse(&asset)?.name().to_owned(),
        };
        let id = hash(&asset);
        let others = making.others.iter().map(|other| other.recipe.as_ref());
        let record = Record {
            recipe: Recipe::new(others, &id, &name, operation(&id)),
            name,
            compiled: making.compiled,
            made: making.made,
        };
        Self::restored(asset, record)
    }

    /// The texture of these bytes, of which this is known.
    ///
    /// # Errors
    /// For damaged bytes.
    pub(crate) fn restored(asset: Vec<u8>, record: Record) -> Result<Self, FormatError> {
        let parsed = Asset::parse(&asset)?;
        let stored = parsed
            .preview_png()
            .and_then(|png| preview::stored(png).ok());
        Ok(Self {
            document: Document::named(&parsed, record.name),
            id: hash(&asset),
            pixels: stored.map_or(SIZE, |picture| picture.width),
            asset: asset.into(),
            compiled: record.compiled,
            made: record.made,
            recipe: record.recipe,
            worklet: OnceLock::new(),
            pictures: OnceLock::new(),
        })
    }

    /// What its bytes do not say.
    pub(crate) fn record(&self) -> Record {
        Record {
            name: self.document.name.clone(),
            compiled: self.compiled.clone(),
            made: self.made.clone(),
            recipe: self.recipe.clone(),
        }
    }

    /// Returns its identifier: a hash of its bytes.
    pub(crate) fn id(&self) -> &str {
        &self.id
    }

    /// Its name.
    pub(crate) fn name(&self) -> &str {
        &self.document.name
    }

    /// The asset.
    pub(crate) fn asset(&self) -> &Arc<[u8]> {
        &self.asset
    }

    /// Returns the output of `asperity inspect --json`.
    pub(crate) fn inspected(&self) -> String {
        inspect::json(&self.document) + "\n"
    }

    /// The asset, read.
    ///
    /// # Errors
    /// Never, for it was read before.
    pub(crate) fn parsed(&self) -> Result<Asset<'_>, ApiError> {
        Asset::parse(&self.asset).map_err(damaged)
    }

    /// The name of a file for it: that which its command writes.
    pub(crate) fn file(&self) -> String {
        let own = self.recipe.as_ref().and_then(Recipe::file);
        let named = || FileNames::of(&[&self.document.name], "asp").files.pop();
        own.or_else(named).unwrap_or_default()
    }

    /// The answer of the interface, JSON. Without a prompt compiler there are no sliders, and nothing is edited.
    pub(crate) fn shown(&self, prompts: Option<&Loaded>) -> String {
        let rate_hz = self.document.ar.sample_rate_hz;
        let place = |axis: Axis| {
            let place = prompts.and_then(|loaded| self.place(axis, loaded));
            (axis.name().to_owned(), json!(place))
        };
        let memory = self.memory();
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
            made: &self.made,
            places: AXES.into_iter().map(place).collect(),
            editable: prompts.is_some_and(|loaded| self.has_latent(loaded)),
            certainty: memory.and_then(|memory| memory.history.certainty),
            file: self.file(),
            command: self.recipe.as_ref().and_then(Recipe::command),
            link: self.recipe.as_ref().and_then(Recipe::link),
        })
    }

    /// Where it lies on a slider, 0 to 100 for most materials.
    pub(crate) fn place(&self, axis: Axis, loaded: &Loaded) -> Option<f64> {
        loaded.scale.place(axis, &self.document.attributes)
    }

    /// Returns true if it has a latent of this prompt compiler, so that it can be edited and mixed.
    pub(crate) fn has_latent(&self, loaded: &Loaded) -> bool {
        let memory = self.memory();
        memory.is_some_and(|it| loaded.compiler.model().has_latent_of(it.model_crc32))
    }

    /// The report of its prompt, as `asperity compile --json`.
    pub(crate) fn compiled(&self) -> Option<&Value> {
        self.compiled.as_ref()
    }

    /// What it remembers of how it was made, if it does.
    fn memory(&self) -> Option<Memory> {
        let asset = Asset::parse(&self.asset).ok()?;
        remembered(&asset).ok().flatten()
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

    /// Its appearance, as it is stored or else drawn.
    ///
    /// # Errors
    /// Where it cannot be drawn.
    pub(crate) fn picture(&self) -> Result<Arc<[u8]>, ApiError> {
        let asset = self.parsed()?;
        match stored_picture(&asset) {
            Some(png) => Ok(png.into()),
            None => Ok(self.pictures()?.color),
        }
    }

    /// Its pictures.
    ///
    /// # Errors
    /// Where they cannot be drawn.
    pub(crate) fn pictures(&self) -> Result<Pictures, ApiError> {
        let drawn = self.pictures.get_or_init(|| {
            let asset = self.parsed()?;
            self.draw(&asset).map_err(|e| ApiError::of(&e))
        });
        drawn.clone()
    }

    fn draw(&self, asset: &Asset<'_>) -> Result<Pictures, Fault> {
        let stored = stored_picture(asset);
        let sizes = preview::SIZES;
        let size_px = self.pixels.clamp(*sizes.start(), *sizes.end());
        let picture = preview::draw(&raise(asset), size_px)?;
        let drawn = || picture.compact_png().map_err(not_encoded);
        // A picture from elsewhere has its light for good.
        let foreign = match stored {
            Some(png) if png != drawn()? => Some(png),
            _ => None,
        };
        Ok(Pictures {
            color: match stored {
                Some(png) => png.into(),
                None => picture.png().map_err(not_encoded)?.into(),
            },
            unlit: match foreign {
                Some(png) => png.into(),
                None => picture.unlit_png().map_err(not_encoded)?.into(),
            },
            normal: picture.normal_png().map_err(not_encoded)?.into(),
            height: picture.height_png().map_err(not_encoded)?.into(),
        })
    }
}

#[cfg(test)]
impl Texture {
    /// A texture that holds these bytes, which need not be an asset, under this identifier.
    pub(crate) fn of_bytes(id: &str, bytes: &Arc<[u8]>) -> Self {
        let asset =
            asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None).unwrap();
        let operation = |id: &str| Operation::Encode { texture: id.into() };
        let texture = Self::new(asset.bytes, Making::default(), operation).unwrap();
        Self {
            id: id.into(),
            asset: Arc::clone(bytes),
            ..texture
        }
    }
}

/// The picture that an asset holds, if it can be shown.
fn stored_picture<'a>(asset: &Asset<'a>) -> Option<&'a [u8]> {
    asset
        .preview_png()
        .filter(|png| preview::stored(png).is_ok())
}

/// Returns the identifier of the bytes: a collision-resistant hash.
pub(crate) fn hash(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest[..ID_BYTES]
        .iter()
        .fold(String::new(), |mut id, byte| {
            // Writing to a string cannot fail.
            let _ = write!(id, "{byte:02x}");
            id
        })
}

/// The words of commands for bytes that are no asset.
pub(crate) fn damaged(error: FormatError) -> ApiError {
    ApiError::of(&VerifyError::from(error))
}
