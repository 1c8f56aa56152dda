//! `asperity-lab device list`: what is plugged in, and what to do if it cannot be used.

use std::path::PathBuf;

use asperity_console::Console;
use asperity_host::device::usb::scan::scan;
use asperity_host::device::usb::{Ids, permission};
use asperity_io::diagnostic::{Failures, one};

use super::failure;
use super::inventory::{Inventory, libraries};

/// List the devices that can be opened: on USB, through vendor libraries, and simulated ones
///
/// Devices with known ids are opened briefly to check the permissions of this user. They receive
/// only the standard requests that every USB device answers. Vendor libraries are loaded briefly,
/// without calling any of their functions.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device list
  asperity-lab device list --all --json
  asperity-lab device list --rules | sudo tee /etc/udev/rules.d/70-asperity.rules

A list of ids (--ids) is a TOML file with tables such as
  [[device]]
  vendor = 0x0403
  product = 0xcb48
  kind = \"falcon\"      # or \"touch\"
  name = \"Novint Falcon\"")]
pub(crate) struct Arguments {
    /// Also list USB devices that are not known haptic devices
    #[arg(long)]
    all: bool,
    /// Use this list of USB ids instead of the built-in one
    #[arg(long, value_name = "TOML")]
    ids: Option<PathBuf>,
    /// Only print the udev rules that let a user open these devices
    #[arg(long, conflicts_with_all = ["all", "json"])]
    rules: bool,
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
    let inventory = Inventory {
        usb: scan(&ids),
        libraries: libraries(),
        all: arguments.all,
    };
    if arguments.json {
        super::json(console, &inventory.value())
    } else {
        console.text(&inventory.text()).map_err(one)
    }
}
