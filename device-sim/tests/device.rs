//! `asperity-lab device` as a user sees it where no device is needed. `.ci/check-usb` shows the
//! states of a device.

use std::io::{BufRead as _, BufReader, Read as _};
use std::process::{Command, Output, Stdio};

use asperity_virtual_usb::usbip::client::Client;

fn lab(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity-lab"))
        .arg("device")
        .args(arguments)
        .output()
        .expect("the command runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn rules_are_printed_for_every_id_of_a_list() {
    let output = lab(&["list", "--rules"]);
    assert!(output.status.success());
    let rules = text(&output.stdout);
    for id in ["0403", "cb48", "0301", "2988", "0302", "0304"] {
        assert!(rules.contains(&format!("==\"{id}\"")), "{id} in {rules}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let list = folder.path().join("mine.toml");
    let one = "[[device]]\nvendor = 0x1234\nproduct = 0xabcd\nkind = \"falcon\"\nname = \"Mine\"\n";
    std::fs::write(&list, one).expect("a list");
    let output = lab(&["list", "--rules", "--ids", &list.display().to_string()]);
    let rules = text(&output.stdout);
    assert!(
        rules.contains("\"abcd\"") && !rules.contains("cb48"),
        "{rules}"
    );
}

#[test]
fn what_is_written_wrongly_is_refused_with_the_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    let list = folder.path().join("wrong.toml");
    std::fs::write(&list, "[[device]]\nvendor = \"x\"\n").expect("a list");
    let list = list.display().to_string();
    for (arguments, status, words) in [
        (&["list", "--ids", &list][..], 1, "vendor"),
        (&["list", "--ids", "/nowhere.toml"], 1, "/nowhere.toml"),
        (&["probe", "phantom:"], 1, "phantom:"),
        (&["probe", "falcon:?colour=red"], 1, "colour"),
        (&["probe", "falcon:?tries=0"], 1, "1 to 100"),
        (&["probe", "sim:"], 1, "not on USB"),
        (&["probe", "--seconds", "1e9"], 2, "0.1 to 60"),
        (&["exercise", "touch:"], 1, "touch:"),
        (&["exercise"], 2, "URI"),
        (&["serve"], 2, "DEVICES"),
        (&["serve", "falcon", "--listen", "nowhere"], 2, "--listen"),
        (&["serve", "falcon", "--faults", "2"], 2, "0 to 1"),
    ] {
        let output = lab(arguments);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{arguments:?}: {said}");
        assert!(said.contains(words), "{arguments:?}: {said}");
        assert!(
            status == 2 || said.contains("  help: "),
            "{arguments:?}: {said}"
        );
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}

#[test]
fn a_server_says_where_it_listens_and_ends_with_its_input() {
    let mut server = Command::new(env!("CARGO_BIN_EXE_asperity-lab"))
        .args(["device", "serve", "falcon", "touch-hid"])
        .args(["--listen", "127.0.0.1:0", "--until-eof"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut output = BufReader::new(server.stdout.take().expect("its output"));
    let mut line = String::new();
    output.read_line(&mut line).expect("a line");
    let address = line
        .trim()
        .strip_prefix("listening at ")
        .expect("the address");
    let list = Client::connect(address).and_then(|mut client| client.list());
    let ids: Vec<_> = list
        .expect("a list")
        .iter()
        .map(|device| device.ids)
        .collect();
    assert_eq!(ids, [(0x0403, 0xcb48), (0x2988, 0x0304)]);
    drop(server.stdin.take());
    let mut rest = String::new();
    output.read_to_string(&mut rest).expect("the summary");
    assert!(server.wait().expect("it ends").success());
    assert!(rest.contains("0 bytes sent to its endpoints"), "{rest}");
}

#[test]
fn a_firmware_for_the_virtual_falcon_goes_to_a_file_or_to_standard_output() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("virtual.bin");
    let output = lab(&["serve", "--firmware-file", &file.display().to_string()]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let bytes = std::fs::read(&file).expect("the firmware");
    assert_eq!(bytes.len(), 8192);
    let output = lab(&["serve", "--firmware-file", "-"]);
    assert_eq!(output.stdout, bytes);
}
