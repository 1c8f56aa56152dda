//! Where a texture lies in the latent space: as a whole, or each of its parts for itself; and what
//! moves after it was decoded.

use crate::learned::{Latent, description::LATENT};
use asperity_texture::model::shift::Shift;

/// The latents of what is felt in sliding, in tapping and as friction. A prompt gives one for all
/// three.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Latents {
    /// The AR grid.
    pub slide: Latent,
    /// The tap traces and the wall.
    pub tap: Latent,
    /// μ and its anchors.
    pub friction: Latent,
    /// Shift applied after decoding: roughness of the slide, hardness of the tap, slipperiness of the friction.
    pub shift: Shift,
}

impl Latents {
    /// Uses the same latent for all parts.
    #[must_use]
    pub fn whole(z: Latent) -> Self {
        Self {
            slide: z,
            tap: z,
            friction: z,
            shift: Shift::default(),
        }
    }

    /// The same, moved by this shift once it is decoded.
    #[must_use]
    pub fn shifted(self, shift: Shift) -> Self {
        Self { shift, ..self }
    }

    /// The parts of three textures.
    #[must_use]
    pub fn composed(tap: &Self, slide: &Self, friction: &Self) -> Self {
        Self {
            slide: slide.slide,
            tap: tap.tap,
            friction: friction.friction,
            shift: Shift {
                rough_db: slide.shift.rough_db,
                slippery: friction.shift.slippery,
                hard: tap.shift.hard,
            },
        }
    }

    /// The point between two textures, part by part: `(1 − t)·a + t·b`.
    #[must_use]
    pub fn between(a: &Self, b: &Self, t: f64) -> Self {
        // At the ends to the bit, whatever the other one is.
        let mix = |a: &Latent, b: &Latent| -> Latent {
            std::array::from_fn(|k| {
                let (a, b) = (f64::from(a[k]), f64::from(b[k]));
                ((1.0 - t) * a + t * b) as f32
            })
        };
        Self {
            slide: mix(&a.slide, &b.slide),
            tap: mix(&a.tap, &b.tap),
            friction: mix(&a.friction, &b.friction),
            shift: Shift::between(&a.shift, &b.shift, t),
        }
    }

    /// Returns true if all parts share one latent.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.slide == self.tap && self.slide == self.friction
    }

    /// The latents in the order of a file: one, or sliding, tapping and friction; without the
    /// shift, which the history holds.
    #[must_use]
    pub fn parts(&self) -> Vec<Latent> {
        if self.is_whole() {
            vec![self.slide]
        } else {
            vec![self.slide, self.tap, self.friction]
        }
    }

    /// The latents of [`parts`](Self::parts); `None` for another number of them.
    #[must_use]
    pub fn of_parts(parts: &[Latent]) -> Option<Self> {
        match parts {
            [whole] => Some(Self::whole(*whole)),
            [slide, tap, friction] => Some(Self {
                slide: *slide,
                tap: *tap,
                friction: *friction,
                shift: Shift::default(),
            }),
            _ => None,
        }
    }
}

/// A latent as text: eight hexadecimal digits a number, little-endian as in a file.
pub(super) fn to_hex(z: &Latent) -> String {
    use std::fmt::Write as _;
    let mut text = String::with_capacity(8 * LATENT);
    for byte in z.iter().flat_map(|x| x.to_le_bytes()) {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// The latent of [`to_hex`]; `None` for anything else, and for a number that is not finite.
pub(super) fn of_hex(text: &str) -> Option<Latent> {
    if text.len() != 8 * LATENT || !text.is_ascii() {
        return None;
    }
    let mut z = [0.0; LATENT];
    for (k, x) in z.iter_mut().enumerate() {
        let word = u32::from_str_radix(text.get(8 * k..8 * k + 8)?, 16).ok()?;
        *x = f32::from_bits(word.swap_bytes());
        if !x.is_finite() {
            return None;
        }
    }
    Some(z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn latent(first: f32) -> Latent {
        std::array::from_fn(|k| first + k as f32)
    }

    #[test]
    fn a_latent_reads_back_to_the_bit_and_nothing_else_does() {
        let z = latent(-0.1);
        assert_eq!(of_hex(&to_hex(&z)), Some(z));
        assert_eq!(of_hex(""), None);
        assert_eq!(of_hex(&"+".repeat(512)), None);
        assert_eq!(of_hex(&to_hex(&latent(f32::NAN))), None);
    }

    #[test]
    fn a_blend_is_its_ends_at_the_ends_and_linear_between() {
        let a = Latents::whole(latent(0.1));
        let b = Latents {
            tap: latent(3.0),
            ..Latents::whole(latent(0.7)).shifted(Shift {
                hard: 0.4,
                ..Shift::default()
            })
        };
        assert_eq!(Latents::between(&a, &b, 0.0), a);
        assert_eq!(Latents::between(&a, &b, 1.0), b);
        let middle = Latents::between(&a, &b, 0.5);
        assert!((middle.slide[0] - 0.4).abs() < 1e-6 && (middle.tap[0] - 1.55).abs() < 1e-6);
        assert_eq!(middle.shift.hard, 0.2);
        let read = Latents::of_parts(&middle.parts());
        assert_eq!(read.map(|read| read.shifted(middle.shift)), Some(middle));
        assert_eq!(Latents::of_parts(&a.parts()), Some(a));
    }
}
