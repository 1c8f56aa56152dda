//! Appearance of a pattern: its colours, size and depth.

use crate::color::Rgb;

/// Everything a pattern needs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Appearance {
    /// Colours of the pattern's parts; the last one stands for those that are left out.
    pub(crate) colors: Vec<Rgb>,
    /// Features across the patch; the pattern's own number if `None`.
    pub(crate) cells: Option<f32>,
    /// Share of the pattern's own number of features, from the spectrum.
    pub(crate) fineness: f32,
    /// Share of the pattern's own depth, from the level.
    pub(crate) relief: f32,
    /// Gloss of the material; the pattern's own if `None`.
    pub(crate) gloss: Option<f32>,
    /// Added gloss, from friction and words.
    pub(crate) slick: f32,
    /// Cells a patch and strength, of the fine grain that the spectrum adds to any material.
    pub(crate) grain: (i32, f32),
    pub(crate) seed: u32,
}

impl Appearance {
    /// The colour of a part.
    pub(crate) fn color(&self, part: usize) -> Rgb {
        let last = self.colors.len().saturating_sub(1);
        self.colors.get(part.min(last)).copied().unwrap_or([0.5; 3])
    }

    /// Picks a random colour; `chance` is in 0..1.
    pub(crate) fn any(&self, chance: f32) -> Rgb {
        self.color((chance * self.colors.len() as f32) as usize)
    }

    /// Features a patch, where the pattern has `usual` ones.
    pub(crate) fn count(&self, usual: f32) -> i32 {
        let wanted = self.cells.unwrap_or(usual) * self.fineness;
        ((wanted + 0.5) as i32).clamp(1, 200)
    }

    /// As [`Appearance::count`], an even number.
    pub(crate) fn even(&self, usual: f32) -> i32 {
        self.multiple(usual, 2)
    }

    /// As [`Appearance::count`], a multiple of `of`.
    pub(crate) fn multiple(&self, usual: f32, of: i32) -> i32 {
        ((self.count(usual) + of / 2) / of).max(1) * of
    }

    /// Gloss, where the pattern has this one.
    pub(crate) fn shine(&self, usual: f32) -> f32 {
        (self.gloss.unwrap_or(usual) + self.slick).clamp(0.0, 1.0)
    }
}
