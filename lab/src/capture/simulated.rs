//! An accelerometer on the tool of a simulated device, with a known response, noise and delay.
//!
//! It feels the vibration that the loop renders, its taps as force over mass, the slow motion of the
//! hand, and gravity. Its response is a low-pass of the first order at 1.6 kHz, its noise is
//! white, its clock drifts. It looks ahead to tell the motion, so what it sends is late by
//! [`Simulated::delay_s`], which is known. It sends the line protocol.

use asperity_experiments::import_accuracy::{BENT_S, GRAVITY_M_S2, HAND_HALF, across, of_tool};
use asperity_host::servo::Record;
use asperity_recording::signal::resample::{Clock, resample};
use asperity_sim::random::unit;
use rand_core::SeedableRng as _;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::fmt::Write as _;

/// Its rate, Hz.
const RATE_HZ: f64 = 5000.0;
/// Its low-pass, Hz; 0.3 dB at 450 Hz.
const CORNER_HZ: f64 = 1600.0;
/// Its noise, g/√Hz.
const NOISE_G: f64 = 80e-6;
/// Fraction by which its clock runs slow, and the clock's first reading, s.
const DRIFT: f64 = 40e-6;
const BEGIN_S: f64 = 3.21;
/// Ticks before and after those whose samples are sent: half the filter of the hand's motion, and
/// that of the interpolation.
const MARGIN: usize = HAND_HALF + 40;
/// Ticks whose samples are sent at once.
const BLOCK: usize = 20;
/// Missed periods that are bridged, at most.
const BRIDGED: u64 = 10_000;

/// A simulated accelerometer.
#[derive(Debug)]
pub struct Simulated {
    tick_hz: f64,
    mass_kg: f64,
    rng: Xoshiro256PlusPlus,
    places_m: Vec<[f64; 3]>,
    vibration: Vec<f64>,
    tap: Vec<f64>,
    /// Tick of the first of the above, and the one that comes next.
    first: u64,
    next: Option<u64>,
    /// Samples that were sent.
    sent: u64,
    low_pass: [f64; 3],
}

impl Simulated {
    /// An accelerometer on a tool whose taps move a mass, in a loop of so many ticks a second.
    #[must_use]
    pub fn new(tick_hz: f64, mass_kg: f64, seed: u64) -> Self {
        Self {
            tick_hz,
            // A texture may have taps without a mass, and they have no force.
            mass_kg: mass_kg.max(1e-3),
            rng: Xoshiro256PlusPlus::seed_from_u64(seed ^ 0xACCE_1E70),
            places_m: Vec::new(),
            vibration: Vec::new(),
            tap: Vec::new(),
            first: 0,
            next: None,
            sent: 0,
            low_pass: [0.0, 0.0, GRAVITY_M_S2],
        }
    }

    /// By how much its newest sample is late when it is sent, s.
    #[must_use]
    pub fn delay_s(&self) -> f64 {
        MARGIN as f64 / self.tick_hz
    }

    /// Takes a tick; gives the lines that are complete with it, of which there may be none.
    #[must_use]
    pub fn tick(&mut self, record: &Record) -> Option<String> {
        let mut text = String::new();
        let next = self.next.unwrap_or_else(|| {
            self.first = record.period;
            text += "#t_us,ax_g,ay_g,az_g\n";
            record.period
        });
        let output = &record.output;
        let place_m = match (&record.reading, self.places_m.last()) {
            (Ok(reading), _) => reading.position_m.map(f64::from),
            (Err(_), last) => last.copied().unwrap_or_default(),
        };
        // The device holds its force through periods that the loop missed.
        let bridged = record.period.saturating_sub(next).min(BRIDGED);
        for _ in 0..=bridged {
            self.places_m.push(place_m);
            self.vibration.push(f64::from(output.vib_m_s2));
            self.tap.push(f64::from(output.tap_n) / self.mass_kg);
        }
        self.next = Some(next + bridged + 1);
        while self.places_m.len() >= 2 * MARGIN + BLOCK {
            self.block(&mut text);
            self.places_m.drain(..BLOCK);
            self.vibration.drain(..BLOCK);
            self.tap.drain(..BLOCK);
            self.first += BLOCK as u64;
        }
        (!text.is_empty()).then_some(text)
    }

    /// Sends the samples of the block in the middle of what is known.
    fn block(&mut self, text: &mut String) {
        let length = 2 * MARGIN + BLOCK;
        let mut axes = of_tool(
            &self.places_m[..length],
            &self.vibration[..length],
            self.tick_hz,
        );
        let normal = axes[2].iter_mut().zip(&self.tap);
        normal.for_each(|(a, tap)| *a += tap);
        // Sample n is taken at n · period, from the first tick on.
        let period_s = (1.0 + DRIFT) / RATE_HZ;
        let begin_s = (self.first as f64 + MARGIN as f64) / self.tick_hz;
        let end_s = begin_s + BLOCK as f64 / self.tick_hz;
        self.sent = self.sent.max((begin_s / period_s).ceil() as u64);
        let to = Clock {
            start_s: self.sent as f64 * period_s,
            rate_hz: 1.0 / period_s,
        };
        let count = ((end_s - to.start_s) / period_s).ceil().max(0.0) as usize;
        let from = |late_s: f64| Clock {
            start_s: self.first as f64 / self.tick_hz + late_s,
            rate_hz: self.tick_hz,
        };
        let as_f32 = |x: &[f64]| -> Vec<f32> { x.iter().map(|x| *x as f32).collect() };
        let mut samples = axes.map(|axis| resample(&as_f32(&axis), from(0.0), to, count));
        let bent = as_f32(&across(&self.vibration[..length]));
        let bent = resample(&bent, from(BENT_S), to, count);
        samples[2].iter_mut().zip(bent).for_each(|(a, b)| *a += b);
        let keep = libm::exp(-std::f64::consts::TAU * CORNER_HZ / RATE_HZ);
        for n in 0..count {
            let t_us = 1e6 * (BEGIN_S + (self.sent + n as u64) as f64 / RATE_HZ);
            // Writing to a string cannot fail.
            let _ = write!(text, "{t_us:.0}");
            for (axis, low_pass) in samples.iter().zip(&mut self.low_pass) {
                *low_pass = axis[n] + keep * (*low_pass - axis[n]);
                let gauss = (0..12).map(|_| unit(&mut self.rng)).sum::<f64>() - 6.0;
                let noise_g = NOISE_G * (0.5 * RATE_HZ).sqrt() * gauss;
                let _ = write!(text, ",{:.5}", *low_pass / GRAVITY_M_S2 + noise_g);
            }
            text.push('\n');
        }
        self.sent += count as u64;
    }
}
