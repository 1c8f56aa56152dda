//! Proposals can be read again, and state what they leave open.

use super::*;

fn proposal(files: &[(&str, &str)]) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).expect("written");
    }
    let proposal = propose(folder.path()).expect("read").expect("a file");
    let read = || {
        std::fs::write(folder.path().join("recording.toml"), &proposal.text).expect("written");
        crate::description::read(folder.path()).expect("a draft that can be read")
    };
    if proposal.files > 0 && !proposal.text.contains("# rate_hz") {
        assert_eq!(read().files.len(), proposal.files, "{}", proposal.text);
    }
    (folder, proposal.text)
}

#[test]
fn a_proposal_can_be_read_again() {
    let (folder, text) = proposal(&[
        ("a.csv", "t_ms,ax_g,ay_g,az_g\n0,0,0,1\n1,0,0,1\n"),
        ("f.csv", "time_s,fz,x_mm\n0,0,1\n0.001,0,1\n"),
    ]);
    std::fs::write(folder.path().join("recording.toml"), &text).expect("written");
    let read = crate::description::read(folder.path()).expect("valid");
    assert_eq!(read.files.len(), 2);
    assert_eq!(read.files[0].channels[2].label(), "acceleration z");
    assert_eq!(read.files[1].channels[1].unit.name, "mm");
    assert_eq!(read.files[0].clock_s, 1e-3);
}

#[test]
fn nothing_is_made_up() {
    let (_, text) = proposal(&[("a.csv", "ax_g,label,x\n0,a,0\n1,b,0\n")]);
    assert!(!text.contains("\nrate_hz"), "{text}");
    assert!(text.contains("# column \"label\" is left out"), "{text}");
    let (_, text) = proposal(&[("a.csv", "x,y,z\n0,0,0\n1,0,0\n")]);
    assert!(text.contains("# \"a.csv\" is left out"), "{text}");
    assert!(!text.contains("position"), "{text}");
    let (_, text) = proposal(&[(
        "log.csv",
        "time,seconds_elapsed,z,y,x\n0,0,0,0,0\n1,1,0,0,0\n",
    )]);
    assert!(!text.contains("position"), "{text}");
}

#[test]
fn a_clock_without_a_unit_has_the_one_of_a_usual_rate() {
    for (step, unit) in [(0.002, "s"), (2.0, "ms"), (312.5, "us"), (2e6, "ns")] {
        let rows: Vec<String> = (0..50)
            .map(|n| format!("{},1\n", step * f64::from(n)))
            .collect();
        let (_, text) = proposal(&[("a.csv", &format!("time,ax_g\n{}", rows.concat()))]);
        assert!(
            text.contains(&format!("clock_unit = {unit:?}  # by")),
            "{step} {text}"
        );
    }
}

#[test]
fn an_acceleration_without_a_unit_has_the_one_in_which_it_shows_gravity() {
    for (gravity, unit) in [
        ("1.01", "g"),
        ("9.79", "m/s^2"),
        ("998", "mg"),
        ("9820", "mm/s^2"),
    ] {
        let table = format!("t_s,ax,ay,az\n0,0,0,{gravity}\n0.001,0,0,{gravity}\n");
        let (_, text) = proposal(&[("a.csv", &table)]);
        assert!(
            text.contains(&format!("unit = {unit:?}  # by gravity")),
            "{text}"
        );
    }
}

#[test]
fn a_wav_of_three_channels_is_taken_for_an_accelerometer_along_x_y_and_z() {
    let folder = tempfile::tempdir().expect("a folder");
    let header = |data: u32| {
        let mut bytes = b"RIFF".to_vec();
        bytes.extend((36 + data).to_le_bytes());
        bytes.extend(b"WAVEfmt \x10\0\0\0\x01\0\x03\0");
        bytes.extend(8000_u32.to_le_bytes());
        bytes.extend(48_000_u32.to_le_bytes());
        bytes.extend(b"\x06\0\x10\0data");
        bytes.extend(data.to_le_bytes());
        bytes
    };
    let file = [header(600), vec![1; 600]].concat();
    std::fs::write(folder.path().join("oak.wav"), file).expect("written");
    let text = propose(folder.path()).expect("read").expect("a file").text;
    std::fs::write(folder.path().join("recording.toml"), &text).expect("written");
    let read = crate::description::read(folder.path()).expect("valid");
    let labels: Vec<String> = read.files[0].channels.iter().map(|c| c.label()).collect();
    assert_eq!(
        labels,
        ["acceleration x", "acceleration y", "acceleration z"]
    );
    assert_eq!(
        text.matches("# a guess: the file names no channels")
            .count(),
        3
    );
}

#[test]
fn a_file_that_cannot_be_read_is_said_to_be_left_out() {
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 1\n";
    let (_, text) = proposal(&[("a.csv", "t_s,ax_g\n0,1\n1,1\n"), ("b.wav", pointer)]);
    assert!(
        text.contains("# \"b.wav\" is left out: is a Git LFS pointer"),
        "{text}"
    );
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("b.wav"), pointer).expect("written");
    let error = propose(folder.path()).expect_err("nothing to read");
    assert!(error.to_string().contains("pointer"), "{error}");
}

#[test]
fn one_acceleration_is_proposed_that_with_gravity() {
    let table = |z: &str| {
        let rows = (0..40).map(|n| format!("{},{},{z},0,0\n", n * 1_000_000, f64::from(n) / 1e3));
        format!("time,seconds_elapsed,z,y,x\n{}", rows.collect::<String>())
    };
    let gps = "time,seconds_elapsed,speed,latitude\n0,0,1,2\n1000000000,1,1,2\n2000000000,2,1,2\n";
    let (_, text) = proposal(&[
        ("Accelerometer.csv", &table("0.01")),
        ("Gravity.csv", &table("9.81")),
        ("Location.csv", gps),
        ("TotalAcceleration.csv", &table("9.81")),
    ]);
    assert_eq!(text.matches("[[file]]").count(), 1, "{text}");
    for part in [
        "path = \"TotalAcceleration.csv\"",
        "# \"Accelerometer.csv\" is left out: \"TotalAcceleration.csv\" has this acceleration already",
        "# \"Gravity.csv\" is left out",
        "gives 1.000 rows a second",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn a_file_is_known_by_words_of_its_name_not_by_parts_of_them() {
    let table = "t_s,x,y\n0,0,0\n0.001,0,0\n0.002,0,0\n";
    for (name, quantity) in [
        ("accel-2.csv", "acceleration"),
        ("LoadCell.csv", "force"),
        ("tool_position.csv", "position"),
    ] {
        let (_, text) = proposal(&[(name, table)]);
        assert!(
            text.contains(&format!("quantity = \"{quantity}\"")),
            "{name}: {text}"
        );
    }
    for name in [
        "download.csv",
        "workload.csv",
        "account.csv",
        "composition.csv",
        "reinforced.csv",
    ] {
        let (_, text) = proposal(&[(name, table)]);
        assert!(!text.contains("quantity"), "{name}: {text}");
    }
}

#[test]
fn names_in_any_script_are_written_as_toml() {
    let table = "t_s,Kra\u{308}fte \\ \"x\" fz,fz (N)\n0,0,1\n0.001,0,1\n0.002,0,1\n";
    let (folder, text) = proposal(&[("Kra\u{308}fte \u{200b}'1'.csv", table)]);
    let read = crate::description::read(folder.path()).expect("valid");
    assert_eq!(
        read.files[0].file, "Kra\u{308}fte \u{200b}'1'.csv",
        "{text}"
    );
    let long = folder.path().join("ä".repeat(40));
    std::fs::create_dir(&long).expect("a folder");
    std::fs::write(long.join("a.csv"), table).expect("written");
    let text = propose(&long).expect("read").expect("a file").text;
    std::fs::write(long.join("recording.toml"), text).expect("written");
    assert_eq!(
        crate::description::read(&long).expect("valid").name.len(),
        64
    );
}

#[test]
fn times_as_text_are_a_clock_in_seconds_or_named() {
    for times in [
        [
            "2024-09-29T08:53:20.000Z",
            "2024-09-29T08:53:20.002Z",
            "2024-09-29T08:53:20.004Z",
        ],
        ["08:53:20.000", "08:53:20.002", "08:53:20.004"],
        ["0 sec", "0.002 sec", "0.004 sec"],
    ] {
        let rows: String = times.iter().map(|time| format!("{time},1\n")).collect();
        let (_, text) = proposal(&[("a.csv", &format!("Time,ax_g\n{rows}"))]);
        assert!(
            text.contains("clock = \"Time\"\nclock_unit = \"s\"\n"),
            "{times:?} {text}"
        );
    }
    let (_, text) = proposal(&[("a.csv", "Time,ax_g\nnoon,1\nnight,1\nnoon,1\n")]);
    assert!(
        text.contains("\"Time\" holds \"noon\", which is no time"),
        "{text}"
    );
}

#[test]
fn files_of_other_formats_are_named_with_what_becomes_of_them() {
    let (_, text) = proposal(&[
        ("a.csv", "t_s,ax_g\n0,1\n0.001,1\n0.002,1\n"),
        ("log.tdms", "TDSm\u{e}\0\0\0"),
        ("log.lvm", "t_s\tax (g)\n0\t1\n1\t1\n"),
        ("notes.md", "hello, world\n"),
    ]);
    assert!(
        text.contains("# \"log.tdms\" is left out: is a LabVIEW TDMS file"),
        "{text}"
    );
    assert!(
        text.contains("# \"log.lvm\" is left out: is a table"),
        "{text}"
    );
    assert!(!text.contains("notes"), "{text}");
}

#[test]
fn a_folder_without_sensor_files_has_no_proposal() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("notes.md"), "hello").expect("written");
    assert!(propose(folder.path()).expect("read").is_none());
}
