//! All channels on one clock at 1 kHz, and what follows from them: speed, load, contact.

use crate::{
    description::{Axis, Quantity},
    reader::Recording,
    remedy,
    signal::{
        filter::{derivative, low_pass},
        quantile::{mean, median, quantile},
        resample::{Clock, resample},
    },
};
use asperity_io::diagnostic::Fault;
use std::ops::Range;

/// Rate of the timeline and of the models, Hz.
pub const RATE_HZ: f64 = 1000.0;
/// Shortest recording, s.
const SHORTEST_S: f64 = 2.0;
/// Cut-off of speed and load, Hz: that of the renderer's velocity filter.
const SLOW_HZ: f64 = 20.0;
/// Half length of the slow filter, samples.
const SLOW_HALF: usize = 80;
/// Largest load of a tool in the air that counts as the sensor's bias, N.
const LARGEST_BIAS_N: f64 = 0.5;
/// Least load that is contact, N.
const LEAST_LOAD_N: f64 = 0.06;
/// Time that is lost around a bad stretch, samples.
const MARGIN: usize = 20;

/// Every channel at [`RATE_HZ`] over the time that all of them cover.
#[derive(Debug, Clone)]
pub struct Aligned {
    /// Its clock.
    pub clock: Clock,
    /// Samples.
    pub count: usize,
    /// The channels, in the order of [`Recording::channels`].
    pub channels: Vec<Vec<f64>>,
}

impl Aligned {
    /// Resamples all channels. `late_s` says for each of them by how much it comes after the others.
    ///
    /// # Errors
    /// [`Fault`] where the files share less than two seconds.
    pub fn new(recording: &Recording, late_s: &[f64]) -> Result<Self, Fault> {
        let clocks: Vec<Clock> = recording
            .channels
            .iter()
            .zip(late_s)
            .map(|(channel, late_s)| Clock {
                start_s: channel.clock.start_s - late_s,
                ..channel.clock
            })
            .collect();
        let end = |clock: &Clock, samples: usize| clock.time_s(samples as f64 - 1.0);
        let ends = clocks
            .iter()
            .zip(&recording.channels)
            .map(|(clock, channel)| end(clock, channel.samples.len()));
        let end_s = ends.fold(f64::INFINITY, f64::min);
        let start_s = clocks
            .iter()
            .map(|clock| clock.start_s)
            .fold(f64::NEG_INFINITY, f64::max);
        let shared_s = end_s - start_s;
        if shared_s.is_nan() || shared_s < SHORTEST_S {
            let what = if shared_s < 0.0 {
                "the files do not overlap in time; give `start_s` or clocks of one origin"
                    .to_owned()
            } else {
                format!(
                    "all files together cover {shared_s:.2} s; at least {SHORTEST_S} s are needed"
                )
            };
            return Err(Fault::new(what, remedy::TOO_LITTLE).at(&recording.folder));
        }
        let clock = Clock {
            start_s,
            rate_hz: RATE_HZ,
        };
        let count = (shared_s * RATE_HZ) as usize;
        let channels = recording
            .channels
            .iter()
            .zip(&clocks)
            .map(|(channel, &from)| resample(&channel.samples, from, clock, count))
            .collect();
        Ok(Self {
            clock,
            count,
            channels,
        })
    }

    /// The samples of the timeline that lie in stretches of a channel.
    #[must_use]
    pub fn span(
        &self,
        recording: &Recording,
        channel: usize,
        samples: &Range<u64>,
    ) -> Range<usize> {
        let own = recording.channels[channel].clock;
        let at = |sample: u64| self.clock.sample(own.time_s(sample as f64));
        let clamp = |x: f64| (x.max(0.0) as usize).min(self.count);
        clamp(at(samples.start) - MARGIN as f64)..clamp(at(samples.end) + MARGIN as f64)
    }

    /// The channel of a quantity along an axis.
    #[must_use]
    pub fn find(&self, recording: &Recording, quantity: Quantity, axis: Axis) -> Option<usize> {
        recording
            .channels
            .iter()
            .position(|c| c.quantity == quantity && c.axis == axis)
    }

    /// The channels of a quantity along x, y and z.
    #[must_use]
    pub fn axes(&self, recording: &Recording, quantity: Quantity) -> [Option<&[f64]>; 3] {
        [Axis::X, Axis::Y, Axis::Z].map(|axis| {
            self.find(recording, quantity, axis)
                .map(|channel| &self.channels[channel][..])
        })
    }
}

/// Motion of the hand and signals of the sensors, at [`RATE_HZ`].
#[derive(Debug, Clone)]
pub struct Timeline {
    /// Its clock.
    pub clock: Clock,
    /// Acceleration along each axis without its mean, m/s².
    pub accel_m_s2: Vec<Vec<f64>>,
    /// Mean acceleration of each axis, m/s²: gravity and bias.
    pub steady_m_s2: Vec<f64>,
    /// Speed along the surface, mm/s.
    pub speed_mm_s: Vec<f64>,
    /// Direction of the motion in the plane, a unit vector per sample; along one axis, its sign.
    pub heading: Vec<[f64; 2]>,
    /// Height of the tip, m, if it was recorded.
    pub height_m: Option<Vec<f64>>,
    /// Load along the normal, N, pressing counted positive.
    pub load_n: Vec<f64>,
    /// The same load before it is low-passed, N: it shows when a contact begins.
    pub unsmoothed_load_n: Vec<f64>,
    /// Bias of the load that was taken away, N.
    pub bias_n: f64,
    /// Force against the motion, N, if it was recorded.
    pub drag_n: Option<Vec<f64>>,
    /// True where the tool touches the surface.
    pub contact: Vec<bool>,
    /// True where all channels are good.
    pub good: Vec<bool>,
}

impl Timeline {
    /// Derives the timeline from aligned channels, without the stretches that a check found bad.
    ///
    /// # Errors
    /// [`Fault`] where acceleration, load or motion was not recorded.
    pub fn new(
        recording: &Recording,
        aligned: &Aligned,
        bad: &[Range<usize>],
    ) -> Result<Self, Fault> {
        let missing = |what: &str| {
            let what = format!("the recording has no {what}");
            Fault::new(what, remedy::MISSING).at(&recording.folder)
        };
        let accel: Vec<&Vec<f64>> = recording
            .channels
            .iter()
            .zip(&aligned.channels)
            .filter(|(channel, _)| channel.quantity == Quantity::Acceleration)
            .map(|(_, samples)| samples)
            .collect();
        if accel.is_empty() || accel.len() > 3 {
            return Err(missing("acceleration of one to three axes"));
        }
        let force = aligned.axes(recording, Quantity::Force);
        let load = force[2].ok_or_else(|| missing("force along the normal, axis z"))?;
        let velocity = velocity(recording, aligned);
        let (speed_mm_s, heading) = motion(recording, aligned, velocity.as_ref())
            .ok_or_else(|| missing("position in the plane, axes x and y, and no speed"))?;
        let (load_n, bias_n, sign) = pressing(load);
        let steady_m_s2: Vec<f64> = accel.iter().map(|axis| mean(axis)).collect();
        let accel_m_s2 = accel
            .iter()
            .zip(&steady_m_s2)
            .map(|(axis, mean)| axis.iter().map(|x| x - mean).collect())
            .collect();
        let contact = contact(&load_n);
        let mut good = vec![true; aligned.count];
        for span in bad {
            good[span.clone()].fill(false);
        }
        Ok(Self {
            clock: aligned.clock,
            accel_m_s2,
            steady_m_s2,
            speed_mm_s,
            heading,
            height_m: aligned.axes(recording, Quantity::Position)[2].map(<[f64]>::to_vec),
            drag_n: drag_n(recording, aligned, velocity.as_ref(), &contact),
            unsmoothed_load_n: load.iter().map(|x| sign * x - sign * bias_n).collect(),
            load_n,
            bias_n,
            contact,
            good,
        })
    }

    /// Samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.speed_mm_s.len()
    }

    /// Returns true if there are no samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Time in contact, s.
    #[must_use]
    pub fn contact_s(&self) -> f64 {
        self.contact.iter().filter(|touches| **touches).count() as f64 / RATE_HZ
    }
}

/// Without what is faster than the renderer's velocity filter.
fn slow(signal: &[f64]) -> Vec<f64> {
    low_pass(signal, SLOW_HZ / RATE_HZ, SLOW_HALF)
}

/// Velocity in the plane, m/s.
pub(crate) fn velocity(recording: &Recording, aligned: &Aligned) -> Option<[Vec<f64>; 2]> {
    let axes = |quantity| {
        let [x, y, _] = aligned.axes(recording, quantity);
        let zero = || vec![0.0; aligned.count];
        (x.is_some() || y.is_some()).then(|| {
            [
                x.map_or_else(zero, <[f64]>::to_vec),
                y.map_or_else(zero, <[f64]>::to_vec),
            ]
        })
    };
    if let Some(given) = axes(Quantity::Speed) {
        return Some(given.map(|axis| slow(&axis)));
    }
    let position = axes(Quantity::Position)?;
    Some(position.map(|axis| {
        slow(&derivative(&axis))
            .into_iter()
            .map(|step| step * RATE_HZ)
            .collect()
    }))
}

/// Speed, mm/s: along one axis where that was recorded, or else in the plane. And the heading: in the plane where
/// that was recorded, for a speed along an axis may have no sign.
fn motion(
    recording: &Recording,
    aligned: &Aligned,
    velocity: Option<&[Vec<f64>; 2]>,
) -> Option<(Vec<f64>, Vec<[f64; 2]>)> {
    let along = |quantity| {
        let channel = aligned.find(recording, quantity, Axis::Along)?;
        Some(&aligned.channels[channel])
    };
    let along_m_s = match (along(Quantity::Speed), velocity) {
        (Some(speed), _) => Some(slow(speed)),
        (None, Some(_)) => None,
        (None, None) => {
            let steps = slow(&derivative(along(Quantity::Position)?));
            Some(steps.iter().map(|step| RATE_HZ * step).collect())
        }
    };
    let plane_m_s: Vec<[f64; 2]> = match velocity {
        Some([x, y]) => x.iter().zip(y).map(|(&x, &y)| [x, y]).collect(),
        None => along_m_s
            .iter()
            .flatten()
            .map(|&v: &f64| [v, 0.0])
            .collect(),
    };
    let length = |v: &[f64; 2]| libm::hypot(v[0], v[1]);
    let speed_mm_s = match &along_m_s {
        Some(along) => along.iter().map(|v: &f64| 1e3 * v.abs()).collect(),
        None => plane_m_s.iter().map(|v| 1e3 * length(v)).collect(),
    };
    let unit = |v: &[f64; 2]| v.map(|axis| axis / length(v).max(f64::MIN_POSITIVE));
    Some((speed_mm_s, plane_m_s.iter().map(unit).collect()))
}

/// The load with pressing positive, free of the bias that it shows in the air, that bias, and the sign
/// of pressing.
fn pressing(load: &[f64]) -> (Vec<f64>, f64, f64) {
    let smooth = slow(load);
    let middle = median(smooth.iter().copied());
    let (low, high) = (
        quantile(smooth.iter().copied(), 0.01),
        quantile(smooth.iter().copied(), 0.99),
    );
    // Pressing reaches further from rest than anything else.
    let sign = if (high - middle).abs().max(high.abs()) >= low.abs() {
        1.0
    } else {
        -1.0
    };
    let least = quantile(smooth.iter().map(|x| sign * x), 0.03);
    let bias = if least.abs() < LARGEST_BIAS_N {
        least
    } else {
        0.0
    };
    (
        smooth.into_iter().map(|x| sign * x - bias).collect(),
        sign * bias,
        sign,
    )
}

/// Contact begins above a threshold and ends below half of it.
fn contact(load_n: &[f64]) -> Vec<bool> {
    let threshold = LEAST_LOAD_N.max(0.02 * quantile(load_n.iter().copied(), 0.95));
    let mut touches = false;
    load_n
        .iter()
        .map(|&load| {
            touches = load > if touches { 0.5 * threshold } else { threshold };
            touches
        })
        .collect()
}

/// The force against the motion.
fn drag_n(
    recording: &Recording,
    aligned: &Aligned,
    velocity: Option<&[Vec<f64>; 2]>,
    contact: &[bool],
) -> Option<Vec<f64>> {
    if let Some(along) = aligned.find(recording, Quantity::Force, Axis::Along) {
        return Some(
            slow(&aligned.channels[along])
                .into_iter()
                .map(f64::abs)
                .collect(),
        );
    }
    let [x, y, _] = aligned.axes(recording, Quantity::Force);
    let zero = vec![0.0; aligned.count];
    let (Some([vx, vy]), true) = (velocity, x.is_some() || y.is_some()) else {
        return None;
    };
    let in_air = |axis: &[f64]| {
        median(
            axis.iter()
                .zip(contact)
                .filter(|(_, touches)| !**touches)
                .map(|(x, _)| *x),
        )
    };
    let (x, y) = (slow(x.unwrap_or(&zero)), slow(y.unwrap_or(&zero)));
    let bias = (in_air(&x), in_air(&y));
    let along: Vec<f64> = (0..aligned.count)
        .map(|n| {
            let speed = libm::hypot(vx[n], vy[n]).max(1e-6);
            -((x[n] - bias.0) * vx[n] + (y[n] - bias.1) * vy[n]) / speed
        })
        .collect();
    // A sensor under the surface has the other sign than one in the tool.
    let sign = if median(
        along
            .iter()
            .zip(contact)
            .filter(|(_, touches)| **touches)
            .map(|(x, _)| *x),
    ) < 0.0
    {
        -1.0
    } else {
        1.0
    };
    Some(along.into_iter().map(|x| sign * x).collect())
}

#[cfg(test)]
#[path = "timeline_tests.rs"]
mod tests;
