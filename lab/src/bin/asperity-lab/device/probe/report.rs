//! Probe report for a user to send in: an archive without serial numbers or user names.

use asperity_host::device::{DeviceError, Reading};
use asperity_host::latency::Machine;
use asperity_io::realtime;
use flate2::{Compression, write::GzEncoder};
use serde_json::{Value, json};
use std::{fmt::Write as _, io, time::Instant};

/// Every position that a device gave.
pub(super) struct Positions {
    begun: Instant,
    text: String,
}

impl Positions {
    pub(super) fn new() -> Self {
        Self {
            begun: Instant::now(),
            text: "t_s,x_m,y_m,z_m,fresh,buttons,fault\n".to_owned(),
        }
    }

    pub(super) fn take(&mut self, read: &Result<Reading, DeviceError>) {
        let t_s = self.begun.elapsed().as_secs_f64();
        // Writing to a string does not fail.
        let _ = match read {
            Ok(reading) => {
                let [x, y, z] = reading.position_m;
                let (fresh, buttons) = (u8::from(reading.fresh), reading.buttons);
                writeln!(self.text, "{t_s:.6},{x},{y},{z},{fresh},{buttons},")
            }
            Err(fault) => writeln!(self.text, "{t_s:.6},,,,,,{fault}"),
        };
    }
}

const README: &str = "\
What `asperity-lab device probe -o` found on a haptic device. Please look through it before you
send it: serial numbers and the path of your home folder are taken out, positions are not.

probe.json     what the device answered, or why it did not
system.json    Asperity, kernel, settings of the machine, devices on USB, vendors' libraries
positions.csv  every position: time in s, metres, whether it was new, buttons, faults
";

/// Words that must not leave the machine, each with what stands in its place.
pub(super) struct Private(Vec<(String, &'static str)>);

impl Private {
    /// The serial numbers of all devices, and the user's home folder.
    pub(super) fn new(serials: impl IntoIterator<Item = String>, home: Option<String>) -> Self {
        let serials = serials.into_iter().map(|serial| (serial, "SERIAL"));
        let home = home.into_iter().map(|home| (home, "~"));
        let mut words: Vec<_> = serials.chain(home).collect();
        // What is shorter than this is no serial number, and would take letters out of words.
        words.retain(|(word, _)| word.len() >= 3);
        // A longer one may hold a shorter one.
        words.sort_by_key(|(word, _)| usize::MAX - word.len());
        Self(words)
    }

    fn taken_out(&self, value: &mut Value) {
        match value {
            Value::String(text) => {
                for (word, instead) in &self.0 {
                    *text = text.replace(word, instead);
                }
            }
            Value::Array(values) => values.iter_mut().for_each(|value| self.taken_out(value)),
            Value::Object(fields) => {
                fields.remove("serial");
                fields.values_mut().for_each(|value| self.taken_out(value));
            }
            _ => {}
        }
    }
}

/// The archive, `.tar.gz`. `inventory` is what can be opened here, as `device list --json` has it.
///
/// # Errors
/// None that memory does not have.
pub(super) fn archive(
    mut probed: Value,
    inventory: Value,
    positions: &Positions,
    private: &Private,
) -> io::Result<Vec<u8>> {
    let mut system = json!({
        "asperity": env!("CARGO_PKG_VERSION"),
        "system": { "os": std::env::consts::OS, "arch": std::env::consts::ARCH },
        "machine": Machine::now(None),
        "settings": realtime::settings(None),
        "inventory": inventory,
    });
    private.taken_out(&mut probed);
    private.taken_out(&mut system);
    let files = [
        ("README.txt", README.to_owned()),
        ("probe.json", format!("{probed:#}\n")),
        ("system.json", format!("{system:#}\n")),
        ("positions.csv", positions.text.clone()),
    ];
    let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::default()));
    for (name, text) in files {
        let mut header = tar::Header::new_ustar();
        header.set_size(text.len() as u64);
        header.set_mode(0o644);
        let path = format!("asperity-probe/{name}");
        archive.append_data(&mut header, path, text.as_bytes())?;
    }
    archive.into_inner()?.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Claim: no serial number and no home folder is left, in whatever text they stand, and all else is.
    #[test]
    fn what_is_private_is_taken_out() {
        let serials = ["AB12".to_owned(), "AB12-7".to_owned(), "1".to_owned()];
        let private = Private::new(serials, Some("/home/ada".into()));
        let mut value = json!({
            "serial": "AB12",
            "uri": "falcon:AB12-7",
            "list": [{ "serial": null, "path": "/home/ada/libHD.so", "rate_hz": 1.5 }],
            "other": "version 1",
        });
        private.taken_out(&mut value);
        let expected = json!({
            "uri": "falcon:SERIAL",
            "list": [{ "path": "~/libHD.so", "rate_hz": 1.5 }],
            "other": "version 1",
        });
        assert_eq!(value, expected);
    }

    #[test]
    fn positions_are_lines_of_a_table() {
        let mut positions = Positions::new();
        positions.take(&Err(DeviceError::TimedOut));
        let rows: Vec<&str> = positions.text.lines().collect();
        assert!(rows.len() == 2 && rows[1].contains(",,,,,,"), "{rows:?}");
    }
}
