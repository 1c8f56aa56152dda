//! Everything of a recording, in memory, while it is made.

use super::clock::{ClockLine, arrivals, chain, line_under};
use super::columns::{Channel, Column};
use super::exploration::{Exploration, Plan};
use super::reader::{Batch, SensorDescription};
use super::samples::Samples;
use asperity_host::servo::Record;
use asperity_recording::reader::MAX_KEPT;

/// Where the load on the surface comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Load {
    /// The force that the loop renders.
    Loop,
    /// The sensor, which measures it beside the acceleration.
    Sensor,
}

/// The device at one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// When, on the loop's clock, ns.
    pub at_ns: u64,
    /// Where the tool is, m.
    pub place_m: [f32; 3],
    /// The force that the loop renders, N.
    pub force_n: [f32; 3],
}

/// A recording that is being made.
#[derive(Debug)]
pub struct Take {
    load: Load,
    /// Ticks a second.
    rate_hz: f64,
    /// The device moves on by due times, and not by the clock.
    is_stepped: bool,
    /// Time by which the sensor is known to be late, s.
    delay_s: f64,
    exploration: Exploration,
    touches: Vec<Touch>,
    description: Option<SensorDescription>,
    samples: Samples,
    /// Place behind the last sample of each batch, and when it arrived, s.
    batches: Vec<(usize, f64)>,
    /// Newest load that the sensor told, N.
    load_n: f64,
    most: usize,
}

impl Take {
    /// Nothing is recorded yet, of a loop at `rate_hz` and a sensor that is known to be late.
    #[must_use]
    pub fn new(plan: Plan, rate_hz: f64, is_stepped: bool, delay_s: f64) -> Self {
        Self {
            load: if plan.is_sensor {
                Load::Sensor
            } else {
                Load::Loop
            },
            rate_hz,
            is_stepped,
            delay_s,
            exploration: Exploration::new(plan),
            touches: Vec::new(),
            description: None,
            samples: Samples::default(),
            batches: Vec::new(),
            load_n: f64::NAN,
            most: MAX_KEPT,
        }
    }

    /// Takes what the device did in a tick. A position that is not new is left out.
    pub fn tick(&mut self, record: &Record) {
        let Ok(reading) = record.reading else { return };
        if !reading.fresh {
            return;
        }
        let at_ns = if self.is_stepped {
            record.times.due_ns
        } else {
            record.times.read_ns
        };
        if self.touches.last().is_some_and(|last| last.at_ns >= at_ns) {
            return;
        }
        let touch = Touch {
            at_ns,
            place_m: reading.position_m,
            force_n: record.output.force_n,
        };
        self.touches.push(touch);
        let load_n = match self.load {
            Load::Loop => f64::from(record.output.normal_force_n),
            Load::Sensor => self.load_n,
        };
        let place_m = reading.position_m.map(f64::from);
        self.exploration.take(1e-9 * at_ns as f64, place_m, load_n);
    }

    /// Takes what a sensor sent at once. Samples that come before the first tick wait for it.
    pub fn batch(&mut self, description: &SensorDescription, batch: &Batch) {
        let description = self.description.get_or_insert_with(|| description.clone());
        let width = description.layout.channels().count();
        if let (Some(place), Load::Sensor) = (description.layout.load(), self.load) {
            let unit = description
                .layout
                .channels()
                .nth(place)
                .map_or(1.0, |c| c.unit.to_si);
            let loads = batch.samples.values.iter().skip(place).step_by(width);
            let (sum, count) = loads
                .filter(|load| load.is_finite())
                .fold((0.0, 0), |(sum, count), load| {
                    (sum + f64::from(*load), count + 1)
                });
            if count > 0 {
                self.load_n = unit * sum / f64::from(count);
            }
        }
        self.samples.own.extend_from_slice(&batch.samples.own);
        self.samples.values.extend_from_slice(&batch.samples.values);
        let arrived_s = 1e-9 * batch.arrived_ns as f64;
        self.batches.push((self.samples.len(), arrived_s));
    }

    /// Returns the exploration: its coverage and the next step.
    #[must_use]
    pub fn exploration(&self) -> &Exploration {
        &self.exploration
    }

    /// Where the load comes from.
    #[must_use]
    pub fn load(&self) -> Load {
        self.load
    }

    /// Returns true if an import would keep no more.
    #[must_use]
    pub fn is_full(&self) -> bool {
        // A time takes as much room as two values.
        8 * self.touches.len() + 2 * self.samples.len() + self.samples.values.len() > self.most
    }

    /// Ticks a second.
    #[must_use]
    pub fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Returns true if the sensor's own time resolves samples `period_s` apart.
    pub(super) fn tells_samples_apart(&self, period_s: f64) -> bool {
        let columns = self
            .description
            .iter()
            .flat_map(|description| description.layout.columns());
        columns.into_iter().all(|column| match column {
            Column::Clock(unit_s) => *unit_s <= 0.5 * period_s,
            _ => true,
        })
    }

    /// Rows of the device.
    #[must_use]
    pub fn touches(&self) -> &[Touch] {
        &self.touches
    }

    /// Returns the channels that the sensor measures.
    #[must_use]
    pub fn channels(&self) -> Vec<Channel> {
        let description = self.description.iter();
        description
            .flat_map(|description| description.layout.channels().copied())
            .collect()
    }

    /// Values of a sample.
    #[must_use]
    pub fn values(&self, sample: usize) -> &[f32] {
        let width = self.channels_count();
        &self.samples.values[sample * width..][..width]
    }

    fn channels_count(&self) -> usize {
        self.description
            .as_ref()
            .map_or(1, |description| description.layout.channels().count())
    }

    /// From the sensor's own time to the loop's, once enough came.
    #[must_use]
    pub fn clock(&self) -> Option<ClockLine> {
        self.clock_by(&chain(&self.samples.own))
    }

    fn clock_by(&self, chain: &[u32]) -> Option<ClockLine> {
        let arrivals = arrivals(&self.samples.own, chain, &self.batches);
        line_under(&arrivals, self.description.as_ref()?.stated_scale)
    }

    /// The samples whose time stamps are believed, and when they were taken on the loop's clock, s.
    #[must_use]
    pub fn timed(&self) -> (Vec<u32>, Vec<f64>) {
        let chain = chain(&self.samples.own);
        let Some(clock) = self.clock_by(&chain) else {
            return (Vec::new(), Vec::new());
        };
        let own = chain
            .iter()
            .map(|&sample| self.samples.own[sample as usize]);
        let times_s = own.map(|own| clock.host_s(own) - self.delay_s).collect();
        (chain, times_s)
    }

    /// Samples that came.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples.len()
    }
}
