//! Rendering a recording anew, and comparing every bit of force.

use asperity_formats::Asset;
use asperity_runtime::{
    ConfigError, Exchange, HostTexture, LoadError, PrepareError, Renderer, Sample,
};
use thiserror::Error;

use super::{SessionLog, TextureInfo};

/// The first tick whose force differs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// Index of the entry.
    pub entry: usize,
    /// Recorded force, N.
    pub recorded_n: [f32; 3],
    /// Force as rendered again, N.
    pub rendered_n: [f32; 3],
}

/// Comparison of a recording with its new rendering.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Comparison {
    /// Ticks that were compared: all up to the first that was lost.
    pub compared: u64,
    /// Ticks whose force differs in a bit.
    pub different: u64,
    /// The first of them.
    pub first: Option<Difference>,
    /// Ticks that could not be compared, since ticks before them were lost.
    pub not_compared: u64,
}

impl Comparison {
    /// Returns true if every tick of the recording was compared and none differs.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.different == 0 && self.not_compared == 0
    }
}

/// Why a recording cannot be rendered again.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderAgainError {
    /// It is of no single texture.
    #[error("the recording is of no single texture")]
    NoTexture,
    /// The bytes of a texture are not at hand.
    #[error("no file has the bytes of texture \"{}\" ({} bytes, CRC-32 {:08x})", .0.name, .0.bytes, .0.crc32)]
    Missing(TextureInfo),
    /// A texture that is none.
    #[error("texture \"{name}\": {why}")]
    Asset {
        /// Its name.
        name: String,
        /// Reason.
        why: String,
    },
    /// A texture began that was never announced.
    #[error("entry {entry} begins a texture that the recording does not name")]
    Unannounced {
        /// Index of the entry.
        entry: usize,
    },
    /// The conditions hold an impossible configuration.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The slot refused a texture.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// No slot for the next texture.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
}

/// Compares a recording with what `tick` answers to its samples. `tick` gets each entry's number
/// and sample.
///
/// # Errors
/// What `tick` says.
pub fn render_again_with<E>(
    recording: &SessionLog,
    mut tick: impl FnMut(usize, &Sample) -> Result<[f32; 3], E>,
) -> Result<Comparison, E> {
    let entries = &recording.entries;
    let whole = entries
        .iter()
        .take_while(|entry| entry.lost_before == 0)
        .count();
    let mut comparison = Comparison {
        compared: whole as u64,
        not_compared: (entries.len() - whole) as u64,
        ..Comparison::default()
    };
    for (n, entry) in entries[..whole].iter().enumerate() {
        let rendered_n = tick(n, &entry.sample)?;
        if rendered_n.map(f32::to_bits) != entry.force_n.map(f32::to_bits) {
            comparison.different += 1;
            comparison.first = comparison.first.or(Some(Difference {
                entry: n,
                recorded_n: entry.force_n,
                rendered_n,
            }));
        }
    }
    Ok(comparison)
}

/// Renders a recording of a texture, or of textures one after the other, and compares. `asset`
/// gives the bytes of a texture, which are checked.
///
/// # Errors
/// [`RenderAgainError`].
pub fn render_again(
    recording: &SessionLog,
    mut asset: impl FnMut(&TextureInfo) -> Option<Vec<u8>>,
) -> Result<Comparison, RenderAgainError> {
    let mut bytes_of = |texture: &TextureInfo| {
        let bytes = asset(texture).filter(|bytes| texture.is(bytes));
        bytes.ok_or_else(|| RenderAgainError::Missing(texture.clone()))
    };
    let conditions = &recording.conditions;
    let first = conditions
        .texture
        .as_ref()
        .ok_or(RenderAgainError::NoTexture)?;
    let renderer = Renderer::new(&conditions.config)?;
    let rate_hz = conditions.config.servo_rate_hz;
    let mut slots = [(); 3].map(|()| Box::new(HostTexture::new()));
    let [playing, one, other] = &mut slots;
    let bytes = bytes_of(first)?;
    playing.load(&parse(first, &bytes)?, rate_hz)?;
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(playing, [one, other], conditions.seed);
    let mut later = recording.textures.iter();
    render_again_with(recording, |n, sample| {
        if recording.entries[n].next_texture {
            let texture = later
                .next()
                .ok_or(RenderAgainError::Unannounced { entry: n })?;
            let bytes = bytes_of(texture)?;
            preparer.prepare(&parse(texture, &bytes)?, rate_hz)?;
        }
        Ok(renderer.tick_player(&mut player, sample).force_n)
    })
}

fn parse<'a>(texture: &TextureInfo, bytes: &'a [u8]) -> Result<Asset<'a>, RenderAgainError> {
    Asset::parse(bytes).map_err(|error| RenderAgainError::Asset {
        name: texture.name.clone(),
        why: error.to_string(),
    })
}
