//! Noise for tests, from a seed: Knuth's congruential generator.

/// Uniform in −0.5..0.5.
pub(crate) struct Uniform(pub(crate) u64);

impl Uniform {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    }
}

/// White noise, a sample the sum of so many uniform ones: of twelve, it is Gaussian enough.
pub(crate) fn white(seed: u64, count: usize, terms: usize) -> Vec<f64> {
    let mut uniform = Uniform(seed);
    (0..count)
        .map(|_| (0..terms).map(|_| uniform.next()).sum())
        .collect()
}
