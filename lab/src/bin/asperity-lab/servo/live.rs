//! The studio beside a loop: its page shows the ticks live, and has other textures played.

use std::thread;

use asperity_console::Console;
use asperity_host::servo::{Record, Stage};
use asperity_io::diagnostic::{Failures, one, texts};
use asperity_lab::servo_session::Surface;
use asperity_studio::{
    Limits, LiveDevice, LiveStatus, LiveTick, Percentiles, RequestedTexture, Server, show,
};
use hdrhistogram::Histogram;
use tempfile::TempPath;

use super::{Arguments, Page};
use crate::error::Plain;

/// Significant digits of latencies.
const DIGITS: u8 = 3;

/// Live data of a running loop, for the studio.
pub(super) struct Live {
    /// From which the browser opens the page.
    _redirect: Option<TempPath>,
    device: LiveDevice,
    /// Ticks since they were handed over last.
    ticks: Vec<LiveTick>,
    wakeup_ns: Histogram<u64>,
    compute_ns: Histogram<u64>,
    status: LiveStatus,
}

impl Live {
    /// Starts the server of a page on a thread of its own, and opens the page where there is a display.
    ///
    /// # Errors
    /// For what the page cannot read, and a port that cannot be had.
    pub(super) fn start(
        arguments: &Arguments,
        (name, page): Page,
        surface: &Surface,
        device: &str,
        rate_hz: u32,
        console: Console,
    ) -> Result<Self, Failures> {
        let device = LiveDevice::new(device, rate_hz, !surface.is_scene);
        let site = page(device.clone())?;
        let server = Server::bind(arguments.port, site, Limits::default()).map_err(one)?;
        let url = server.url();
        console.aside(&format!("{name}: {url}\n"));
        // Both end with the process.
        let begun = thread::Builder::new()
            .name(name.into())
            .spawn(move || server.run());
        begun.map_err(|error| {
            Plain::failure(
                format!("the thread of the {name} cannot be started: {error}"),
                "end other programs, and try again",
            )
        })?;
        let failed = move |error| {
            let (cause, remedy) = texts(&error);
            console.warn(&format!("{cause}; {remedy}"));
        };
        let redirect = (!arguments.no_open).then(|| show(&url, failed)).flatten();
        // These bounds are those that the type allows with so many digits.
        let histogram = || Histogram::new(DIGITS).unwrap_or_else(|_| unreachable!("3 digits"));
        Ok(Self {
            _redirect: redirect,
            device,
            ticks: Vec::new(),
            wakeup_ns: histogram(),
            compute_ns: histogram(),
            status: LiveStatus::default(),
        })
    }

    /// Takes a tick.
    pub(super) fn take(&mut self, record: &Record) {
        let (sample, output) = (&record.sample, &record.output);
        let ns = |stage| record.times.of(stage).unwrap_or(0);
        // Without a limit of its own, the type takes every value.
        let _ = self.wakeup_ns.record(ns(Stage::WakeUp));
        let _ = self.compute_ns.record(ns(Stage::Compute));
        self.status.missed += record.missed;
        self.ticks.push(LiveTick {
            tick: record.tick,
            position_mm: sample.position_m.map(|x_m| 1e3 * x_m),
            depth_mm: 1e3 * output.depth_m,
            speed_mm_s: output.speed_mm_s,
            normal_force_n: output.normal_force_n,
            vib_m_s2: output.vib_m_s2,
            tap_n: output.tap_n,
            friction_n: output.friction_n,
            force_n: output.force_n,
            flags: output.flags.bits().into(),
            wakeup_us: 1e-3 * ns(Stage::WakeUp) as f32,
        });
    }

    /// Publishes what was taken.
    pub(super) fn hand_over(&mut self) {
        self.device.publish(&self.ticks, &self.status);
        self.ticks.clear();
    }

    /// Renews what is said of the loop as a whole; `playing` is the texture that plays.
    pub(super) fn summarise(&mut self, playing: &str) {
        playing.clone_into(&mut self.status.playing);
        self.status.wakeup_us = percentiles(&self.wakeup_ns);
        self.status.compute_us = percentiles(&self.compute_ns);
    }

    /// The texture that the page wants played.
    pub(super) fn wanted(&self) -> Option<RequestedTexture> {
        self.device.wanted()
    }

    /// Says something on the page.
    pub(super) fn say(&self, text: &str) {
        self.device.say(text);
    }

    /// The loop is over.
    pub(super) fn end(&mut self) {
        self.hand_over();
        self.device.end();
    }
}

fn percentiles(ns: &Histogram<u64>) -> Percentiles {
    let at = |share| 1e-3 * ns.value_at_quantile(share) as f64;
    Percentiles {
        p50: at(0.5),
        p99: at(0.99),
        p99_9: at(0.999),
        max: 1e-3 * ns.max() as f64,
    }
}
