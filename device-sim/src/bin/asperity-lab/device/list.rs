//! `asperity-lab device list`: what is plugged in, and what to do if it cannot be used.

use std::path::PathBuf;

use asperity::console::Console;
use asperity::diagnostic::{Failures, one};
use asperity_host::device::usb::scan::{Access, Found, refuse, scan};
use asperity_host::device::usb::watch::{Event, watch};
use asperity_host::device::usb::{Ids, Kind, permission};
use serde_json::{Value, json};

use super::failure;

/// List the haptic devices on USB
///
/// Devices whose ids are known are opened for a moment to see whether this user may use them.
/// Nothing is sent to them but the requests that every USB device answers.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device list
  asperity-lab device list --all --json
  asperity-lab device list --rules | sudo tee /etc/udev/rules.d/70-asperity.rules

A list of ids (--ids) is a TOML file of tables such as
  [[device]]
  vendor = 0x0403
  product = 0xcb48
  kind = \"falcon\"      # or \"touch\"
  name = \"Novint Falcon\"")]
pub(crate) struct Arguments {
    /// List devices that are none of ours as well
    #[arg(long)]
    all: bool,
    /// Use another list of USB ids
    #[arg(long, value_name = "TOML")]
    ids: Option<PathBuf>,
    /// Print the udev rules that let a user open these devices, and nothing else
    #[arg(long, conflicts_with_all = ["all", "json", "watch"])]
    rules: bool,
    /// Go on, and tell what is plugged in and out
    #[arg(long, conflicts_with = "json")]
    watch: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let ids = Ids::load(arguments.ids.as_deref());
    let ids = ids.map_err(|error| failure(&error, error.remedy()))?;
    if arguments.rules {
        return console.text(&permission::rules(&ids)).map_err(one);
    }
    if arguments.watch {
        return follow(&ids, console);
    }
    let found = scan(&ids).map_err(|error| failure(&error, error.remedy()))?;
    let ours = |found: &&Found| arguments.all || found.kind.is_some();
    let shown: Vec<&Found> = found.iter().filter(ours).collect();
    if arguments.json {
        let devices: Vec<Value> = shown.iter().map(|found| value(found)).collect();
        let none = nothing(&found);
        let mut value = json!({ "devices": devices });
        if !found.iter().any(|found| found.kind.is_some()) {
            value["problem"] = none.0.into();
            value["remedy"] = none.1.into();
        }
        return super::json(console, &value);
    }
    let mut text = String::new();
    if !found.iter().any(|found| found.kind.is_some()) {
        let (problem, remedy) = nothing(&found);
        text += &format!("{problem}\n  help: {remedy}\n");
    }
    for found in shown {
        text += &line(found);
    }
    text += "Without USB: sim:, null:, replay:FILE, openhaptics:, dhd:\n";
    console.text(&text).map_err(one)
}

fn follow(ids: &Ids, console: Console) -> Result<(), Failures> {
    let mut printed = Ok(());
    let each = |event: Option<Event>| {
        let text = match event {
            None => return true,
            Some(Event::Arrived(found)) => format!("+ {}", line(&found)),
            Some(Event::Left(found)) => format!("- {}\n", found.place()),
        };
        printed = console.text(&text);
        printed.is_ok()
    };
    watch(ids, each).map_err(|error| failure(&error, error.remedy()))?;
    printed.map_err(one)
}

/// What there is to say where no device of ours is.
fn nothing(found: &[Found]) -> (String, String) {
    let others = found.len();
    (
        format!("no haptic device is plugged in ({others} other devices on USB)"),
        "plug it in and switch its power on; `--all` lists everything, and if yours is there under \
         other ids, put them into a list for --ids"
            .into(),
    )
}

/// The name to open a device by, if it can be opened over USB.
fn uri(found: &Found) -> Option<String> {
    let which = found.serial.clone();
    let which = which.unwrap_or_else(|| format!("{}-{}", found.bus, found.address));
    match found.kind? {
        Kind::Falcon => Some(format!("falcon:{which}")),
        Kind::Touch => Some(format!("touch:{which}")),
    }
}

fn state(found: &Found) -> (&'static str, String) {
    match (&found.access, found.kind) {
        (Access::Ready, Some(Kind::Touch)) => (
            "identified",
            "identified; forces go through its vendor's library: openhaptics:".into(),
        ),
        (Access::Ready, _) => (
            "ready",
            format!("ready: {}", uri(found).unwrap_or_default()),
        ),
        (Access::NotPermitted, _) => ("not_permitted", "this user may not open it".into()),
        (Access::InUse, _) => ("in_use", "in use by another program or driver".into()),
        (Access::Failed(problem), _) => ("failed", format!("cannot be opened: {problem}")),
        (Access::Unknown, _) => ("unknown", "none of ours; not opened".into()),
    }
}

fn line(found: &Found) -> String {
    let serial = found.serial.as_deref().unwrap_or("no serial number");
    let mut text = format!(
        "{}  {:04x}:{:04x}  {}  {}\n  {}\n",
        found.name,
        found.vendor,
        found.product,
        serial,
        found.node(),
        state(found).1
    );
    if let Err(error) = refuse(found, &found.access) {
        text += &format!("  help: {}\n", error.remedy());
    }
    text
}

pub(super) fn value(found: &Found) -> Value {
    let mut value = json!({
        "name": found.name,
        "kind": found.kind,
        "vendor": format!("{:04x}", found.vendor),
        "product": format!("{:04x}", found.product),
        "serial": found.serial,
        "node": found.node(),
        "uri": uri(found),
        "state": state(found).0,
    });
    if let Err(error) = refuse(found, &found.access) {
        value["problem"] = error.to_string().into();
        value["remedy"] = error.remedy().into();
    }
    value
}
