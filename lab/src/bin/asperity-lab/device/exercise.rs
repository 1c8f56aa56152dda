//! `asperity-lab device exercise`: a texture on a device, every tick counted.

use asperity_console::Console;
use asperity_formats::Asset;
use asperity_host::device::Scheme;
use asperity_host::device::exercise::{Plan, exercise};
use asperity_host::device::falcon::on_usb;
use asperity_io::diagnostic::{Failures, one};
use asperity_runtime::{Config, HostTexture};
use serde_json::json;

use super::{failure, probe::parse};
use crate::error::Plain;

/// Run the built-in texture on a device and count what becomes of every tick
///
/// The exit status is 1 if a force was beyond the limits, or the device was lost for good. For a
/// loop that keeps time, use `asperity-lab servo`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device exercise falcon: --ticks 10000
  asperity-lab device exercise 'falcon:?firmware=falcon.bin' --peak-n 2 --json > report.json")]
pub(crate) struct Arguments {
    /// Which device: falcon:, with a serial number or BUS-ADDRESS behind the colon
    #[arg(value_name = "URI")]
    uri: String,
    /// Ticks
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    ticks: u32,
    /// Ticks a second; 0 waits for an answer of the device in each
    #[arg(long, default_value_t = 1000.0, value_parser = rate)]
    rate: f64,
    /// Largest force, N
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
    if uri.scheme != Scheme::Falcon {
        return Err(Plain::failure(
            format!("`{}` is not opened over USB", arguments.uri),
            "name a falcon:, or use `asperity-lab servo`",
        ));
    }
    let lowered = asperity::lower::lower(&asperity::builtin::texture(), None).map_err(one)?;
    let bug = |error: &dyn std::fmt::Display| Plain::failure(error, "report this as a bug");
    let asset = Asset::parse(&lowered.bytes).map_err(|error| bug(&error))?;
    let mut texture = Box::new(HostTexture::new());
    let rate_hz = Config::default().servo_rate_hz;
    texture.load(&asset, rate_hz).map_err(|error| bug(&error))?;
    let mut falcon = on_usb::open(&uri).map_err(|error| failure(&error, error.remedy()))?;
    let plan = Plan {
        ticks: arguments.ticks,
        rate_hz: arguments.rate,
        peak_n: arguments.peak_n,
        seed: arguments.seed,
        patience: 600,
    };
    let activity = console.activity();
    activity.set_message("a texture on the device; pull the grip out and push it in once");
    let report = exercise(&mut falcon, &texture, &plan, |_, _| ()).map_err(|error| bug(&error))?;
    activity.finish_and_clear();
    let counts = falcon.counts();
    if arguments.json {
        let value = json!({
            "uri": arguments.uri,
            "report": report,
            "link": {
                "sent": counts.sent, "received": counts.received, "stalled": counts.stalled,
                "short": counts.short, "timed_out": counts.timed_out, "failed": counts.failed,
                "skipped_bytes": counts.skipped_bytes, "servo_silent": counts.servo_silent,
            },
        });
        super::json(console, &value)?;
    } else {
        let mut text = format!(
            "{} ticks in {:.1} s: {} fresh, {} stale; {} in contact, {} in the safe state\n",
            report.ticks, report.seconds, report.fresh, report.stale, report.contact, report.safe
        );
        for (fault, count) in &report.faults {
            text += &format!("  {count} × {fault}\n");
        }
        text += &format!(
            "  {} commands not taken; {} times lost and found again\n  forces: at most {:.2} of \
             {:.2} N, {:.2} of {:.2} N a tick; {} beyond the limits\n",
            report.lost_writes,
            report.recovered,
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
