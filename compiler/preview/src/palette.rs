//! Few colours for a picture: median cut over a histogram, then k-means, in whole numbers.

/// Rounds of k-means. More change hardly a pixel.
const ROUNDS: usize = 3;

/// A picture of at most 256 colours.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Indexed {
    /// Colours, dark ones first.
    pub(crate) palette: Vec<[u8; 3]>,
    /// A colour a pixel.
    pub(crate) pixels: Vec<u8>,
}

/// A colour of the histogram with how many pixels have it.
type Bin = ([u8; 3], u32);

/// The colours of a picture, counted.
#[derive(Debug, Clone)]
pub(crate) struct Histogram {
    bins: Vec<Bin>,
}

impl Histogram {
    pub(crate) fn of(pixels: &[[u8; 3]]) -> Self {
        let mut counts = vec![0u32; BINS];
        for pixel in pixels {
            counts[bin(*pixel)] += 1;
        }
        let counted = counts
            .into_iter()
            .enumerate()
            .filter(|(_, count)| *count > 0);
        Self {
            bins: counted.map(|(bin, count)| (middle(bin), count)).collect(),
        }
    }

    /// The picture in at most `count` colours, 2..=256.
    pub(crate) fn indexed(&self, pixels: &[[u8; 3]], count: usize) -> Indexed {
        let mut palette = cut(self.bins.clone(), count);
        for _ in 0..ROUNDS {
            palette = moved(&self.bins, &palette);
        }
        palette.sort_unstable_by_key(|c| (brightness(*c), *c));
        palette.dedup();
        let mut of_bin = vec![0u8; BINS];
        for (color, _) in &self.bins {
            of_bin[bin(*color)] = nearest(&palette, *color) as u8;
        }
        let pixels = pixels.iter().map(|pixel| of_bin[bin(*pixel)]).collect();
        Indexed { palette, pixels }
    }
}

/// Bins of the histogram: 6 bits a channel, as finer ones change nothing that can be seen.
const BINS: usize = 1 << 18;

fn bin([r, g, b]: [u8; 3]) -> usize {
    usize::from(r >> 2) << 12 | usize::from(g >> 2) << 6 | usize::from(b >> 2)
}

/// The colour in the middle of a bin.
fn middle(bin: usize) -> [u8; 3] {
    [12, 6, 0].map(|shift| ((bin >> shift & 63) << 2 | 2) as u8)
}

fn brightness([r, g, b]: [u8; 3]) -> u32 {
    3 * u32::from(r) + 6 * u32::from(g) + u32::from(b)
}

/// Squared distance, weighted as the eye does.
fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    let d = |k: usize| u32::from(a[k].abs_diff(b[k]));
    2 * d(0) * d(0) + 4 * d(1) * d(1) + d(2) * d(2)
}

fn nearest(palette: &[[u8; 3]], color: [u8; 3]) -> usize {
    let by_distance = |k: &usize| distance(palette[*k], color);
    (0..palette.len()).min_by_key(by_distance).unwrap_or(0)
}

/// The means of boxes that are cut in two, the box that errs most first.
fn cut(bins: Vec<Bin>, count: usize) -> Vec<[u8; 3]> {
    let mut boxes = vec![bins];
    while boxes.len() < count {
        let errors = boxes.iter().map(|bins| error(bins));
        let Some((worst, (channel, error))) = errors
            .enumerate()
            .max_by_key(|(k, e)| (e.1, usize::MAX - k))
        else {
            break;
        };
        if error == 0 {
            break;
        }
        let mut low = boxes.swap_remove(worst);
        low.sort_unstable_by_key(|(color, _)| (color[channel], *color));
        let mean = mean(&low)[channel];
        let at = low
            .partition_point(|(color, _)| color[channel] <= mean)
            .clamp(1, low.len() - 1);
        let high = low.split_off(at);
        boxes.push(low);
        boxes.push(high);
    }
    boxes.iter().map(|bins| mean(bins)).collect()
}

/// The channel of a box that varies most, and its sum of squares.
fn error(bins: &[Bin]) -> (usize, u64) {
    let mean = mean(bins);
    let weights = [2, 4, 1];
    let of = |channel: usize| -> u64 {
        let square = |(color, count): &Bin| {
            let d = u64::from(color[channel].abs_diff(mean[channel]));
            d * d * u64::from(*count)
        };
        weights[channel] * bins.iter().map(square).sum::<u64>()
    };
    let channel = (0..3).max_by_key(|&c| (of(c), 2 - c)).unwrap_or(0);
    if bins.len() < 2 {
        (0, 0)
    } else {
        (channel, of(channel))
    }
}

fn mean(bins: &[Bin]) -> [u8; 3] {
    let total: u64 = bins.iter().map(|(_, count)| u64::from(*count)).sum();
    [0, 1, 2].map(|k| {
        let sum: u64 = bins
            .iter()
            .map(|(c, count)| u64::from(c[k]) * u64::from(*count))
            .sum();
        ((sum + total / 2) / total.max(1)) as u8
    })
}

/// Each colour moved to the mean of what is nearest to it.
fn moved(bins: &[Bin], palette: &[[u8; 3]]) -> Vec<[u8; 3]> {
    let mut members: Vec<Vec<Bin>> = vec![Vec::new(); palette.len()];
    for bin in bins {
        members[nearest(palette, bin.0)].push(*bin);
    }
    let colors = members.iter().zip(palette);
    colors
        .map(|(bins, old)| if bins.is_empty() { *old } else { mean(bins) })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_nearly_as_they_are() {
        let four = [[10, 10, 10], [200, 30, 30], [30, 200, 30], [250, 250, 250]];
        let pixels: Vec<[u8; 3]> = (0..64).map(|k| four[k % 4]).collect();
        let picture = Histogram::of(&pixels).indexed(&pixels, 16);
        assert_eq!(picture.palette.len(), 4);
        for (pixel, index) in pixels.iter().zip(&picture.pixels) {
            let shown = picture.palette[usize::from(*index)];
            assert!(pixel.iter().zip(shown).all(|(a, b)| a.abs_diff(b) <= 2));
        }
    }

    #[test]
    fn more_colours_err_less() {
        let pixels: Vec<[u8; 3]> = (0..4096u32)
            .map(|k| [(k / 16) as u8, (k % 251) as u8, (k * 7 % 256) as u8])
            .collect();
        let error = |count| -> u32 {
            let picture = Histogram::of(&pixels).indexed(&pixels, count);
            assert!(picture.palette.len() <= count);
            let shown = picture
                .pixels
                .iter()
                .map(|&k| picture.palette[usize::from(k)]);
            shown.zip(&pixels).map(|(a, b)| distance(a, *b) / 64).sum()
        };
        assert!(error(64) < error(16) && error(16) < error(4));
    }
}
