//! `asperity-lab device probe`: whether a device works.

mod report;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use asperity_console::Console;
use asperity_host::device::falcon::on_usb;
use asperity_host::device::touch::{UsbPresentation, identify};
use asperity_host::device::usb::scan::scan;
use asperity_host::device::usb::{DeviceKind, Ids, UsbError};
use asperity_host::device::{Device, DeviceError, Scheme, Uri};
use asperity_io::diagnostic::{Diagnostic as _, Failures, one};
use asperity_io::output::Outputs;
use asperity_io::shown::counted;
use asperity_lab::servo_session::open;
use serde_json::{Value, json};

use super::failure;
use super::inventory::{Inventory, libraries};
use crate::error::{Plain, all};
use crate::loop_options::within;
use report::{Positions, Private, archive};

/// Check whether a device works
///
/// A Falcon is opened, loaded with its firmware if necessary, and sent commands of zero force for
/// two seconds. A Touch on USB is only identified, because its protocol is not public. Any other
/// device is opened, read, and commanded zero force. Without a URI, the devices on USB are probed in
/// turn. The exit status is 1 if any of them does not work.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device probe
  asperity-lab device probe 'falcon:?firmware=falcon.bin&tries=20'
  asperity-lab device probe touch: --json
  asperity-lab device probe openhaptics: -o touch.tar.gz
  asperity-lab device probe openhaptics:?lib=/opt/openhaptics/libHD.so

Settings of falcon: are firmware=FILE, tries=N, peak_n=N, motor_step=COUNTS, ids=TOML.")]
pub(crate) struct Arguments {
    /// Device to probe: falcon:, touch:, openhaptics: or dhd:, optionally followed by a serial number,
    /// a name or BUS-ADDRESS
    #[arg(value_name = "URI")]
    uri: Option<String>,
    /// Duration of the test, s (0.1 to 60) [default: 2, or 60 with --output]
    #[arg(long, value_parser = within(0.1..=60.0, " s"))]
    seconds: Option<f64>,
    /// Write what somebody else needs to help: versions, ids, permissions, rates, settings of this
    /// machine, and every position, but no serial numbers
    #[arg(
        short = 'o',
        long = "output",
        alias = "report",
        value_name = "FILE.tar.gz"
    )]
    report: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Gives whether every device works.
pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<bool, Failures> {
    let uris = match &arguments.uri {
        Some(text) => vec![parse(text)?],
        None => plugged_in()?,
    };
    if arguments.report.is_some() && uris.len() > 1 {
        return Err(Plain::usage(
            "--output is a report of one device, but several are plugged in",
            "name one, as `asperity-lab device list` does",
        ));
    }
    let mut outputs = Outputs::beside::<PathBuf>([]);
    let report = outputs.open_if(arguments.report.as_deref()).map_err(one)?;
    let console = console.beside(&outputs);
    let usual = if report.is_some() { 60.0 } else { 2.0 };
    let seconds = arguments.seconds.unwrap_or(usual);
    let mut well = true;
    let mut values = Vec::new();
    let mut written = Ok(());
    for uri in &uris {
        let mut positions = Positions::new();
        let probed = probe(uri, seconds, &mut positions);
        if let Some(report) = report {
            let bytes = reported(uri, &probed, &positions);
            let bytes = bytes.map_err(|error| Plain::failure(error, "report this as a bug"))?;
            let filled = outputs.fill(report, &bytes);
            written = filled.and_then(|()| outputs.commit()).map_err(one);
            outputs = Outputs::beside::<PathBuf>([]);
        }
        match probed {
            Ok(probed) if arguments.json => values.push(probed.value),
            Ok(probed) => console.text(&probed.text).map_err(one)?,
            Err((problem, remedy)) => {
                well = false;
                if arguments.json {
                    values.push(json!({
                        "uri": uri.to_string(), "works": false,
                        "problem": problem, "remedy": remedy,
                    }));
                } else if uris.len() == 1 {
                    return all([Err(failure(&problem, remedy)), written]).map(|()| well);
                } else {
                    let text = format!("{uri}\n  {problem}\n  help: {remedy}\n");
                    console.text(&text).map_err(one)?;
                }
            }
        }
    }
    let printed = match arguments.json {
        true => super::json(console, &json!({ "devices": values })),
        false => Ok(()),
    };
    all([written, printed]).map(|()| well)
}

pub(super) fn parse(text: &str) -> Result<Uri, Failures> {
    text.parse::<Uri>()
        .map_err(|error| Plain::failure(error, "write for instance `falcon:` or `openhaptics:`"))
}

/// The devices of ours on USB.
fn plugged_in() -> Result<Vec<Uri>, Failures> {
    let refuse = |error: UsbError| failure(&error, error.remedy());
    let ids = Ids::load(None).map_err(|error| refuse(error.into()))?;
    let found = scan(&ids).map_err(refuse)?;
    let uris: Vec<Uri> = found
        .iter()
        .filter_map(|found| {
            Some(Uri {
                scheme: match found.kind? {
                    DeviceKind::Falcon => Scheme::Falcon,
                    DeviceKind::Touch => Scheme::Touch,
                },
                which: format!("{}-{}", found.bus, found.address),
                settings: Vec::new(),
            })
        })
        .collect();
    if uris.is_empty() {
        return Err(refuse(UsbError::NotFound {
            what: "haptic device",
            which: String::new(),
        }));
    }
    Ok(uris)
}

/// The archive of a report: also, and above all, of a device that does not work.
fn reported(
    uri: &Uri,
    probed: &Result<Probed, Problem>,
    positions: &Positions,
) -> std::io::Result<Vec<u8>> {
    let value = match probed {
        Ok(probed) => probed.value.clone(),
        Err((problem, remedy)) => json!({
            "uri": uri.to_string(), "works": false, "problem": problem, "remedy": remedy,
        }),
    };
    let usb = Ids::load(None)
        .map_err(UsbError::from)
        .and_then(|ids| scan(&ids));
    let found = usb
        .iter()
        .flatten()
        .filter_map(|found| found.serial.clone());
    let own = value["serial"].as_str().map(str::to_owned);
    // A device is named by its serial number, or by its place on the bus, which tells nothing.
    let is_place = |which: &str| {
        let numbers = which.split_once('-').map(|(a, b)| [a, b]);
        numbers.is_some_and(|numbers| numbers.iter().all(|number| number.parse::<u8>().is_ok()))
    };
    let named = Some(uri.which.clone());
    let named = named.filter(|which| !which.contains(['/', '.']) && !is_place(which));
    let home = std::env::home_dir().map(|home| home.display().to_string());
    let private = Private::new(found.chain(own).chain(named), home);
    let inventory = Inventory {
        usb,
        libraries: libraries(),
        all: false,
    };
    archive(value, inventory.value(), positions, &private)
}

struct Probed {
    text: String,
    value: Value,
}

type Problem = (String, String);

fn probe(uri: &Uri, seconds: f64, positions: &mut Positions) -> Result<Probed, Problem> {
    match uri.scheme {
        Scheme::Touch => touch(uri),
        _ => driven(uri, seconds, positions),
    }
}

/// Reads a device a thousand times a second and commands no force. A Falcon counts its transfers as well.
fn driven(uri: &Uri, seconds: f64, positions: &mut Positions) -> Result<Probed, Problem> {
    const RATE_HZ: u32 = 1000;
    let (mut falcon, mut other) = (None, None);
    let device: &mut dyn Device = if uri.scheme == Scheme::Falcon {
        let opened = on_usb::open(uri).map_err(|error| (error.to_string(), error.remedy()))?;
        falcon.insert(opened)
    } else {
        let opened = open(uri, RATE_HZ).map_err(|error| (error.to_string(), error.remedy()))?;
        &mut **other.insert(opened.device)
    };
    let begun = Instant::now();
    let (mut readings, mut fresh, mut faults, mut commands) = (0_u64, 0_u64, 0_u64, 0_u64);
    let mut last = Err(DeviceError::TimedOut);
    let mut buttons = 0;
    while begun.elapsed().as_secs_f64() < seconds {
        // A command that fails shows as a fault in the next reading.
        commands += u64::from(device.write([0.0; 3]).is_ok());
        std::thread::sleep(Duration::from_micros(1_000_000 / u64::from(RATE_HZ)));
        readings += 1;
        let read = device.read();
        positions.take(&read);
        match read {
            Ok(reading) => {
                fresh += u64::from(reading.fresh);
                buttons |= reading.buttons;
            }
            Err(_) => faults += 1,
        }
        last = read.map(|reading| reading.position_m);
    }
    let taken_s = begun.elapsed().as_secs_f64();
    let description = device.description().clone();
    let link = falcon.map(|falcon| (falcon.counts(), falcon.homed().count_ones()));
    let answers = link.map_or(fresh, |(counts, _)| counts.received);
    let rate_hz = answers as f64 / taken_s;
    let serial = description.serial.as_deref().unwrap_or("no serial number");
    let position = match (&last, link) {
        (Ok(position_m), _) => {
            let [x, y, z] = position_m.map(|metres| metres * 1e3);
            let pressed: Vec<String> = (0..u32::BITS)
                .filter(|bit| (buttons >> bit) & 1 == 1)
                .map(|bit| (bit + 1).to_string())
                .collect();
            let pressed = match pressed.len() {
                0 => "no button pressed".to_owned(),
                1 => format!("button {} pressed", pressed[0]),
                _ => format!("buttons {} pressed", pressed.join(", ")),
            };
            format!("position {x:.2}, {y:.2}, {z:.2} mm; {pressed}")
        }
        (Err(DeviceError::NotCalibrated), Some((_, homed))) => format!(
            "not homed ({homed} of 3 encoders): pull the grip out as far as it goes, then push it in"
        ),
        (Err(fault), _) => format!("no position: {fault}"),
    };
    let mut text = format!(
        "{}  {serial}\n  {}, {fresh} of them new ({rate_hz:.0} Hz); {}; only zero force was \
         commanded\n  {position}\n  force limits: {:.2} N peak, {:.2} N continuous\n",
        description.name,
        counted(readings, "reading", "readings"),
        counted(faults, "fault", "faults"),
        description.peak_force_n,
        description.continuous_force_n,
    );
    let mut value = json!({
        "uri": uri.to_string(),
        "name": description.name,
        "serial": description.serial,
        "works": answers > 0,
        "readings": readings,
        "fresh": fresh,
        "faults": faults,
        "commands": commands,
        "rate_hz": rate_hz,
        "position_m": last.ok(),
        "buttons": buttons,
        "peak_force_n": description.peak_force_n,
        "continuous_force_n": description.continuous_force_n,
        "unconfirmed": description.unconfirmed,
    });
    if let Some((counts, homed)) = link {
        text += &format!(
            "  the firmware runs; {} to {}; transfers: {} stalled, {} short, {} timed out, {} failed \
             otherwise; {} outside any frame\n",
            counted(answers, "answer", "answers"),
            counted(commands, "command", "commands"),
            counts.stalled,
            counts.short,
            counts.timed_out,
            counts.failed,
            counted(counts.skipped_bytes, "byte", "bytes"),
        );
        for (key, count) in [
            ("answers", answers),
            ("homed", u64::from(homed)),
            ("stalls", counts.stalled),
            ("short", counts.short),
            ("timed_out", counts.timed_out),
            ("failed", counts.failed),
            ("skipped_bytes", counts.skipped_bytes),
        ] {
            value[key] = count.into();
        }
    }
    for sentence in &description.unconfirmed {
        text += &format!("  unconfirmed: {sentence}\n");
    }
    if answers > 0 {
        Ok(Probed { text, value })
    } else if link.is_some() {
        Err((
            "the Falcon answers no command".into(),
            "switch its power off and on, then try again".into(),
        ))
    } else {
        let why = last.err().unwrap_or(DeviceError::TimedOut);
        Err((
            format!("{} gives no position: {why}", description.name),
            "consult the table in docs/vendor.md, and try the vendor's own test program".into(),
        ))
    }
}

fn touch(uri: &Uri) -> Result<Probed, Problem> {
    let refuse = |error: UsbError| (error.to_string(), error.remedy());
    uri.allow(&["ids"])
        .map_err(|error| (error.to_string(), "write `touch:?ids=FILE`".into()))?;
    let ids = Ids::load(uri.setting("ids").map(std::path::Path::new));
    let ids = ids.map_err(|error| refuse(error.into()))?;
    let found = identify(&ids, &uri.which).map_err(refuse)?;
    let face = UsbPresentation::of(&found).sentence();
    let limits =
        "Its protocol is not public: nothing was sent to it, and it cannot be felt over USB.";
    let next = "Install the vendor's OpenHaptics and its driver, and use openhaptics:.";
    let mut value = super::inventory::value(&found);
    value["works"] = true.into();
    value["notes"] = json!([face, limits, next]);
    Ok(Probed {
        text: format!("{}\n  {face}\n  {limits}\n  {next}\n", found.place()),
        value,
    })
}
