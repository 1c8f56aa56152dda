//! A picture, and the same picture at another size.

/// A square picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width and height, pixels.
    pub size: usize,
    /// sRGB pixels, row by row.
    pub pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// The picture at another size, by a triangle as wide as a pixel of the coarser of the two.
    /// One that repeats does so at the new size: what lies beyond a border is then its other side.
    #[must_use]
    pub fn resized(&self, size: usize, repeats: bool) -> Self {
        if size == self.size || self.size == 0 {
            return self.clone();
        }
        let taps = taps(self.size, size, repeats);
        let rows: Vec<[f32; 3]> = self
            .pixels
            .chunks_exact(self.size)
            .flat_map(|row| {
                taps.iter()
                    .map(|taps| mixed(taps, |at| row[at].map(f32::from)))
            })
            .collect();
        let byte = |x: f32| x.round().clamp(0.0, 255.0) as u8;
        let pixels = taps.iter().flat_map(|taps| {
            let rows = &rows;
            (0..size).map(move |x| mixed(taps, |at| rows[at * size + x]).map(byte))
        });
        Self {
            size,
            pixels: pixels.collect(),
        }
    }
}

/// Pixels of the source with their weights, which add up to 1.
type Taps = Vec<(usize, f32)>;

/// The taps of each pixel of a resampled line.
fn taps(from: usize, to: usize, repeats: bool) -> Vec<Taps> {
    let scale = from as f32 / to as f32;
    let reach = scale.max(1.0);
    let one = |pixel: usize| -> Taps {
        let center = (pixel as f32 + 0.5) * scale - 0.5;
        let first = (center - reach).ceil() as i64;
        let last = (center + reach).floor() as i64;
        let weight = |at: i64| 1.0 - (at as f32 - center).abs() / reach;
        let total: f32 = (first..=last).map(weight).sum();
        let size = from as i64;
        let place = |at: i64| match repeats {
            true => at.rem_euclid(size),
            false => at.clamp(0, size - 1),
        };
        (first..=last)
            .map(|at| (place(at) as usize, weight(at) / total))
            .collect()
    };
    (0..to).map(one).collect()
}

fn mixed(taps: &Taps, pixel: impl Fn(usize) -> [f32; 3]) -> [f32; 3] {
    taps.iter().fold([0.0; 3], |sum, &(at, weight)| {
        let pixel = pixel(at);
        [0, 1, 2].map(|c| sum[c] + weight * pixel[c])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stripes(size: usize) -> Picture {
        let pixels = (0..size * size).map(|at| match at % size < size / 2 {
            true => [200, 100, 0],
            false => [0, 100, 200],
        });
        Picture {
            size,
            pixels: pixels.collect(),
        }
    }

    #[test]
    fn a_plain_picture_stays_as_it_is_and_means_are_kept() {
        let plain = Picture {
            size: 8,
            pixels: vec![[1, 128, 255]; 64],
        };
        for size in [3, 8, 21] {
            let resized = plain.resized(size, true);
            assert_eq!(resized.pixels, vec![[1, 128, 255]; size * size]);
        }
        let mean = |p: &Picture| {
            p.pixels.iter().map(|p| f64::from(p[0])).sum::<f64>() / p.pixels.len() as f64
        };
        let resized = stripes(64).resized(16, true);
        assert!((mean(&resized) - 100.0).abs() < 1.0);
    }

    /// Claim: at the border of a picture that repeats, its other side is mixed in.
    #[test]
    fn what_repeats_goes_on_at_its_border() {
        let left = |repeats| stripes(64).resized(16, repeats).pixels[0];
        assert_eq!(left(false), [200, 100, 0]);
        assert!(left(true)[0] < 200 && left(true)[2] > 0);
    }
}
