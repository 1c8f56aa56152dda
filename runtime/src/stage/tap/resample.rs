//! Tap traces from their source rate to the servo rate, once, at load.
//!
//! Every source sample is an impulse of a·T_source into a continuous-time low-pass, whose output is
//! sampled at the servo period. The low-pass is a Chebyshev type II of order 7. From half the lower
//! of the two rates upwards it is 50 dB down, and aliases stay more than 40 dB down, the images of
//! the source's own rate included. At 0.69 of that frequency it is 3 dB down. Its delay is 1.51 ms
//! at 1 kHz. It is causal, so nothing precedes the impact. The part of ∫a dt that truncation and
//! the stop band take away is added along the filter's own response, so the impulse is exact within
//! rounding.

mod poles;

pub(crate) use self::poles::Lanes;
use self::poles::Poles;
use crate::{
    arithmetic::Scalar,
    complex::Complex4,
    lanes::{F4, GRID, settled},
    math::{cos_pi_four, exp, max},
};
use asperity_formats::{limits::MAX_TAPS, taps::BLOCK};
use core::array;

/// Poles with Im ≥ 0 (rad per rad/s of stop edge) and residues of the prototype with unit gain at
/// DC: `scipy.signal.cheb2ap(7, 50)`, `scipy.signal.residue`. The residue of a pole with Im > 0 is
/// doubled, because it stands for its conjugate, too.
const POLES: Complex4 = Complex4 {
    re: F4::load(&[-0.113_746_65, -0.381_229_6, -0.729_280_8, -0.945_731_9]),
    im: F4::load(&[0.685_925_7, 0.657_971_74, 0.483_387_32, 0.0]),
};
const RESIDUES: Complex4 = Complex4 {
    re: F4::load(&[0.253_072_32, -1.052_228_3, -1.939_127_3, 2.760_419_4]),
    im: F4::load(&[0.221_903_02, 1.076_703_5, -3.329_852, 0.0]),
};

/// Ticks after the last source sample, in which the filter's response fades below 1 % of its peak.
pub(crate) const TAIL_TICKS: usize = 16;

/// Source samples that are filtered at once: a tick at 1 kHz has ten of them at 10 kHz.
const CHUNK: usize = 10;

/// Ticks of the filter's response that are computed at once. 100 samples at 10 kHz become 26 ticks
/// at 1 kHz.
const RESPONSES: usize = 32;

/// A sample this close to a tick belongs to it, s.
const ROUNDING_S: f64 = 1e-9;

/// e to this is below the grid of the smallest numbers in use.
const NEXT_TO_NOTHING: f32 = -44.0;

/// e^(pole·x) for x ≥ 0. Im·x exceeds 2π only where the result is next to nothing.
fn decay(x: f32) -> Complex4 {
    let size = POLES
        .re
        .to_array()
        .map(|re| exp(max(re * x, NEXT_TO_NOTHING)));
    let half_turns = POLES.im * F4::splat(x) * F4::splat(core::f32::consts::FRAC_1_PI);
    let half_turns = half_turns.min(F4::splat(2.0));
    // The second half of a turn mirrors the first, and sines are cosines a quarter later.
    let mirrored = half_turns.min(F4::splat(2.0) - half_turns);
    let quarter = (mirrored - F4::HALF).max(F4::HALF - mirrored);
    let sign = half_turns
        .to_array()
        .map(|h| if h > 1.0 { -1.0 } else { 1.0 });
    Complex4 {
        re: cos_pi_four(mirrored) * F4::load(&size),
        im: cos_pi_four(quarter) * F4::load(&size) * F4::load(&sign),
    }
    .settled()
}

/// The rates of a conversion, Hz.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rates {
    source_hz: f64,
    servo_hz: f64,
}

impl Rates {
    pub(crate) fn new(source_hz: f32, servo_hz: f32) -> Self {
        Self {
            source_hz: f64::from(source_hz),
            servo_hz: f64::from(servo_hz),
        }
    }

    fn is_identity(&self) -> bool {
        self.source_hz == self.servo_hz
    }

    /// Ticks that `samples` source samples become.
    pub(crate) fn ticks(&self, samples: usize) -> usize {
        if self.is_identity() || samples == 0 {
            return samples;
        }
        let span = (samples - 1) as f64 * self.servo_hz / self.source_hz;
        // The tail is counted in periods of the lower rate.
        let stretch = if self.source_hz < self.servo_hz {
            self.servo_hz / self.source_hz
        } else {
            1.0
        };
        (span + TAIL_TICKS as f64 * stretch) as usize + 1
    }
}

/// Samples of `N` traces: one row a sample, one column a trace.
pub(crate) type Rows<const N: usize> = [[f32; N]; BLOCK];

/// A conversion of traces of one length.
#[derive(Debug, Clone)]
pub(crate) struct Resampler {
    rates: Rates,
    samples: usize,
    stop_rad_s: f32,
    /// The decay of a state over [`CHUNK`] source samples, over one less, …, over none.
    powers: [Complex4; CHUNK + 1],
    /// The decay of a state over a tick.
    tick: Complex4,
}

impl Resampler {
    pub(crate) fn new(rates: Rates, samples: usize) -> Self {
        let lower_hz = if rates.source_hz < rates.servo_hz {
            rates.source_hz
        } else {
            rates.servo_hz
        };
        let stop_rad_s = core::f32::consts::PI * lower_hz as f32;
        let after = |s: f64| decay(s as f32 * stop_rad_s);
        Self {
            rates,
            samples,
            stop_rad_s,
            powers: array::from_fn(|k| after((CHUNK - k) as f64 / rates.source_hz)),
            tick: after(1.0 / rates.servo_hz),
        }
    }

    /// Ticks that a trace becomes.
    pub(crate) fn ticks(&self) -> usize {
        self.rates.ticks(self.samples)
    }

    /// Converts traces side by side into `out`, [`Resampler::ticks`] each, one after the other.
    /// `read` gives a block of their samples from an even index on. Returns the part of each
    /// trace's sum that is missing, in ticks, for [`Resampler::complete`].
    pub(crate) fn convert<S: Scalar, L: Lanes<N>, const N: usize>(
        &self,
        read: impl Fn(usize, &mut Rows<N>),
        out: &mut [S],
    ) -> [f32; N] {
        if self.rates.is_identity() {
            self.copy(read, out);
            [0.0; N]
        } else {
            self.filter::<S, L, N>(read, out)
        }
    }

    #[inline(never)]
    fn copy<S: Scalar, const N: usize>(&self, read: impl Fn(usize, &mut Rows<N>), out: &mut [S]) {
        let mut block = [[0.0; N]; BLOCK];
        for first in (0..self.samples).step_by(BLOCK) {
            read(first, &mut block);
            for (n, &row) in (first..self.samples).zip(&block) {
                put(out, self.samples, n, row.map(|a| S::of(settled(a, GRID))));
            }
        }
    }

    /// y(nT) = Σ_i T_source·x_i·h(nT − iT_source), by one complex state a pole, which moves by up
    /// to [`CHUNK`] source samples at once.
    #[inline(never)]
    fn filter<S: Scalar, L: Lanes<N>, const N: usize>(
        &self,
        read: impl Fn(usize, &mut Rows<N>),
        out: &mut [S],
    ) -> [f32; N] {
        let Rates {
            source_hz,
            servo_hz,
        } = self.rates;
        let (tick_s, source_s) = (1.0 / servo_hz, 1.0 / source_hz);
        let ticks = self.ticks();
        let mut given = Given {
            gain: self.stop_rad_s * source_s as f32,
            ticks,
            sums: [0.0; N],
        };
        let mut sums = [0.0; N];
        let (mut first, mut end, mut block) = (0, 0, [[0.0; N]; BLOCK]);
        let (mut states, mut taken) = (Poles::<L, N>::zero(), 0);
        let mut n = 0;
        while n < ticks && taken < self.samples {
            let now_s = n as f64 * tick_s;
            let due = ((now_s + ROUNDING_S) * source_hz) as usize + 1;
            while taken < due {
                let count = (due - taken).min(CHUNK);
                if taken + count > end {
                    first = taken - taken % 2;
                    end = first + BLOCK;
                    read(first, &mut block);
                }
                let samples = block.get(taken - first..).unwrap_or_default();
                self.enter(&mut states, &mut sums, samples, count);
                taken += count;
            }
            let age_s = now_s - (taken - 1) as f64 * source_s;
            let mut now = states;
            if age_s > ROUNDING_S {
                now = states.times(&decay(age_s as f32 * self.stop_rad_s));
                now.settle();
            }
            given.put(out, n, &now);
            n += 1;
            if taken >= self.samples {
                states = now;
            }
        }
        self.fade(&mut states, n, &mut given, out);
        array::from_fn(|trace| {
            ((sums[trace] / source_hz - given.sums[trace] / servo_hz) * servo_hz) as f32
        })
    }

    /// The next `count` samples enter: the states decay, and so does each sample but the last. A
    /// function of its own, so that its numbers in registers need no stack while a block is read.
    #[inline(never)]
    fn enter<L: Lanes<N>, const N: usize>(
        &self,
        states: &mut Poles<L, N>,
        sums: &mut [f64; N],
        samples: &[[f32; N]],
        count: usize,
    ) {
        let powers = self.powers.get(CHUNK - count..).unwrap_or_default();
        if let Some((before, left)) = powers.split_first() {
            let mut entering = Poles::zero();
            for (sample, left) in samples.iter().zip(left) {
                entering.add(L::load(sample), left);
                add(sums, sample);
            }
            *states = states.times(before).plus(&entering);
            states.settle();
        }
    }

    /// Silence follows the last sample: the states of the tick before `n` fade.
    #[inline(never)]
    fn fade<S: Scalar, L: Lanes<N>, const N: usize>(
        &self,
        now: &mut Poles<L, N>,
        n: usize,
        given: &mut Given<N>,
        out: &mut [S],
    ) {
        for n in n..given.ticks {
            *now = now.times(&self.tick);
            now.settle();
            given.put(out, n, now);
        }
    }

    /// Adds the missing part of each trace's impulse along the filter's response.
    #[inline(never)]
    pub(crate) fn complete<S: Scalar>(&self, missing: &[f32; MAX_TAPS], out: &mut [S]) {
        let ticks = self.ticks();
        if self.rates.is_identity() || ticks == 0 {
            return;
        }
        let impulse: f32 = responses(self.tick).take(ticks).sum();
        let scale = |missing: f32| {
            if impulse == 0.0 {
                0.0
            } else {
                missing / impulse
            }
        };
        let mut responses = responses(self.tick);
        for first in (0..ticks).step_by(RESPONSES) {
            let mut block = [0.0; RESPONSES];
            block
                .iter_mut()
                .zip(responses.by_ref())
                .for_each(|(to, h)| *to = h);
            for (trace, &missing) in out.chunks_mut(ticks).zip(missing) {
                let scale = scale(missing);
                let trace = trace.get_mut(first..).unwrap_or_default();
                for (out, h) in trace.iter_mut().zip(&block) {
                    *out = S::of(out.value() + scale * h);
                }
            }
        }
    }
}

/// Output of the filter for `N` traces.
struct Given<const N: usize> {
    /// From the response of the poles to that of the filter.
    gain: f32,
    ticks: usize,
    sums: [f64; N],
}

impl<const N: usize> Given<N> {
    /// Writes tick `n`.
    #[inline(always)]
    fn put<S: Scalar, L: Lanes<N>>(&mut self, out: &mut [S], n: usize, now: &Poles<L, N>) {
        let row = L::splat(self.gain) * now.response(&RESIDUES);
        let row = row.to_array().map(S::of);
        add(&mut self.sums, &row.map(S::value));
        put(out, self.ticks, n, row);
    }
}

/// Writes tick `n` of traces side by side, of as many as there are.
#[inline(always)]
fn put<S, const N: usize>(out: &mut [S], ticks: usize, n: usize, row: [S; N]) {
    for (trace, a) in row.into_iter().enumerate() {
        if let Some(place) = out.get_mut(trace * ticks + n) {
            *place = a;
        }
    }
}

#[inline(always)]
fn add<const N: usize>(sums: &mut [f64; N], row: &[f32; N]) {
    for (sum, &a) in sums.iter_mut().zip(row) {
        *sum += f64::from(a);
    }
}

/// The response to one impulse, tick by tick, without its gain.
fn responses(tick: Complex4) -> impl Iterator<Item = f32> {
    let mut state = Complex4 {
        re: F4::ONE,
        im: F4::ZERO,
    };
    core::iter::repeat_with(move || {
        let h = state.response(&RESIDUES);
        state = state.times(tick).settled();
        h
    })
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests run on the host")]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    fn convert(trace: &[f32], source_hz: f32, servo_hz: f32) -> Vec<f32> {
        let resampler = Resampler::new(Rates::new(source_hz, servo_hz), trace.len());
        let mut out = std::vec![0.0; resampler.ticks()];
        let at = |i: usize| trace.get(i).copied().unwrap_or_default();
        let mut missing = [0.0; MAX_TAPS];
        let read = |first: usize, rows: &mut Rows<1>| *rows = array::from_fn(|i| [at(first + i)]);
        missing[..1].copy_from_slice(&resampler.convert::<_, f32, 1>(read, &mut out));
        resampler.complete(&missing, &mut out);
        // Four side by side have the same bits.
        let read = |first: usize, rows: &mut Rows<4>| {
            *rows = array::from_fn(|i| [0.0, 7.0, at(first + i), 0.0]);
        };
        let mut four = std::vec![0.0; 4 * out.len()];
        missing[..4].copy_from_slice(&resampler.convert::<_, F4, 4>(read, &mut four));
        resampler.complete(&missing, &mut four);
        let place = 2 * out.len()..3 * out.len();
        assert!(
            four[place]
                .iter()
                .zip(&out)
                .all(|(a, b)| a.to_bits() == b.to_bits())
        );
        out
    }

    /// Amplitude of a long tone after conversion, in dB re its own.
    fn tone_db(frequency_hz: f32, source_hz: f32, servo_hz: f32) -> f32 {
        let trace: Vec<f32> = (0..1000)
            .map(|i| (core::f32::consts::TAU * frequency_hz * i as f32 / source_hz).sin())
            .collect();
        let out = convert(&trace, source_hz, servo_hz);
        let middle = &out[out.len() / 3..out.len() * 2 / 3];
        let power = middle.iter().map(|y| y * y).sum::<f32>() / middle.len() as f32;
        10.0 * (2.0 * power).log10()
    }

    #[test]
    fn tones_above_half_the_servo_rate_do_not_alias() {
        for frequency_hz in [530.0, 700.0, 1100.0, 2300.0, 4100.0] {
            let db = tone_db(frequency_hz, 10_000.0, 1000.0);
            assert!(db < -40.0, "{frequency_hz}: {db}");
        }
        for frequency_hz in [40.0, 120.0, 200.0] {
            assert!(
                tone_db(frequency_hz, 10_000.0, 1000.0).abs() < 0.5,
                "{frequency_hz}"
            );
        }
        assert!(tone_db(130.0, 1000.0, 10_000.0).abs() < 0.5);
    }

    #[test]
    fn the_impulse_is_kept() {
        for (source_hz, servo_hz, samples) in [
            (10_000.0, 1000.0, 100),
            (10_000.0, 1000.0, 7),
            (10_000.0, 5000.0, 100),
            (44_100.0, 1000.0, 900),
            (1000.0, 10_000.0, 30),
            (8000.0, 3000.0, 64),
            (1000.0, 1000.0, 5),
        ] {
            let trace: Vec<f32> = (0..samples)
                .map(|i| 300.0 * (-0.04 * i as f32).exp() * (0.2 * i as f32).sin())
                .collect();
            let before: f64 =
                trace.iter().map(|&a| f64::from(a)).sum::<f64>() / f64::from(source_hz);
            let out = convert(&trace, source_hz, servo_hz);
            let after: f64 = out.iter().map(|&a| f64::from(a)).sum::<f64>() / f64::from(servo_hz);
            assert!(
                (after / before - 1.0).abs() < 1e-4,
                "{source_hz} {servo_hz}: {before} {after}"
            );
        }
    }

    #[test]
    fn the_delay_is_below_two_milliseconds() {
        let mut trace = std::vec![0.0_f32; 40];
        trace[0] = 1.0;
        let out = convert(&trace, 10_000.0, 1000.0);
        let sum: f32 = out.iter().sum();
        let centroid: f32 = out
            .iter()
            .enumerate()
            .map(|(n, a)| n as f32 * a)
            .sum::<f32>()
            / sum;
        assert!((1.0..2.0).contains(&centroid), "{centroid}");
    }
}
