//! TAPS: the tap bank, traces at their own rate, twelve bits a sample.

use crate::{
    error::{FormatError, in_range},
    limits,
    wire::{Reader, f32_at},
};
use core::array;

const FIXED_LEN: usize = 8;
/// Largest code of a sample.
pub(crate) const FULL_SCALE: i16 = 2047;

/// The tap bank: 0 to 16 traces of one length.
#[derive(Debug, Clone, Copy)]
pub struct Taps<'a> {
    sample_rate_hz: f32,
    count: usize,
    samples: usize,
    traces: &'a [u8],
}

/// A trace: the acceleration transient of a single impact.
#[derive(Debug, Clone, Copy)]
pub struct Trace<'a> {
    /// Impact speed, m/s.
    pub speed_m_s: f32,
    /// Acceleration of full scale, m/s².
    pub peak_m_s2: f32,
    samples: usize,
    /// The codes, and the byte before them.
    packed: &'a [u8],
}

/// Bytes of `samples` packed codes.
pub(crate) const fn packed_len(samples: usize) -> usize {
    (samples * 3).div_ceil(2)
}

impl<'a> Taps<'a> {
    pub(crate) fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let mut reader = Reader::new(bytes);
        let sample_rate_hz = in_range(
            "taps.sample_rate_hz",
            0,
            reader.f32("taps.sample_rate_hz")?,
            limits::SAMPLE_RATE_HZ,
            "100 Hz to 200 kHz",
        )?;
        let count = usize::from(reader.u8("taps.trace_count")?);
        let reserved = reader.u8("taps.reserved")?;
        let samples = usize::from(reader.u16("taps.samples")?);
        if reserved != 0 {
            return Err(FormatError::invalid(
                "taps.reserved",
                0,
                f64::from(reserved),
                "must be 0",
            ));
        }
        if count > limits::MAX_TAPS {
            return Err(FormatError::invalid(
                "taps.trace_count",
                0,
                count as f64,
                "at most 16",
            ));
        }
        if samples > limits::MAX_TAP_SAMPLES || (samples == 0) != (count == 0) {
            return Err(FormatError::invalid(
                "taps.samples",
                0,
                samples as f64,
                "1 to 1024, or 0 in an empty bank",
            ));
        }
        let mut previous = 0.0;
        for index in 0..count {
            let speed = in_range(
                "taps.trace.speed_m_s",
                index,
                reader.f32("taps.trace.speed_m_s")?,
                (f32::MIN_POSITIVE, limits::MAX_IMPACT_SPEED_M_S),
                "above 0, at most 100 m/s",
            )?;
            if speed <= previous {
                return Err(FormatError::invalid(
                    "taps.trace.speed_m_s",
                    index,
                    f64::from(speed),
                    "must ascend",
                ));
            }
            previous = speed;
            in_range(
                "taps.trace.peak_m_s2",
                index,
                reader.f32("taps.trace.peak_m_s2")?,
                (0.0, limits::MAX_TAP_ACCEL_M_S2),
                "0 to 1e6 m/s²",
            )?;
            let codes = reader.bytes("taps.trace.codes", packed_len(samples))?;
            if let Some(at) = first_below_scale(codes) {
                return Err(FormatError::invalid(
                    "taps.trace.codes",
                    index * samples + at,
                    -2048.0,
                    "codes are −2047 to 2047",
                ));
            }
        }
        reader.finish("taps")?;
        Ok(Self {
            sample_rate_hz,
            count,
            samples,
            traces: bytes.get(FIXED_LEN..).unwrap_or_default(),
        })
    }

    /// Sample rate of every trace, Hz.
    #[must_use]
    pub const fn sample_rate_hz(&self) -> f32 {
        self.sample_rate_hz
    }

    /// Samples a trace.
    #[must_use]
    pub const fn samples(&self) -> usize {
        self.samples
    }

    /// The traces, in ascending order of impact speed.
    pub fn traces(&self) -> impl ExactSizeIterator<Item = Trace<'a>> + use<'a> {
        let (samples, traces) = (self.samples, self.traces);
        let stride = 8 + packed_len(samples);
        (0..self.count).map(move |index| {
            let at = index * stride;
            Trace {
                speed_m_s: f32_at(traces, at),
                peak_m_s2: f32_at(traces, at + 4),
                samples,
                packed: traces.get(at + 7..at + stride).unwrap_or_default(),
            }
        })
    }
}

/// The first of packed codes that is −2048, which no sample may be.
fn first_below_scale(codes: &[u8]) -> Option<usize> {
    if !any_below_scale(codes) {
        return None;
    }
    const BELOW: u32 = 0x800;
    let bits = |[a, b, c]: [u8; 3]| u32::from_le_bytes([a, b, c, 0]);
    let (pairs, last) = codes.as_chunks();
    let is_below = |&pair: &[u8; 3]| (bits(pair) & 0xfff == BELOW) | (bits(pair) >> 12 == BELOW);
    if let Some(pair) = pairs.iter().position(is_below) {
        return Some(2 * pair + usize::from(bits(pairs[pair]) & 0xfff != BELOW));
    }
    match *last {
        [a, b] if bits([a, b, 0]) & 0xfff == BELOW => Some(2 * pairs.len()),
        _ => None,
    }
}

/// Returns true if any of the packed codes is −2048. Branch-free, four codes at a time.
fn any_below_scale(codes: &[u8]) -> bool {
    const ONES: u64 = 0x001_001_001_001;
    const SIGNS: u64 = 0x800_800_800_800;
    // A code of −2048 is its sign alone. Without the sign it is 0, and subtracting 1 borrows. A
    // borrow reaches a neighbour only from such a code.
    let mark = |[a, b, c, d, e, f]: [u8; 6]| {
        let four = u64::from_le_bytes([a, b, c, d, e, f, 0, 0]);
        (four ^ SIGNS).wrapping_sub(ONES) & four
    };
    let (fours, rest) = codes.as_chunks();
    // Zeros are valid codes, and so are four bits behind the last one.
    let mut last = [0; 6];
    last.iter_mut().zip(rest).for_each(|(to, from)| *to = *from);
    let marks = fours
        .iter()
        .fold(mark(last), |marks, &four| marks | mark(four));
    marks & SIGNS != 0
}

/// Samples of a trace that [`side_by_side`] reads at once: two ticks at 1 kHz of a trace at 10 kHz,
/// and one sample before and behind, since a block begins at an even index.
pub const BLOCK: usize = 22;

/// Packed codes of a block, after the byte before them: a pair is read as a word that begins with
/// that byte.
type Packed = [u8; 1 + packed_len(BLOCK)];

/// The codes of pair `pair` of a block.
#[inline(always)]
fn two_codes(packed: &Packed, pair: usize) -> [i32; 2] {
    let word = packed.get(3 * pair..).and_then(<[u8]>::first_chunk);
    codes_of(i32::from_le_bytes(*word.unwrap_or(&[0; 4])))
}

/// The two codes of a word that begins with the byte before them.
#[inline(always)]
fn codes_of(word: i32) -> [i32; 2] {
    [(word << 12) >> 20, word >> 20]
}

/// Reads the accelerations of traces from sample `first` on, which is even, m/s²: one row a sample,
/// one column a trace; 0 beyond the last one.
#[inline(never)]
pub fn side_by_side<const N: usize>(
    traces: &[Trace<'_>; N],
    first: usize,
    rows: &mut [[f32; N]; BLOCK],
) {
    let traces = traces.each_ref();
    let steps = traces.map(Trace::step);
    let rest = traces.map(|trace| trace.rest(first));
    let whole = rest.map(<[u8]>::first_chunk);
    if whole.iter().any(Option::is_none) {
        return last(&rest, &steps, rows);
    }
    let packed: [&Packed; N] = whole.map(|packed| packed.unwrap_or(&[0; _]));
    for (pair, rows) in rows.as_chunks_mut().0.iter_mut().enumerate() {
        let codes = packed.map(|packed| two_codes(packed, pair));
        let row = |of: usize| array::from_fn(|column| codes[column][of] as f32 * steps[column]);
        *rows = [row(0), row(1)];
    }
}

/// [`side_by_side`] where the codes end within the block: a function of its own and column by
/// column, because the padding takes room on the stack.
#[cold]
#[inline(never)]
fn last<const N: usize>(rest: &[&[u8]; N], steps: &[f32; N], rows: &mut [[f32; N]; BLOCK]) {
    for (column, (rest, step)) in rest.iter().zip(steps).enumerate() {
        let packed = padded(rest);
        for (pair, rows) in rows.as_chunks_mut::<2>().0.iter_mut().enumerate() {
            for (row, code) in rows.iter_mut().zip(two_codes(&packed, pair)) {
                row[column] = code as f32 * step;
            }
        }
    }
}

/// The last codes of a trace with the byte before them, and zeros.
#[inline]
fn padded(rest: &[u8]) -> Packed {
    let mut packed = [0; _];
    packed
        .iter_mut()
        .zip(rest)
        .for_each(|(to, from)| *to = *from);
    // An odd last code has no partner, so its upper half byte is cleared.
    if let (0, Some(last)) = (rest.len() % 3, packed.get_mut(rest.len().wrapping_sub(1))) {
        *last &= 0x0f;
    }
    packed
}

impl<'a> Trace<'a> {
    /// Accelerations, m/s², at the bank's sample rate.
    pub fn accel_m_s2(&self) -> impl ExactSizeIterator<Item = f32> + Clone + use<'a> {
        let trace = *self;
        (0..self.samples).map(move |index| {
            let rest = trace.rest(index - index % 2);
            let codes = match rest.first_chunk() {
                Some(word) => codes_of(i32::from_le_bytes(*word)),
                None => two_codes(&padded(rest), 0),
            };
            codes[index % 2] as f32 * trace.step()
        })
    }

    /// Codes from sample `first` on, which is even, with the byte before them.
    #[inline]
    fn rest(&self, first: usize) -> &'a [u8] {
        self.packed.get(first / 2 * 3..).unwrap_or_default()
    }

    /// Acceleration of one code, m/s².
    #[inline]
    fn step(&self) -> f32 {
        self.peak_m_s2 / f32::from(FULL_SCALE)
    }
}
