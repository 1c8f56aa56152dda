//! `asperity-lab device exercise`: a texture on a device, every tick counted.

use asperity_console::Console;
use asperity_formats::Asset;
use asperity_host::device::exercise::{Plan, exercise};
use asperity_host::device::falcon::on_usb;
use asperity_host::device::{Device, Scheme};
use asperity_io::diagnostic::{Failures, one};
use asperity_io::shown::counted;
use asperity_lab::servo_session;
use asperity_runtime::{Config, HostTexture};
use serde_json::json;

use super::{failure, probe::parse};
use crate::error::Plain;

/// Run the built-in texture on a device and count the outcome of every tick
///
/// The exit status is 1 if a force exceeded the limits, or if the device was lost for good. For a
/// real-time loop, use `asperity-lab servo`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device exercise sim:?time=stepped
  asperity-lab device exercise falcon: --ticks 10000
  asperity-lab device exercise 'falcon:?firmware=falcon.bin' --peak-n 2 --json > report.json")]
pub(crate) struct Arguments {
    /// Device to run on, such as falcon: or sim:
    #[arg(value_name = "URI")]
    uri: String,
    /// Number of ticks
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    ticks: u32,
    /// Ticks per second; 0 waits for an answer of the device in every tick
    #[arg(long, default_value_t = 1000.0, value_parser = rate)]
    rate: f64,
    /// Force limit, N
    #[arg(long, default_value_t = 3.3, value_parser = peak)]
    peak_n: f32,
    /// Seed of the texture's excitation
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

fn rate(text: &str) -> Result<f64, String> {
    let value = text
        .parse()
        .ok()
        .filter(|value| (0.0..=10_000.0).contains(value));
    value.ok_or_else(|| "must be 0 to 10,000 Hz".into())
}

fn peak(text: &str) -> Result<f32, String> {
    let value = text
        .parse()
        .ok()
        .filter(|value| (0.1..=8.9).contains(value));
    value.ok_or_else(|| "must be 0.1 to 8.9 N".into())
}

/// Gives whether every force was within its limits.
pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<bool, Failures> {
    let uri = parse(&arguments.uri)?;
    if uri.scheme == Scheme::Touch {
        return Err(super::touch_cannot_be_driven());
    }
    let lowered =
        asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None).map_err(one)?;
    let bug = |error: &dyn std::fmt::Display| Plain::failure(error, "report this as a bug");
    let asset = Asset::parse(&lowered.bytes).map_err(|error| bug(&error))?;
    let mut texture = Box::new(HostTexture::new());
    let rate_hz = Config::default().servo_rate_hz;
    texture.load(&asset, rate_hz).map_err(|error| bug(&error))?;
    // A Falcon counts its transfers as well.
    let (mut falcon, mut other) = (None, None);
    let mut mechanics = Config::default().mechanics;
    let device: &mut dyn Device = if uri.scheme == Scheme::Falcon {
        let opened = on_usb::open(&uri).map_err(|error| failure(&error, error.remedy()))?;
        falcon.insert(opened)
    } else {
        let opened = servo_session::open(&uri, rate_hz as u32).map_err(one)?;
        let opened = other.insert(opened);
        mechanics = opened.mechanics;
        &mut *opened.device
    };
    let name = device.description().name.clone();
    let plan = Plan {
        mechanics,
        ticks: arguments.ticks,
        rate_hz: arguments.rate,
        peak_n: arguments.peak_n,
        seed: arguments.seed,
        patience: 600,
    };
    let activity = console.activity();
    activity.set_message(if uri.scheme == Scheme::Falcon {
        "a texture on the device; pull the grip out and push it in once".to_owned()
    } else {
        format!("a texture on {name}")
    });
    let report = exercise(device, &texture, &plan, |_, _| ()).map_err(|error| bug(&error))?;
    activity.finish_and_clear();
    if arguments.json {
        let link = falcon.as_ref().map(|falcon| {
            let counts = falcon.counts();
            json!({
                "sent": counts.sent, "received": counts.received, "stalled": counts.stalled,
                "short": counts.short, "timed_out": counts.timed_out, "failed": counts.failed,
                "skipped_bytes": counts.skipped_bytes, "servo_silent": counts.servo_silent,
            })
        });
        let value = json!({ "uri": arguments.uri, "report": report, "link": link });
        super::json(console, &value)?;
    } else {
        let mut text = format!(
            "{} in {:.1} s: {} with a new position, {} without; {} in contact, {} in the safe state\n",
            counted(report.ticks, "tick", "ticks"),
            report.seconds,
            report.fresh,
            report.stale,
            report.contact,
            report.safe
        );
        for (fault, count) in &report.faults {
            text += &format!("  {count} × {fault}\n");
        }
        text += &format!(
            "  {} rejected; device lost and recovered {}\n  forces: at most {:.2} N of {:.2} N, \
             steps of at most {:.2} N of {:.2} N per tick; {} beyond the limits\n",
            counted(report.lost_writes, "command", "commands"),
            counted(report.recovered, "time", "times"),
            report.largest_force_n,
            report.peak_n,
            report.largest_step_n,
            report.step_n,
            report.beyond_limits,
        );
        if report.lost {
            text += "  the device was lost and did not come back\n";
        }
        console.text(&text).map_err(one)?;
    }
    Ok(report.beyond_limits == 0 && !report.lost)
}
