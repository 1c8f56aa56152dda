//! Cost budget of a scene, and the choice of each texture's fidelity.

use super::{fidelity::Candidate, target::Target};

/// Share of a target's clocks that a tick may take unless told otherwise.
pub const DEFAULT_SHARE: f64 = 0.5;

/// Cost budget of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// Where the scene runs. Without a target, instructions are counted and not limited.
    pub target: Option<Target>,
    /// Share of the target's clocks that a tick may take, above 0 and at most 1.
    pub share: f64,
    /// Bytes of the library.
    pub bytes: Option<u64>,
}

impl Budget {
    /// Returns true if it limits nothing.
    #[must_use]
    pub fn is_unlimited(&self) -> bool {
        self.target.is_none() && self.bytes.is_none()
    }
}

impl Default for Budget {
    fn default() -> Self {
        Self {
            target: None,
            share: DEFAULT_SHARE,
            bytes: None,
        }
    }
}

/// The budget in numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Limits {
    /// Executed instructions of a tick. They limit every texture by itself, because one is rendered at
    /// a time.
    pub(super) instructions: u64,
    /// Bytes of all assets.
    pub(super) bytes: u64,
}

/// Why no choice keeps within the limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Excess {
    /// A texture takes more instructions at every fidelity.
    Instructions {
        /// Index of the texture.
        texture: usize,
        /// The fewest it can take.
        least: u64,
    },
    /// All textures take more bytes.
    Bytes {
        /// The fewest they can take.
        least: u64,
    },
}

/// Chooses a candidate for each texture: first the best one within the instructions. Then fidelity
/// is lowered where it costs the least error per byte, until all fit the bytes.
pub(super) fn choose(textures: &[Vec<Candidate>], limits: Limits) -> Result<Vec<usize>, Excess> {
    let fits = |c: &Candidate| c.instructions <= limits.instructions;
    let mut chosen = Vec::with_capacity(textures.len());
    for (texture, candidates) in textures.iter().enumerate() {
        let best = candidates.iter().position(fits);
        chosen.push(best.ok_or_else(|| Excess::Instructions {
            texture,
            least: fewest(candidates, |c| c.instructions),
        })?);
    }
    let bytes = |chosen: &[usize]| -> u64 {
        let pairs = textures.iter().zip(chosen);
        pairs.map(|(of, &at)| of[at].bytes.len() as u64).sum()
    };
    while bytes(&chosen) > limits.bytes {
        let steps = textures.iter().enumerate().flat_map(|(texture, of)| {
            let now = &of[chosen[texture]];
            of.iter().enumerate().filter_map(move |(at, c)| {
                let saved = now.bytes.len().checked_sub(c.bytes.len())?;
                let price = (c.error_db - now.error_db) / saved as f64;
                (saved > 0 && fits(c)).then_some((price, texture, at))
            })
        });
        let (_, texture, at) =
            steps
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .ok_or_else(|| Excess::Bytes {
                    least: bytes(&chosen),
                })?;
        chosen[texture] = at;
    }
    Ok(chosen)
}

fn fewest(candidates: &[Candidate], of: impl Fn(&Candidate) -> u64) -> u64 {
    candidates.iter().map(of).min().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;

    fn texture(figures: &[(u64, usize, f64)]) -> Vec<Candidate> {
        figures
            .iter()
            .map(|&(instructions, bytes, error_db)| Candidate {
                fidelity: String::new(),
                texture: builtin::texture(),
                bytes: vec![0; bytes],
                instructions,
                error_db,
            })
            .collect()
    }

    fn limits(instructions: u64, bytes: u64) -> Limits {
        Limits {
            instructions,
            bytes,
        }
    }

    #[test]
    fn the_cheapest_error_per_byte_goes_first() {
        let smooth = texture(&[(9, 100, 0.0), (8, 80, 0.1), (7, 40, 0.8)]);
        let sharp = texture(&[(9, 100, 0.0), (8, 90, 0.5), (7, 50, 4.0)]);
        let both = [smooth, sharp];
        for (bytes, expected) in [
            (200, [0, 0]),
            (199, [1, 0]),
            (180, [1, 0]),
            (179, [2, 0]),
            (139, [2, 1]),
            (90, [2, 2]),
        ] {
            assert_eq!(
                choose(&both, limits(9, bytes)),
                Ok(expected.to_vec()),
                "{bytes}"
            );
        }
        assert_eq!(
            choose(&both, limits(9, 89)),
            Err(Excess::Bytes { least: 90 })
        );
        assert_eq!(choose(&both, limits(8, 999)), Ok(vec![1, 1]));
        assert_eq!(
            choose(&both, limits(6, 999)),
            Err(Excess::Instructions {
                texture: 0,
                least: 7
            })
        );
    }
}
