//! The textures of a study, compiled.

use super::{
    design::{Design, TextureEntry},
    text::Text,
};
use crate::{
    error::ApiError,
    making,
    opening::{self, FileContent},
    prompts::Loaded,
    recipe::Operation,
    texture::Texture,
};
use asperity::sources::latents::{AXES, Axis};
use asperity_io::diagnostic::Fault;
use serde::Serialize;
use serde_json::{Map, Value, json};
use sha2::{Digest as _, Sha256};
use std::{collections::HashMap, fmt::Write as _, fs, path::Path, sync::Arc};
use toml::Spanned;

/// Bytes of a texture's file.
const FILE_BYTES: u64 = 64 << 20;

/// A texture that participants rate.
pub(crate) struct Stimulus {
    pub(crate) entry: Described,
    pub(crate) texture: Arc<Texture>,
}

/// Its description for the analysis.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Described {
    pub(crate) name: String,
    pub(crate) anchor: bool,
    /// The textures that it lies between, and where.
    pub(crate) anchors: Option<[String; 2]>,
    pub(crate) t: Option<f64>,
    /// SHA-256 of the asset, hexadecimal.
    pub(crate) sha256: String,
    /// Its places on the scales of the studio's sliders, 0 to 100: what the software predicts.
    pub(crate) attributes: Map<String, Value>,
}

/// Compiles every texture; `done` is called after each.
///
/// # Errors
/// Every [`Fault`], with the line of its texture.
pub(crate) fn compile(
    design: &Design,
    text: &Text,
    loaded: &Loaded,
    done: impl Fn(),
) -> Result<Vec<Stimulus>, Vec<Fault>> {
    let mut found: HashMap<&str, Arc<Texture>> = HashMap::new();
    let mut stimuli = Vec::new();
    let mut faults = Vec::new();
    for (at, spanned) in design.textures.iter().enumerate() {
        let entry = spanned.get_ref();
        match texture(entry, text, loaded, &found) {
            Ok(texture) => {
                found.insert(&entry.name, Arc::clone(&texture));
                let t = entry.between.is_some().then_some(entry.t);
                let described = described(
                    &entry.name,
                    entry.anchor,
                    entry.between.clone(),
                    t,
                    &texture,
                    loaded,
                );
                stimuli.push(Stimulus {
                    entry: described,
                    texture,
                });
            }
            Err(error) => faults.push(fault(text, spanned, at, error)),
        }
        done();
    }
    if design.midpoints && faults.is_empty() {
        let anchors: Vec<_> = design
            .textures
            .iter()
            .filter(|it| it.get_ref().anchor)
            .collect();
        for (at, a) in anchors.iter().enumerate() {
            for b in &anchors[at + 1..] {
                let names = [a.get_ref().name.clone(), b.get_ref().name.clone()];
                match between(&names, 0.5, loaded, &found) {
                    Ok(texture) => {
                        let name = names.join("+");
                        let described =
                            described(&name, false, Some(names), Some(0.5), &texture, loaded);
                        stimuli.push(Stimulus {
                            entry: described,
                            texture,
                        });
                    }
                    Err(error) => faults.push(fault(text, a, at, error)),
                }
                done();
            }
        }
    }
    if faults.is_empty() {
        Ok(stimuli)
    } else {
        Err(faults)
    }
}

fn fault(text: &Text, spanned: &Spanned<TextureEntry>, at: usize, error: ApiError) -> Fault {
    let remedy = error.help.unwrap_or_default();
    text.fault(spanned, format!("texture[{at}]"), error.error, &remedy)
}

fn texture(
    entry: &TextureEntry,
    text: &Text,
    loaded: &Loaded,
    found: &HashMap<&str, Arc<Texture>>,
) -> Result<Arc<Texture>, ApiError> {
    if let Some(prompt) = entry.prompt.clone() {
        return prompted(prompt, entry.seed, loaded);
    }
    if let Some(names) = &entry.between {
        return between(names, entry.t, loaded, found);
    }
    let file = entry.file.as_deref().unwrap_or(Path::new(""));
    let path = text.path.parent().unwrap_or(Path::new("")).join(file);
    let shown = path.display().to_string();
    let failed = |error: std::io::Error| {
        let fault = Fault::new(
            format!("cannot be read: {error}"),
            "check its path, which begins at the study's file",
        );
        ApiError::of(&fault.at(&path))
    };
    if fs::metadata(&path).map_err(failed)?.len() > FILE_BYTES {
        let fault = Fault::new("too large for a texture", "give an asset or a material").at(&path);
        return Err(ApiError::of(&fault));
    }
    match opening::open(&shown, fs::read(&path).map_err(failed)?)? {
        FileContent::Texture(texture) => Ok(Arc::new(*texture)),
        FileContent::Library(_) => {
            let fault =
                Fault::new("several textures", "extract one of them: asperity extract").at(&path);
            Err(ApiError::of(&fault))
        }
    }
}

/// The texture of a prompt, as `asperity compile`.
///
/// # Errors
/// As that command.
pub(crate) fn prompted(
    prompt: String,
    seed: u64,
    loaded: &Loaded,
) -> Result<Arc<Texture>, ApiError> {
    making::perform(loaded, &Operation::Compile { prompt, seed }, &[]).map(Arc::new)
}

/// The texture between two, as `asperity blend`; of a recording, its latent.
fn between(
    names: &[String; 2],
    t: f64,
    loaded: &Loaded,
    found: &HashMap<&str, Arc<Texture>>,
) -> Result<Arc<Texture>, ApiError> {
    let end = |name: &String| {
        let texture = found.get(&**name).map(Arc::clone);
        // It has said why it is missing.
        let texture = texture.ok_or_else(|| {
            ApiError::of(&Fault::new(format!("`{name}` failed"), "mend it first"))
        })?;
        if texture.has_latent(loaded) {
            return Ok(texture);
        }
        let encode = Operation::Encode {
            texture: texture.id().to_owned(),
        };
        making::perform(loaded, &encode, &[texture]).map(Arc::new)
    };
    let [a, b] = [end(&names[0])?, end(&names[1])?];
    let blend = Operation::Blend {
        a: a.id().to_owned(),
        b: b.id().to_owned(),
        t,
        draft: false,
    };
    making::perform(loaded, &blend, &[a, b]).map(Arc::new)
}

fn described(
    name: &str,
    anchor: bool,
    anchors: Option<[String; 2]>,
    t: Option<f64>,
    texture: &Texture,
    loaded: &Loaded,
) -> Described {
    let place = |axis: Axis| (axis.name().to_owned(), json!(texture.place(axis, loaded)));
    Described {
        name: name.to_owned(),
        anchor,
        anchors,
        t,
        sha256: sha256(texture.asset()),
        attributes: AXES.into_iter().map(place).collect(),
    }
}

/// SHA-256 of bytes, hexadecimal.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .fold(String::new(), |mut hex, byte| {
            // Writing to a string cannot fail.
            let _ = write!(hex, "{byte:02x}");
            hex
        })
}
