//! Which USB ids are which device: a list that a user can replace.

use std::io::Read as _;
use std::path::Path;

use crate::regular_file;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Kinds of devices that USB tells apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DeviceKind {
    /// A Novint Falcon.
    Falcon,
    /// A 3D Systems Touch.
    Touch,
}

/// A device's ids.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownId {
    /// Vendor id.
    pub vendor: u16,
    /// Product id.
    pub product: u16,
    /// Kind of the device.
    pub kind: DeviceKind,
    /// Name for reports.
    pub name: String,
}

/// A list of ids.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ids {
    /// All of them.
    #[serde(rename = "device")]
    pub devices: Vec<KnownId>,
}

/// Why a list was refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}: {problem}")]
pub struct IdsError {
    /// The file.
    pub file: String,
    /// Description of the defect.
    pub problem: String,
}

/// Largest list that is read, bytes.
const MAX_BYTES: u64 = 64 * 1024;

impl Ids {
    /// The list that is built in.
    ///
    /// # Errors
    /// None in a build whose tests pass.
    pub fn built_in() -> Result<Self, IdsError> {
        Self::parse(include_str!("ids.toml"), "ids.toml")
    }

    /// A list from a file, or the built-in one.
    ///
    /// # Errors
    /// [`IdsError`].
    pub fn load(file: Option<&Path>) -> Result<Self, IdsError> {
        let Some(path) = file else {
            return Self::built_in();
        };
        let file = path.display().to_string();
        let refuse = |problem: String| IdsError {
            file: file.clone(),
            problem,
        };
        let mut text = String::new();
        let opened = regular_file::open(path).map_err(|error| refuse(error.to_string()))?;
        let read = opened.take(MAX_BYTES + 1).read_to_string(&mut text);
        read.map_err(|error| refuse(error.to_string()))?;
        if text.len() as u64 > MAX_BYTES {
            return Err(refuse(format!("more than {MAX_BYTES} bytes")));
        }
        Self::parse(&text, &file)
    }

    /// A list from TOML.
    ///
    /// # Errors
    /// [`IdsError`].
    pub fn parse(text: &str, file: &str) -> Result<Self, IdsError> {
        toml::from_str(text).map_err(|error| IdsError {
            file: file.into(),
            problem: error.to_string().trim().replace('\n', " "),
        })
    }

    /// Returns the device with these ids.
    #[must_use]
    pub fn find(&self, vendor: u16, product: u16) -> Option<&KnownId> {
        let same = |id: &&KnownId| (id.vendor, id.product) == (vendor, product);
        self.devices.iter().find(same)
    }
}

impl IdsError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> String {
        "write a [[device]] table with vendor = 0x0403, product = 0xcb48, kind = \"falcon\" or \
         \"touch\" and a name for each id"
            .into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_knows_the_falcon_and_three_touches() {
        let ids = Ids::built_in().expect("the list");
        let kind = |vendor, product| ids.find(vendor, product).map(|id| id.kind);
        assert_eq!(kind(0x0403, 0xcb48), Some(DeviceKind::Falcon));
        for (vendor, product) in [(0x0301, 0x2988), (0x2988, 0x0302), (0x2988, 0x0304)] {
            assert_eq!(kind(vendor, product), Some(DeviceKind::Touch));
        }
        // Any other device with that serial chip is none of ours.
        assert_eq!(kind(0x0403, 0x6001), None);
    }

    #[test]
    fn a_wrong_list_is_refused_with_its_place() {
        for (text, word) in [
            ("[[device]]\nvendor = 70000\n", "70000"),
            (
                "[[device]]\nvendor = 1\nproduct = 2\nkind = \"omega\"\nname = \"x\"",
                "omega",
            ),
            (
                "[[device]]\nvendor = 1\nproduct = 2\nkind = \"touch\"\n",
                "name",
            ),
            ("devices = 3", "devices"),
        ] {
            let error = Ids::parse(text, "mine.toml").expect_err(text);
            let shown = error.to_string();
            assert!(
                shown.contains("mine.toml") && shown.contains(word),
                "{shown}"
            );
        }
        let missing = Ids::load(Some(Path::new("/nowhere.toml"))).expect_err("no file");
        assert!(missing.to_string().starts_with("/nowhere.toml"));
    }
}
