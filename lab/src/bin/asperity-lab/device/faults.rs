//! `asperity-lab device faults`: every fault on a device, and what becomes of its force.

use std::time::Duration;

use asperity_console::Console;
use asperity_formats::Asset;
use asperity_host::device::Scheme;
use asperity_host::device::fault_injection::InjectedFault;
use asperity_host::device::fault_injection::trial::{FaultResponse, Paced, Trial};
use asperity_io::diagnostic::{Failures, one};
use asperity_io::shown::counted;
use asperity_lab::servo_session;
use asperity_runtime::{Config, HostTexture};
use serde_json::json;

use super::probe::parse;
use crate::error::Plain;
use crate::loop_options::within;

/// Inject every kind of fault while a device is in contact, and record the force
///
/// The surface of the built-in texture is placed above the position of the device, which you must
/// hold still. Each fault lasts 20 periods, followed by 400 periods in which the force must return.
/// Faults are injected between the device and the loop; the device and its bus are real. A period is
/// one answer of the device. The exit status is 1 if a requirement was violated.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device faults null:
  asperity-lab device faults sim:?grip=firm&time=stepped
  asperity-lab device faults 'falcon:?firmware=falcon.bin' --peak-n 1 --json > faults.json

The table has the form of those in docs/faults.md.")]
pub(crate) struct Arguments {
    /// Device to test, such as falcon: or openhaptics:
    #[arg(value_name = "URI")]
    uri: String,
    /// Force limit, N (0.1 to 8.9), or the limit of the device if that is lower
    #[arg(long, value_name = "N", default_value_t = 1.0, value_parser = within(0.1_f32..=8.9, " N"))]
    peak_n: f32,
    /// Initial depth of the device in the surface, mm (1 to 60)
    #[arg(long, value_name = "MM", default_value_t = 5.0, value_parser = within(1.0_f32..=60.0, " mm"))]
    depth_mm: f32,
    /// Timeout for the first position, s (1 to 600); homing a Falcon takes a while
    #[arg(long, value_name = "S", default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..=600))]
    patience: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Times that a fault is tried where others of the bus came between.
const TRIES: u32 = 5;
/// Periods before a fault.
const WARM_UP: u32 = 300;

/// Gives whether every promise was kept.
pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<bool, Failures> {
    let uri = parse(&arguments.uri)?;
    if uri.scheme == Scheme::Touch {
        return Err(Plain::failure(
            "a Touch cannot be driven over USB, because its protocol is not public",
            "install the vendor's OpenHaptics and its driver, and use `openhaptics:`",
        ));
    }
    let bug = |error: &dyn std::fmt::Display| Plain::failure(error, "report this as a bug");
    let lowered =
        asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None).map_err(one)?;
    let asset = Asset::parse(&lowered.bytes).map_err(|error| bug(&error))?;
    let mut texture = Box::new(HostTexture::new());
    let mut config = Config::default();
    let loaded = texture.load(&asset, config.servo_rate_hz);
    loaded.map_err(|error| bug(&error))?;
    let mut opened = servo_session::open(&uri, config.servo_rate_hz as u32).map_err(one)?;
    let description = opened.device.description().clone();
    config.mechanics = opened.mechanics;
    config.limits.peak_n = if arguments.peak_n < description.peak_force_n {
        arguments.peak_n
    } else {
        description.peak_force_n
    };
    let activity = console.activity();
    activity.set_message("waiting for a position; hold the device where you want the surface");
    let patience = Duration::from_secs(arguments.patience);
    let begun = Paced::begin(&mut *opened.device, 1e-3 * arguments.depth_mm, patience);
    let mut device = begun.map_err(|fault| {
        Plain::failure(
            format!("{} gives no position: {fault}", description.name),
            "see `asperity-lab device probe`, or give a longer --patience",
        )
    })?;
    let trial = Trial {
        texture: &texture,
        config: &config,
        warm_up: WARM_UP,
        seed: 1,
    };
    let mut rows = Vec::new();
    for kind in InjectedFault::ALL {
        activity.set_message(format!("{}: hold still", kind.name()));
        let mut row = FaultResponse::default();
        for _ in 0..TRIES {
            row = trial
                .run(&mut device, kind, |_| ())
                .map_err(|error| bug(&error))?;
            if row.disturbed == 0 {
                break;
            }
        }
        rows.push((kind, row));
    }
    activity.finish_and_clear();
    let slew_n = config.limits.slew_n_s / config.servo_rate_hz;
    let broken = |kind, row: &FaultResponse| row.broken(kind, config.limits.peak_n, slew_n);
    let kept = rows
        .iter()
        .all(|(kind, row)| row.disturbed > 0 || broken(*kind, row).is_none());
    let pressed = rows.iter().all(|(_, row)| row.before_n > 0.0) || uri.scheme == Scheme::Null;
    if arguments.json {
        let values: Vec<_> = rows
            .iter()
            .map(|(kind, row)| json!({ "fault": kind.name(), "row": row, "broken": broken(*kind, row) }))
            .collect();
        let value = json!({
            "uri": uri.to_string(), "device": description.name, "peak_n": config.limits.peak_n,
            "slew_n": slew_n, "faults": values, "unconfirmed": description.unconfirmed,
        });
        super::json(console, &value)?;
    } else {
        console
            .text(&table(&description.name, &rows, broken))
            .map_err(one)?;
    }
    if !pressed {
        console.warn("there was no contact before some faults: hold the device still, or give a larger --depth-mm");
    }
    if rows.iter().any(|(_, row)| row.disturbed > 0) {
        console
            .warn("the device had other faults as well; the rows that list them are inconclusive");
    }
    Ok(kept)
}

/// The rows in the form of docs/faults.md.
fn table(
    name: &str,
    rows: &[(InjectedFault, FaultResponse)],
    broken: impl Fn(InjectedFault, &FaultResponse) -> Option<&'static str>,
) -> String {
    let lines = rows.iter().map(|(kind, row)| row.line(*kind, name));
    let mut text: String = std::iter::once(FaultResponse::TABLE_HEAD.to_owned())
        .chain(lines)
        .collect();
    for (kind, row) in rows {
        if row.disturbed > 0 {
            text += &format!(
                "{}: {} not injected\n",
                kind.name(),
                counted(row.disturbed, "fault that was", "faults that were")
            );
        } else if let Some(promise) = broken(*kind, row) {
            text += &format!("{}: violated: {promise}\n", kind.name());
        }
    }
    text
}
