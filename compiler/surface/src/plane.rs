//! The Fourier transform of a rectangle of real numbers.

use realfft::RealFftPlanner;
use rustfft::{FftDirection, FftPlanner, num_complex::Complex};

/// Half of the transform; the other half is its complex conjugate.
#[derive(Clone)]
pub(crate) struct Plane {
    width: usize,
    height: usize,
    /// Rows of `width / 2 + 1` waves, of y from 0 up and then from the most negative.
    waves: Vec<Complex<f64>>,
}

impl Plane {
    /// The transform of rows of `width` numbers.
    pub(crate) fn of(width: usize, numbers: &mut [f64]) -> Self {
        let height = numbers.len() / width;
        let columns = width / 2 + 1;
        let mut plane = Self {
            width,
            height,
            waves: vec![Complex::default(); columns * height],
        };
        let forward = RealFftPlanner::new().plan_fft_forward(width);
        let mut scratch = forward.make_scratch_vec();
        let rows = numbers.chunks_exact_mut(width);
        for (row, out) in rows.zip(plane.waves.chunks_exact_mut(columns)) {
            // It fails for lengths that are not those of the plan.
            let _ = forward.process_with_scratch(row, out, &mut scratch);
        }
        plane.columns(FftDirection::Forward);
        plane
    }

    fn columns(&mut self, direction: FftDirection) {
        let columns = self.width / 2 + 1;
        let transform = FftPlanner::new().plan_fft(self.height, direction);
        let mut scratch = vec![Complex::default(); transform.get_inplace_scratch_len()];
        let mut column = vec![Complex::default(); self.height];
        for x in 0..columns {
            for (y, slot) in column.iter_mut().enumerate() {
                *slot = self.waves[y * columns + x];
            }
            transform.process_with_scratch(&mut column, &mut scratch);
            for (y, wave) in column.iter().enumerate() {
                self.waves[y * columns + x] = *wave;
            }
        }
    }

    /// Every wave with its numbers of periods in x and, down the rows, in y, and 1 or 2 for one that stands for both halves.
    pub(crate) fn waves_mut(
        &mut self,
    ) -> impl Iterator<Item = ([f64; 2], f64, &mut Complex<f64>)> + '_ {
        let (width, height) = (self.width, self.height);
        let rows = self.waves.chunks_exact_mut(width / 2 + 1).enumerate();
        rows.flat_map(move |(y, row)| {
            let y = if 2 * y > height {
                y as f64 - height as f64
            } else {
                y as f64
            };
            row.iter_mut().enumerate().map(move |(x, wave)| {
                let halves = if x == 0 || 2 * x == width { 1.0 } else { 2.0 };
                ([x as f64, y], halves, wave)
            })
        })
    }

    /// The numbers of this transform.
    pub(crate) fn inverse(mut self) -> Vec<f64> {
        self.columns(FftDirection::Inverse);
        let columns = self.width / 2 + 1;
        let inverse = RealFftPlanner::new().plan_fft_inverse(self.width);
        let mut scratch = inverse.make_scratch_vec();
        let mut numbers = vec![0.0; self.width * self.height];
        let rows = numbers.chunks_exact_mut(self.width);
        for (row, waves) in rows.zip(self.waves.chunks_exact_mut(columns)) {
            // What stands for both halves alone is real.
            waves[0].im = 0.0;
            if self.width.is_multiple_of(2) {
                waves[columns - 1].im = 0.0;
            }
            let _ = inverse.process_with_scratch(waves, row, &mut scratch);
        }
        let scale = 1.0 / (self.width * self.height) as f64;
        for number in &mut numbers {
            *number *= scale;
        }
        numbers
    }
}
