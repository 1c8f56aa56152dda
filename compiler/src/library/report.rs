//! Build report.

use super::{facts::Facts, shard::Shard};
use crate::learned::Certainty;
use asperity_io::shown::{counted, size};
use serde::Serialize;
use std::fmt;

/// Report of a build.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Bytes of the library.
    pub bytes: u64,
    /// Textures that were made.
    pub made: usize,
    /// Textures that the cache had.
    pub cached: usize,
    /// Part that was built, as `i/n`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shard: Option<String>,
    /// Textures whose vibration the auto-gain lowered.
    pub lowered: usize,
    /// The textures in order of name.
    pub textures: Vec<TextureReport>,
}

/// Report of a texture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TextureReport {
    /// Its name.
    pub name: String,
    /// `prompt`, `import`, `asset`, `blend` or `compose`.
    pub source: &'static str,
    /// Its key in the cache.
    pub key: String,
    /// True if it was taken from the cache.
    pub cached: bool,
    /// Bytes of the asset.
    pub bytes: usize,
    /// Its figures.
    #[serde(flatten)]
    pub facts: Facts,
}

impl Report {
    pub(super) fn new(textures: Vec<TextureReport>, bytes: u64, shard: Option<Shard>) -> Self {
        let cached = textures.iter().filter(|row| row.cached).count();
        let lowered = textures
            .iter()
            .filter(|row| row.facts.vibration_factor < 1.0);
        Self {
            bytes,
            made: textures.len() - cached,
            cached,
            shard: shard.map(|shard| shard.to_string()),
            lowered: lowered.count(),
            textures,
        }
    }
}

/// Summary in a line.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = counted(self.textures.len(), "texture", "textures");
        write!(f, "{count}")?;
        if let Some(shard) = &self.shard {
            write!(f, " in shard {shard}")?;
        }
        write!(
            f,
            ", {} compiled, {} from the cache, {}",
            self.made,
            self.cached,
            size(self.bytes)
        )?;
        if self.lowered > 0 {
            write!(f, "; auto-gain lowered the vibration of {}", self.lowered)?;
        }
        let guess = |row: &&TextureReport| {
            row.facts
                .certainty_level
                .is_some_and(|level| level <= Certainty::Guess)
        };
        match self.textures.iter().filter(guess).count() {
            0 => {}
            1 => write!(f, "; 1 is a guess")?,
            guesses => write!(f, "; {guesses} are guesses")?,
        }
        writeln!(f)
    }
}
