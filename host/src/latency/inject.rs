//! A controlled delay in one stage of some ticks: a measurement that does not find it is none.

use crate::device::{Description, Device, DeviceError, Reading};
use crate::servo::{Clock, Render, Stage};
use asperity_runtime::{Config, Counters, Output, Sample};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// A delay in one of so many ticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Injection {
    /// The stage: reading, computing or writing.
    pub stage: Stage,
    /// Its length, ns.
    pub delay_ns: u64,
    /// It comes in one of so many ticks.
    pub every: u64,
}

/// Why a text is no injection.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "`{0}` is not a delay: write STAGE:MICROSECONDS:EVERY, such as compute:300:1000, with the stage read, compute or write, at most 100000 µs, in one of 2 to 1000000 ticks"
)]
pub struct InjectionError(String);

impl FromStr for Injection {
    type Err = InjectionError;

    fn from_str(text: &str) -> Result<Self, InjectionError> {
        let parse = || {
            let mut parts = text.split(':');
            let stage = Stage::of_name(parts.next()?)?;
            let delay_us: u64 = parts.next()?.parse().ok()?;
            let every = parts.next()?.parse().ok()?;
            let fits = matches!(stage, Stage::Read | Stage::Compute | Stage::Write)
                && (1..=100_000).contains(&delay_us)
                && (2..=1_000_000).contains(&every)
                && parts.next().is_none();
            fits.then_some(Self {
                stage,
                delay_ns: 1000 * delay_us,
                every,
            })
        };
        parse().ok_or_else(|| InjectionError(text.into()))
    }
}

impl fmt::Display for Injection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (stage, delay_us) = (self.stage.name(), self.delay_ns / 1000);
        write!(f, "{stage}:{delay_us}:{}", self.every)
    }
}

/// A device or a renderer with the delay in it. Reading, computing and writing are counted apart,
/// each once a tick.
#[derive(Debug)]
pub struct Delayed<T, C> {
    inner: T,
    clock: C,
    injection: Option<Injection>,
    calls: [u64; 2],
}

impl<T, C: Clock> Delayed<T, C> {
    /// Puts the delay into `inner`; without an injection nothing changes.
    pub fn new(inner: T, clock: C, injection: Option<Injection>) -> Self {
        Self {
            inner,
            clock,
            injection,
            calls: [0; 2],
        }
    }

    /// Waits if a call of this stage is to be delayed.
    fn pass(&mut self, stage: Stage) {
        let Some(injection) = self.injection.filter(|i| i.stage == stage) else {
            return;
        };
        let calls = &mut self.calls[usize::from(stage == Stage::Write)];
        *calls += 1;
        if calls.is_multiple_of(injection.every) {
            // Through `sleep_until`, so that a virtual clock passes.
            self.clock
                .sleep_until(self.clock.now_ns() + injection.delay_ns);
        }
    }
}

impl<D: Device, C: Clock + Send> Device for Delayed<D, C> {
    fn description(&self) -> &Description {
        self.inner.description()
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        self.pass(Stage::Read);
        self.inner.read()
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        self.pass(Stage::Write);
        self.inner.write(force_n)
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        self.inner.recover()
    }
}

impl<R: Render, C: Clock> Render for Delayed<R, C> {
    fn tick(&mut self, sample: &Sample) -> Output {
        self.pass(Stage::Compute);
        self.inner.tick(sample)
    }

    fn config(&self) -> &Config {
        self.inner.config()
    }

    fn counters(&self) -> Counters {
        self.inner.counters()
    }

    fn exchanges(&self) -> u32 {
        self.inner.exchanges()
    }
}
