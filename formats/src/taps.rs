//! TAPS: the tap bank, traces at their own rate, twelve bits a sample.

use crate::{
    FormatError,
    error::in_range,
    limits,
    wire::{Reader, f32_at},
};

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

/// One trace: the acceleration transient of one impact.
#[derive(Debug, Clone, Copy)]
pub struct Trace<'a> {
    /// Impact speed, m/s.
    pub speed_m_s: f32,
    /// Acceleration of full scale, m/s².
    pub peak_m_s2: f32,
    samples: usize,
    codes: &'a [u8],
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
                codes: traces.get(at + 8..at + stride).unwrap_or_default(),
            }
        })
    }
}

/// The first of packed codes that is −2048, which no sample may be.
fn first_below_scale(codes: &[u8]) -> Option<usize> {
    let even = |a: u8, b: u8| a == 0 && b & 0x0f == 0x08;
    let odd = |b: u8, c: u8| b & 0xf0 == 0 && c == 0x80;
    let (pairs, last) = codes.as_chunks::<3>();
    let pair = pairs.iter().position(|&[a, b, c]| even(a, b) | odd(b, c));
    match (pair, last) {
        (Some(pair), _) => {
            let [a, b, _] = pairs[pair];
            Some(2 * pair + usize::from(!even(a, b)))
        }
        (None, &[a, b]) => even(a, b).then_some(2 * pairs.len()),
        (None, _) => None,
    }
}

impl<'a> Trace<'a> {
    /// Stored codes, −2047..=2047.
    fn codes(&self) -> impl ExactSizeIterator<Item = i16> + Clone + use<'a> {
        let codes = self.codes;
        (0..self.samples).map(move |index| {
            let at = index / 2 * 3;
            let byte = |k: usize| i16::from(codes.get(at + k).copied().unwrap_or(0));
            // Two samples in three bytes, the even one in the low twelve bits.
            let code = if index % 2 == 0 {
                byte(0) | (byte(1) & 0x0f) << 8
            } else {
                byte(1) >> 4 | byte(2) << 4
            };
            // Sign of twelve bits.
            (code << 4) >> 4
        })
    }

    /// Accelerations, m/s², at the bank's sample rate.
    pub fn accel_m_s2(&self) -> impl ExactSizeIterator<Item = f32> + Clone + use<'a> {
        let step = self.peak_m_s2 / f32::from(FULL_SCALE);
        self.codes().map(move |code| f32::from(code) * step)
    }
}
