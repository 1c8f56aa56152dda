//! Options of the commands that run a servo loop.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::time::Duration;

use asperity_console::on_interrupt;
use asperity_host::device::Uri;
use asperity_host::profile::Profile;
use asperity_host::servo::privileges::{Grant, Policy, PrivilegeRequest};
use asperity_host::servo::{Monotonic, Overrun, Settings};
use asperity_io::diagnostic::{Failures, one};
use asperity_lab::servo_session::{OpenDevice, ServoSessionError, Surface, open};

#[derive(Debug, clap::Args)]
pub(crate) struct LoopOptions {
    /// Texture (.asp), library (.aspl) or scene [default: the built-in texture]
    pub(crate) file: Option<PathBuf>,
    /// Texture of a library, by name or index from 0
    #[arg(long, value_name = "NAME", requires = "file")]
    pub(crate) texture: Option<String>,
    /// Device profile, TOML: limits, mechanics, and the filter that flattens its response, which is
    /// applied to the texture at load
    #[arg(long, value_name = "TOML")]
    pub(crate) profile: Option<PathBuf>,
    /// Servo rate, 250 to 10000 Hz [default: the rate of the texture's models]
    #[arg(long, value_name = "HZ", value_parser = clap::value_parser!(u32).range(250..=10_000))]
    pub(crate) rate: Option<u32>,
    /// Policy for missed periods
    #[arg(long, value_enum, default_value = "skip")]
    pub(crate) overrun: OverrunName,
    /// Scheduling policy: other, fifo, fifo:PRIORITY, deadline or deadline:PERCENT
    #[arg(long, value_name = "POLICY", default_value = "fifo")]
    pub(crate) policy: Policy,
    /// Pin the loop to this processor
    #[arg(long, value_name = "N")]
    pub(crate) cpu: Option<usize>,
    /// Wake this many µs early and busy-wait until the period begins (0 to 1000)
    #[arg(long, value_name = "US", default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=1000))]
    pub(crate) spin: u64,
    /// Do not lock memory
    #[arg(long)]
    pub(crate) no_lock: bool,
    /// Let processors enter deep idle states
    #[arg(long)]
    pub(crate) deep_idle: bool,
    /// Seed of the texture's excitation [default: that of a replayed recording, or else 1]
    #[arg(long)]
    pub(crate) seed: Option<u64>,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub(crate) enum OverrunName {
    /// Skip them; the next sample carries their number
    Skip,
    /// Run the missed ticks back to back
    CatchUp,
    /// Stop the loop
    Stop,
}

impl LoopOptions {
    pub(crate) fn surface(&self) -> Result<Surface, Failures> {
        self.read().map_err(one)
    }

    /// Reads the surface from its file as it is now, compensated for the device's profile.
    pub(crate) fn read(&self) -> Result<Surface, ServoSessionError> {
        let surface = match &self.file {
            None => Surface::built_in(),
            Some(path) => Surface::read(path, self.texture.as_deref()),
        }?;
        self.compensated(surface)
    }

    /// A surface in the voice of the device's profile, where one was given.
    pub(crate) fn compensated(&self, surface: Surface) -> Result<Surface, ServoSessionError> {
        match self.profile()?.and_then(|profile| profile.compensation) {
            Some(filter) => surface.compensated(&filter),
            None => Ok(surface),
        }
    }

    fn profile(&self) -> Result<Option<Profile>, ServoSessionError> {
        let path = self.profile.as_deref();
        Ok(path.map(Profile::load).transpose()?)
    }

    /// Opens a device, and says at which rate it runs: a recording at its own.
    pub(crate) fn open_device(
        &self,
        uri: &Uri,
        surface: &Surface,
    ) -> Result<(OpenDevice, u32), Failures> {
        let asked_hz = self.rate.unwrap_or_else(|| surface.rate_hz());
        // Nothing is opened for a profile that is refused.
        let profile = self.profile().map_err(one)?;
        let opened = OpenDevice {
            profile,
            ..open(uri, asked_hz).map_err(one)?
        };
        let Some(replayed) = &opened.replayed else {
            return Ok((opened, asked_hz));
        };
        let recorded_hz = replayed.conditions.config.servo_rate_hz;
        if self.rate.is_some_and(|rate| rate as f32 != recorded_hz) {
            return Err(one(ServoSessionError::RecordedRate {
                recorded_hz,
                asked_hz,
            }));
        }
        // A rate that no loop has is refused when the loop begins.
        Ok((opened, recorded_hz as u32))
    }

    /// Opens a device on which nothing is rendered, at 1 kHz unless a rate was asked for.
    pub(crate) fn open_unfelt(&self, uri: &Uri) -> Result<(OpenDevice, u32), Failures> {
        let rate_hz = self.rate.unwrap_or(1000);
        let profile = self.profile().map_err(one)?;
        let opened = open(uri, rate_hz).map_err(one)?;
        Ok((OpenDevice { profile, ..opened }, rate_hz))
    }

    /// Seed of the excitation on a desk.
    pub(crate) fn seed(&self, opened: &OpenDevice) -> u64 {
        let recorded = opened.replayed.as_ref();
        self.seed
            .unwrap_or_else(|| recorded.map_or(1, |replayed| replayed.conditions.seed))
    }

    pub(crate) fn settings(
        &self,
        opened: &OpenDevice,
        rate_hz: u32,
        seconds: Option<f64>,
    ) -> Settings {
        Settings {
            overrun: match self.overrun {
                OverrunName::Skip => Overrun::Skip,
                OverrunName::CatchUp => Overrun::CatchUp,
                OverrunName::Stop => Overrun::Stop,
            },
            periods: seconds.map(|seconds| (seconds * f64::from(rate_hz)).round() as u64),
            pace: opened.pace.clone(),
            ..Settings::at(rate_hz)
        }
    }

    pub(crate) fn clock(&self) -> Monotonic {
        Monotonic::spinning(Duration::from_micros(self.spin))
    }

    pub(crate) fn privileges(&self) -> PrivilegeRequest {
        PrivilegeRequest {
            policy: self.policy,
            lock_memory: !self.no_lock,
            cpu: self.cpu,
            shallow_idle: !self.deep_idle,
        }
    }
}

/// Returns a line for each request that the system refused.
pub(crate) fn refusals(grants: &[Grant]) -> Vec<String> {
    let refused = grants.iter().filter_map(|grant| {
        let refusal = grant.refusal.as_ref()?;
        Some(format!(
            "{} ({}) was refused: {}; {}",
            grant.what, grant.wanted, refusal.why, refusal.remedy
        ))
    });
    refused.collect()
}

/// Flags for interrupts (Ctrl-C, a request to terminate).
#[derive(Debug, Clone, Default)]
pub(crate) struct Interrupt {
    /// Set by the first one: the loop is to end.
    pub(crate) stop: Arc<AtomicBool>,
    /// To be set when the device is released. Another interrupt then ends the program at once,
    /// such as while it waits for a disk.
    pub(crate) released: Arc<AtomicBool>,
}

/// Watches for interrupts.
pub(crate) fn stop_on_interrupt() -> Result<Interrupt, Failures> {
    let interrupt = Interrupt::default();
    let set = interrupt.clone();
    on_interrupt(move || {
        let again = set.stop.swap(true, Relaxed);
        if again && set.released.load(Relaxed) {
            asperity_io::output::clean_up_and_exit();
        }
    })
    .map_err(one)?;
    Ok(interrupt)
}

/// Parses a number within a range, in a unit that begins with a space.
pub(crate) fn within<T>(
    range: RangeInclusive<T>,
    unit: &'static str,
) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: Clone + Display + FromStr + PartialOrd,
{
    move |text| {
        let value = text.parse().ok().filter(|value| range.contains(value));
        value.ok_or_else(|| format!("must be {} to {}{unit}", range.start(), range.end()))
    }
}
