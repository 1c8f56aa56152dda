//! How certain a texture is, from the distance of its prompt to anything trained.

use super::description::CertaintyCurve;
use serde::{Deserialize, Serialize};
use std::{
    fmt::{self, Display, Formatter},
    str::FromStr,
};

/// How well what a prompt says is known; the least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Certainty {
    /// Nothing in it is known, or says how something feels.
    Guess,
    /// It is put together of what is known, or near to it.
    Close,
    /// It has a name that the model knows, with qualities or numbers at most.
    Known,
}

impl Certainty {
    /// The share of comparisons with such prompts that came out as a person rated them, 0..=1
    /// (`docs/words.md`; `compiler/tests/prompts/certainty.rs` measures it).
    #[must_use]
    pub const fn share(self) -> f64 {
        match self {
            Self::Known => 0.97,
            Self::Close => 0.91,
            Self::Guess => 0.77,
        }
    }
}

impl FromStr for Certainty {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let all = [Self::Guess, Self::Close, Self::Known];
        all.into_iter()
            .find(|level| level.to_string() == text)
            .ok_or(())
    }
}

impl Display for Certainty {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Guess => "guess",
            Self::Close => "close",
            Self::Known => "known",
        })
    }
}

/// Certainty, 0..=1, of a prompt of this familiarity. It is piecewise linear, falls to zero below the first knot, and is constant beyond
/// the last.
#[must_use]
pub fn certainty(curve: &CertaintyCurve, familiarity: f64) -> f64 {
    let (x, y) = (&curve.similarity, &curve.certainty);
    let Some(after) = x.iter().position(|&knot| familiarity < knot) else {
        return y.last().copied().unwrap_or(0.0);
    };
    if after == 0 {
        return y[0] * (familiarity / x[0]).clamp(0.0, 1.0);
    }
    let share = (familiarity - x[after - 1]) / (x[after] - x[after - 1]);
    y[after - 1] + share * (y[after] - y[after - 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_linear_between_knots_flat_above_and_falls_to_nothing_below() {
        let curve = CertaintyCurve {
            similarity: vec![0.2, 0.4, 0.6],
            certainty: vec![0.1, 0.5, 0.9],
        };
        for (similarity, expected) in [
            (-1.0, 0.0),
            (0.1, 0.05),
            (0.2, 0.1),
            (0.3, 0.3),
            (0.5, 0.7),
            (0.9, 0.9),
        ] {
            assert!((certainty(&curve, similarity) - expected).abs() < 1e-12);
        }
    }
}
