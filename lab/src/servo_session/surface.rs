//! The touched surface: a texture, or a scene of several.

use super::error::ServoSessionError;
use crate::compensation;
use asperity::emit::textures::Textures;
use asperity_formats::{Asset, FormatError, Library};
use asperity_host::profile::Compensation;
use asperity_host::servo::RATES_HZ;
use asperity_io::shown::counted;
use std::path::Path;

/// The touched surface, as checked bytes.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Where it came from.
    pub origin: String,
    /// Name of the texture; of a scene, how many surfaces it has.
    pub name: String,
    /// The bytes of an asset, or of a library with a scene.
    pub bytes: Vec<u8>,
    /// True for a scene.
    pub is_scene: bool,
    /// Rate of the models, Hz.
    pub models_hz: f32,
}

impl Surface {
    /// The built-in texture.
    ///
    /// # Errors
    /// None: a test of the compiler makes it as well.
    pub fn built_in() -> Result<Self, ServoSessionError> {
        let lowered = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None);
        let lowered = lowered.map_err(|error| ServoSessionError::BuiltIn(error.to_string()))?;
        Self::of_texture(lowered.bytes, "built in".into())
    }

    /// Reads an asset, one texture of a library, or a library with a scene, which is touched as a
    /// whole unless a texture is named.
    ///
    /// # Errors
    /// [`ServoSessionError::Source`] or [`ServoSessionError::Format`].
    pub fn read(path: &Path, texture: Option<&str>) -> Result<Self, ServoSessionError> {
        let mut textures = Textures::open(path)?;
        let origin = textures.shown();
        if texture.is_none()
            && let Some(library) = textures.scene_library()?
        {
            return Self::of_scene(library, origin);
        }
        let bytes = textures.choose(texture)?;
        Self::of_texture(bytes, origin)
    }

    /// The same in a device's own voice: its textures went through the filter of a profile.
    ///
    /// # Errors
    /// [`ServoSessionError::Voice`].
    pub fn compensated(self, filter: &Compensation) -> Result<Self, ServoSessionError> {
        let bytes = if self.is_scene {
            compensation::scene(&self.bytes, filter)
        } else {
            compensation::asset(&self.bytes, filter)
        };
        match bytes {
            Ok(bytes) => Ok(Self { bytes, ..self }),
            Err(cause) => Err(ServoSessionError::Voice {
                origin: self.origin,
                cause,
            }),
        }
    }

    /// The bytes of an asset, from `origin`.
    ///
    /// # Errors
    /// [`ServoSessionError::Format`].
    pub fn of_texture(bytes: Vec<u8>, origin: String) -> Result<Self, ServoSessionError> {
        match Asset::parse(&bytes) {
            Ok(asset) => Ok(Self {
                name: asset.name().to_owned(),
                models_hz: asset.grid().sample_rate_hz(),
                is_scene: false,
                origin,
                bytes,
            }),
            Err(cause) => Err(ServoSessionError::Format { origin, cause }),
        }
    }

    fn of_scene(bytes: Vec<u8>, origin: String) -> Result<Self, ServoSessionError> {
        let facts = || -> Result<_, FormatError> {
            let library = Library::parse(&bytes)?;
            let surfaces = library.scene().map_or(0, |scene| scene.surfaces().len());
            let models_hz = library.asset(0)?.grid().sample_rate_hz();
            Ok((
                format!("a scene of {}", counted(surfaces, "surface", "surfaces")),
                models_hz,
            ))
        };
        match facts() {
            Ok((name, models_hz)) => Ok(Self {
                origin,
                name,
                bytes,
                is_scene: true,
                models_hz,
            }),
            Err(cause) => Err(ServoSessionError::Format { origin, cause }),
        }
    }

    /// The rate at which to run it unless the user says another: that of its models, or the least
    /// multiple that a servo loop takes.
    #[must_use]
    pub fn rate_hz(&self) -> u32 {
        let models_hz = self.models_hz.max(1.0);
        let least = *RATES_HZ.start() as f32;
        (models_hz * (least / models_hz).ceil().max(1.0)).round() as u32
    }
}
