//! The excitation ε: xoroshiro64** seeded through SplitMix64. Four bytes are summed, and a cubic
//! bends the sum to variance 1 and kurtosis 3.

/// Noise with the second and fourth moment of a Gaussian.
#[derive(Debug, Clone)]
pub struct Excitation {
    state: [u32; 2],
    linear: f64,
    cubic: f64,
}

/// Moments 2, 4, .. 12 about the mean of the sum of four bytes.
fn moments() -> [f64; 6] {
    let mut shares = vec![1.0_f64];
    for _ in 0..4 {
        let mut next = vec![0.0; shares.len() + 255];
        for (sum, share) in shares.iter().enumerate() {
            for place in &mut next[sum..sum + 256] {
                *place += share / 256.0;
            }
        }
        shares = next;
    }
    std::array::from_fn(|i| {
        let power = 2 * (i as i32 + 1);
        let term = |(sum, share): (usize, &f64)| share * (sum as f64 - 510.0).powi(power);
        shares.iter().enumerate().map(term).sum()
    })
}

/// (a, b) for which a·s + b·s³ has variance 1 and fourth moment 3, by Newton's method on
/// the standardised sum.
fn bend() -> (f64, f64) {
    let m = moments();
    let scale = m[0].sqrt();
    let n: Vec<f64> = (0..6)
        .map(|i| m[i] / scale.powi(2 * (i as i32 + 1)))
        .collect();
    let errors = |a: f64, b: f64| {
        let variance = a * a * n[0] + 2.0 * a * b * n[1] + b * b * n[2];
        let fourth = a.powi(4) * n[1]
            + 4.0 * a.powi(3) * b * n[2]
            + 6.0 * a * a * b * b * n[3]
            + 4.0 * a * b.powi(3) * n[4]
            + b.powi(4) * n[5];
        [variance - 1.0, fourth - 3.0]
    };
    let (mut a, mut b) = (1.0, 0.0);
    for _ in 0..50 {
        let h = 1e-6;
        let (e, da, db) = (errors(a, b), errors(a + h, b), errors(a, b + h));
        let j = [
            [(da[0] - e[0]) / h, (db[0] - e[0]) / h],
            [(da[1] - e[1]) / h, (db[1] - e[1]) / h],
        ];
        let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
        a -= (j[1][1] * e[0] - j[0][1] * e[1]) / det;
        b -= (j[0][0] * e[1] - j[1][0] * e[0]) / det;
    }
    (a / scale, b / scale.powi(3))
}

impl Excitation {
    /// The stream of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        let (linear, cubic) = bend();
        Self {
            state: [z as u32, (z >> 32) as u32],
            linear,
            cubic,
        }
    }

    fn bits(&mut self) -> u32 {
        let [s0, s1] = self.state;
        let result = s0.wrapping_mul(0x9e37_79bb).rotate_left(5).wrapping_mul(5);
        let mixed = s0 ^ s1;
        self.state = [
            s0.rotate_left(26) ^ mixed ^ (mixed << 9),
            mixed.rotate_left(13),
        ];
        result
    }

    /// The next sample.
    pub fn draw(&mut self) -> f64 {
        let bytes = self.bits().to_le_bytes().into_iter();
        let s = bytes.map(f64::from).sum::<f64>() - 510.0;
        self.linear * s + self.cubic * s.powi(3)
    }
}
