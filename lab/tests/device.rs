//! `asperity-lab device` as a user sees it where no device is needed. `.ci/check-usb` shows the
//! states of a device.

use crate::fakes;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use asperity_virtual_usb::usbip::wire::{GRANTED, RECORD, REQUEST_LIST, operation, take};

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
        (&["probe", "sim:nowhere.toml"], 1, "nowhere.toml"),
        (&["probe", "sim:?grip=iron"], 1, "iron"),
        (&["probe", "null:?depth=1"], 1, "depth"),
        (&["probe", "--seconds", "1e9"], 2, "0.1 to 60"),
        (&["faults"], 2, "URI"),
        (&["faults", "touch:"], 1, "over USB"),
        (&["faults", "phantom:"], 1, "phantom:"),
        (&["faults", "null:", "--peak-n", "100"], 2, "0.1 to 8.9"),
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

/// Claim: a report is written of a device that works and of one that does not.
#[test]
fn a_report_holds_versions_settings_and_every_position() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("probe.tar.gz");
    let file = path.display().to_string();
    for (uri, works) in [
        ("sim:?seed=2", true),
        ("openhaptics:?lib=/nowhere/libHD.so", false),
    ] {
        let output = lab(&["probe", uri, "--seconds", "0.3", "--report", &file]);
        assert_eq!(output.status.success(), works, "{}", text(&output.stderr));
        let archive = std::fs::File::open(&path).expect("an archive");
        let mut archive = tar::Archive::new(flate2::read::GzDecoder::new(archive));
        let mut files = std::collections::BTreeMap::new();
        for entry in archive.entries().expect("entries") {
            let mut entry = entry.expect("an entry");
            let name = entry.path().expect("a name").display().to_string();
            let mut content = String::new();
            std::io::Read::read_to_string(&mut entry, &mut content).expect("text");
            files.insert(name.replace("asperity-probe/", ""), content);
        }
        let names: Vec<&str> = files.keys().map(String::as_str).collect();
        assert_eq!(
            names,
            ["README.txt", "positions.csv", "probe.json", "system.json"]
        );
        let json =
            |name: &str| -> serde_json::Value { serde_json::from_str(&files[name]).expect("JSON") };
        assert_eq!(json("probe.json")["works"], works);
        assert!(json("probe.json").get("serial").is_none());
        let system = json("system.json");
        assert!(system["machine"]["kernel"].is_string() && system["settings"].is_array());
        assert!(system["inventory"]["libraries"].is_array());
        let rows = files["positions.csv"].lines().count();
        assert_eq!(rows > 30, works, "{rows} rows");
        std::fs::remove_file(&path).expect("removed");
    }
}

/// The list depends on the machine's USB devices; `.ci/check-usb` and the tests of the list show each state.
#[test]
fn a_list_ends_well_whatever_is_plugged_in_and_a_probe_says_what_to_do() {
    let output = lab(&["list"]);
    let said = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for words in [
        "OpenHaptics HD",
        "Force Dimension SDK",
        "sim:, null:, replay:FILE",
    ] {
        assert!(said.contains(words), "{words} in {said}");
    }
    let value: serde_json::Value =
        serde_json::from_slice(&lab(&["list", "--json"]).stdout).expect("JSON");
    assert_eq!(value["anywhere"][0], "sim:");
    assert_eq!(value["libraries"][0]["uri"], "openhaptics:");
    let works = value["usb"].as_bool().expect("whether there is USB");
    if !works {
        assert!(
            said.contains("USB cannot be used here") && said.contains("  help: "),
            "{said}"
        );
        for arguments in [&["probe"][..], &["probe", "falcon:"], &["probe", "touch:"]] {
            let output = lab(arguments);
            assert_eq!(output.status.code(), Some(1), "{arguments:?}");
            let said = text(&output.stderr);
            assert!(
                said.contains("USB cannot be used here") && said.contains("/dev/bus/usb"),
                "{said}"
            );
            if cfg!(target_os = "linux") && !Path::new("/dev/bus/usb").exists() {
                let so = "cannot be used here: there is no /dev/bus/usb";
                let to_do = "start a container with `--device /dev/bus/usb`";
                assert!(said.contains(so) && said.contains(to_do), "{said}");
            }
        }
    }
}

#[test]
fn devices_without_usb_are_probed_too() {
    let output = lab(&["probe", "null:", "--seconds", "0.1"]);
    let said = text(&output.stdout);
    assert!(
        output.status.success() && said.contains("position 0.00, 0.00, 50.00 mm"),
        "{said}"
    );
    let output = lab(&["probe", "sim:?time=stepped", "--seconds", "0.1", "--json"]);
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(
        output.status.success() && value["devices"][0]["works"] == true,
        "{value}"
    );
}

#[test]
fn a_vendor_library_is_probed_and_what_is_wrong_with_one_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let script = folder.path().join("libHD.so");
    std::fs::write(&script, "#!/bin/sh\n").expect("a file");
    let script = script.display().to_string();
    let mut cases = vec![
        (
            "openhaptics:".to_owned(),
            "not installed",
            "ASPERITY_OPENHAPTICS",
        ),
        ("dhd:".to_owned(), "not installed", "ASPERITY_DHD"),
        (
            "dhd:?lib=/nowhere.so".to_owned(),
            "/nowhere.so",
            "check the path",
        ),
        (
            format!("openhaptics:?lib={script}"),
            "no shared library",
            "name the shared library",
        ),
    ];
    let value: serde_json::Value =
        serde_json::from_slice(&lab(&["list", "--json"]).stdout).expect("JSON");
    for (n, library) in value["libraries"]
        .as_array()
        .expect("libraries")
        .iter()
        .enumerate()
        .rev()
    {
        // A machine of a lab may have one.
        if library["state"] != "not_installed" {
            cases.remove(n);
        }
    }
    let (path, _folder) = &fakes::build("hd", &[]);
    let (lacking, _lacking_folder) = fakes::build("hd", &["-DWITHOUT_hdGetError"]);
    let uri = format!("openhaptics:?lib={}", lacking.display());
    cases.push((uri, "hdGetError", "install a newer OpenHaptics HD"));
    for (uri, problem, remedy) in &cases {
        let output = lab(&["probe", uri]);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{uri}: {said}");
        assert!(
            said.contains(problem) && said.contains(remedy),
            "{uri}: {said}"
        );
    }
    let output = lab(&[
        "probe",
        &format!("openhaptics:?lib={}", path.display()),
        "--seconds",
        "0.3",
    ]);
    let said = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(
        said.contains("only zero force was commanded") && said.contains("unconfirmed"),
        "{said}"
    );
    // The list finds it by the variable.
    let output = Command::new(env!("CARGO_BIN_EXE_asperity-lab"))
        .args(["device", "list"])
        .env("ASPERITY_OPENHAPTICS", path)
        .env("ASPERITY_DHD", path)
        .output()
        .expect("the command runs");
    let said = text(&output.stdout);
    assert!(
        output.status.success() && said.contains("ready: openhaptics:"),
        "{said}"
    );
    assert!(said.contains("it has no function dhd"), "{said}");
}

#[test]
fn every_fault_is_put_on_a_device() {
    let output = lab(&["faults", "sim:?time=stepped&grip=firm", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let faults = value["faults"].as_array().expect("faults");
    assert_eq!(faults.len(), 11);
    for fault in faults {
        assert!(
            fault["broken"].is_null() && fault["row"]["disturbed"] == 0,
            "{fault}"
        );
    }
    let output = lab(&["faults", "null:"]);
    let said = text(&output.stdout);
    assert!(
        output.status.success() && said.contains("| unplugged |"),
        "{said}"
    );
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
    let mut stream = TcpStream::connect(address).expect("a connection");
    let request = operation(REQUEST_LIST, GRANTED);
    stream.write_all(&request).expect("a request");
    take::<12>(&mut stream).expect("the reply and the count");
    let ids = [(); 2].map(|()| {
        let record = take::<RECORD>(&mut stream).expect("a device");
        for _ in 0..record[311] {
            take::<4>(&mut stream).expect("an interface");
        }
        [record[300], record[301], record[302], record[303]]
    });
    assert_eq!(ids, [[0x04, 0x03, 0xcb, 0x48], [0x29, 0x88, 0x03, 0x04]]);
    drop(stream);
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
