//! The latent of a recording, or of a part of one.

use super::latent_editor::LatentEditor;
use crate::{
    edit_memory::Latents,
    learned::{Present, complete},
    passes::reduce::Reference,
};
use asperity_io::diagnostic::Fault;
use asperity_texture::model::TextureModel;
use std::str::FromStr;

/// Part of a texture that the encoder is given; the rest is decoded from the latent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Models and taps.
    Whole,
    /// The taps alone.
    Taps,
    /// The models alone.
    Slide,
}

impl Part {
    /// The name that options and histories use.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::Taps => "taps",
            Self::Slide => "slide",
        }
    }

    /// Returns the recorded part of a texture: synthesised taps carry no information about it.
    #[must_use]
    pub fn recorded(texture: &TextureModel) -> Self {
        if texture.provenance.taps_synthetic || texture.taps.traces.is_empty() {
            Self::Slide
        } else {
            Self::Whole
        }
    }
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        [Self::Whole, Self::Taps, Self::Slide]
            .into_iter()
            .find(|part| part.name() == text)
            .ok_or_else(|| "`whole`, `taps` or `slide`".into())
    }
}

/// A recording in the latent space.
#[derive(Debug, Clone, PartialEq)]
pub struct Encoded {
    /// Its latent, the same for all parts.
    pub latents: Latents,
    /// RMS distance of the decoded spectra from the recorded ones, at 95 % of the places of the
    /// recorded grid and at the worst, dB, of the places where both sound; `None` at different rates,
    /// without such a place, or where no model was given.
    pub distance_db: Option<(f64, f64)>,
    /// Places where one of the two is silent and the other is not.
    pub silent_places: usize,
}

/// The latent of a texture.
///
/// # Errors
/// [`Fault`] for a part that the texture does not have, or when a network fails.
pub fn encode(
    editor: &LatentEditor<'_>,
    texture: &TextureModel,
    part: Part,
) -> Result<Encoded, Fault> {
    let model = editor.prompt_compiler().model();
    let description = model.description();
    let missing = |part: &str| {
        let what = format!("{:?} has no {part} to encode", texture.name);
        let remedy = "encode the part that it has: --part taps or --part slide";
        Fault::new(what, remedy)
    };
    let sounds = texture
        .grid
        .vertices
        .iter()
        .any(|v| v.gain * v.sigma_m_s2 > 0.0);
    if part != Part::Taps && !sounds {
        return Err(missing("slide"));
    }
    if part != Part::Slide && texture.taps.traces.is_empty() {
        return Err(missing("taps"));
    }
    let channels = || complete::ar_channels(&description.grid, &texture.grid);
    let traces = || complete::tap_channels(&description.taps, &texture.taps);
    let z = match part {
        Part::Whole => model.encode(Present::Both(&channels(), &traces())),
        Part::Taps => model.encode(Present::Taps(&traces())),
        Part::Slide => model.encode(Present::Ar(&channels())),
    }?;
    let latents = Latents::whole(z);
    let same_rate = texture.grid.sample_rate_hz == description.grid.sample_rate_hz;
    let (mut distance_db, mut silent_places) = (None, 0);
    if part != Part::Taps && same_rate {
        let decoded = editor.texture(&latents)?;
        let whole = Reference::new(&texture.grid);
        let distances = whole.and_then(|whole| whole.distances(&decoded.grid));
        let (sounding, silent) = distances.unwrap_or_default().sounding();
        distance_db = sounding.map(|distances| distances.summary());
        silent_places = silent;
    }
    Ok(Encoded {
        latents,
        distance_db,
        silent_places,
    })
}
