//! The rule that lets a user open a device on Linux.

use super::ids::Ids;

/// Where the rule belongs. Its number is below 73, at which systemd gives devices to the person at
/// the screen.
pub const RULES_FILE: &str = "/etc/udev/rules.d/70-asperity.rules";

/// The rules for all ids of a list: the file's whole text.
#[must_use]
pub fn rules(ids: &Ids) -> String {
    let mut text =
        String::from("# Haptic devices for the person at the screen and for group plugdev.\n");
    for id in &ids.devices {
        text += &format!(
            "SUBSYSTEM==\"usb\", ENV{{DEVTYPE}}==\"usb_device\", ATTR{{idVendor}}==\"{:04x}\", \
             ATTR{{idProduct}}==\"{:04x}\", MODE=\"0660\", GROUP=\"plugdev\", TAG+=\"uaccess\"\n",
            id.vendor, id.product
        );
    }
    text
}

/// Returns a remedy for a device that this user may not open.
#[must_use]
pub fn remedy() -> String {
    if cfg!(target_os = "linux") {
        format!(
            "install the udev rule: `asperity-lab device list --rules | sudo tee {RULES_FILE}`, then \
             `sudo udevadm control --reload && sudo udevadm trigger`, and plug the device out and in"
        )
    } else if cfg!(windows) {
        "install the WinUSB driver for the device, with Zadig for instance".into()
    } else {
        "run the command as a user who may open USB devices".into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_id_has_a_rule() {
        let ids = Ids::built_in().expect("the list");
        let rules = rules(&ids);
        assert_eq!(rules.lines().count(), 1 + ids.devices.len());
        assert!(rules.contains("ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\""));
        assert!(rules.lines().skip(1).all(|rule| rule.contains("uaccess")));
    }
}
