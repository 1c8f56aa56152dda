//! `asperity-lab device list`: what is plugged in, and what to do if it cannot be used.

use std::path::PathBuf;

use asperity_console::Console;
use asperity_host::device::usb::scan::scan;
use asperity_host::device::usb::watch::{Event, watch};
use asperity_host::device::usb::{Ids, permission};
use asperity_io::diagnostic::{Failures, one};

use super::failure;
use super::inventory::{Inventory, line};

/// List what can be opened: devices on USB, vendors' libraries, simulated ones
///
/// Devices whose ids are known are opened for a moment to see whether this user may use them.
/// Nothing is sent to them but the requests that every USB device answers. Vendors' libraries are
/// loaded for a moment, and none of their functions is called.
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
    let inventory = Inventory {
        usb: scan(&ids),
        libraries: super::inventory::libraries(),
        all: arguments.all,
    };
    if arguments.json {
        super::json(console, &inventory.value())
    } else {
        console.text(&inventory.text()).map_err(one)
    }
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
