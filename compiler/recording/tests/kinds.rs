//! Every kind of file gives the same values, and a file that is too long is read to its end.

use asperity_io::diagnostic::Diagnostic;
use asperity_recording::{
    check::{self, FindingKind, Severity},
    reader::{self, Recording},
};
use std::{fmt::Write as _, fs, path::Path};

const ROWS: usize = 8000;
const RATE_HZ: u32 = 1000;
/// Acceleration, force and position, in m/s², N and m: what one over full scale means.
const SCALES: [f64; 9] = [40.0, 40.0, 40.0, 8.0, 8.0, 8.0, 0.1, 0.1, 0.1];

/// Strokes with a newton after a second in the air, in parts of full scale.
fn rows() -> Vec<[f64; 9]> {
    let mut state = 11_u64;
    let mut noise = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let omega = std::f64::consts::TAU * 0.7;
    (0..ROWS)
        .map(|n| {
            let t = n as f64 / f64::from(RATE_HZ);
            let load = if t > 1.0 { 1.0 } else { 0.0 };
            let vibration = load * noise();
            let forth = omega * 0.03 * (omega * t).cos();
            let values = [
                vibration - 0.03 * omega * omega * (omega * t).sin() + 0.02 * noise(),
                0.02 * noise(),
                9.81 + 0.02 * noise(),
                -0.4 * load * forth.signum() + 0.05 * vibration + 0.002 * noise(),
                0.002 * noise(),
                load + 0.002 * noise(),
                0.03 * (omega * t).sin(),
                0.0,
                if load > 0.0 { -0.002 } else { 0.01 },
            ];
            std::array::from_fn(|k| values[k] / SCALES[k])
        })
        .collect()
}

/// `recording.toml` of one file whose values are parts of full scale.
fn describe(folder: &Path, file: &str, has_rate: bool) {
    let rate = if has_rate {
        String::new()
    } else {
        format!("rate_hz = {RATE_HZ}\n")
    };
    let mut text = format!("name = \"oak\"\n[[file]]\npath = {file:?}\n{rate}");
    let kinds = [("acceleration", "m/s^2"), ("force", "N"), ("position", "m")];
    for (k, scale) in SCALES.iter().enumerate() {
        let ((quantity, unit), axis) = (kinds[k / 3], ["x", "y", "z"][k % 3]);
        let _ = writeln!(
            text,
            "[[file.channel]]\ncolumn = {k}\nquantity = \"{quantity}\"\naxis = \"{axis}\"\nunit = \"{unit}\"\nscale = {scale}"
        );
    }
    fs::write(folder.join("recording.toml"), text).expect("written");
}

fn wav(path: &Path, bits: u16, float: bool) {
    let spec = hound::WavSpec {
        channels: 9,
        sample_rate: RATE_HZ,
        bits_per_sample: bits,
        sample_format: if float {
            hound::SampleFormat::Float
        } else {
            hound::SampleFormat::Int
        },
    };
    let mut writer = hound::WavWriter::create(path, spec).expect("a file");
    for value in rows().into_iter().flatten() {
        let written = if float {
            writer.write_sample(value as f32)
        } else {
            let full = f64::from(1_u32 << (bits - 1));
            writer.write_sample((value * full).round() as i32)
        };
        written.expect("written");
    }
    writer.finalize().expect("written");
}

fn npy(path: &Path, kind: &str, encode: impl Fn(f64) -> Vec<u8>) {
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({ROWS}, 9), }}");
    let padded = format!("{header:<117}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded.len() as u16).to_le_bytes());
    bytes.extend(padded.as_bytes());
    bytes.extend(rows().into_iter().flatten().flat_map(encode));
    fs::write(path, bytes).expect("written");
}

fn text(path: &Path, separator: &str) {
    let names: Vec<String> = (0..9).map(|k| format!("c{k}")).collect();
    let mut table = names.join(separator) + "\n";
    for row in rows() {
        let values: Vec<String> = row.iter().map(|x| format!("{x:.9}")).collect();
        table += &values.join(separator);
        table.push('\n');
    }
    fs::write(path, table).expect("written");
}

fn held_against_the_truth(recording: &Recording, resolution: f64, file: &str) {
    let exact = rows();
    assert_eq!(recording.channels.len(), 9, "{file}");
    for (k, channel) in recording.channels.iter().enumerate() {
        assert_eq!(channel.samples.len(), ROWS, "{file}");
        for (n, sample) in channel.samples.iter().enumerate() {
            let apart = (f64::from(*sample) - exact[n][k] * SCALES[k]).abs();
            assert!(apart <= (resolution + 1e-6) * SCALES[k], "{file} {n} {k}");
        }
    }
}

#[test]
fn every_kind_of_file_holds_the_same_recording() {
    let step = |bits: i32| 0.5_f64.powi(bits - 1);
    type Writer = Box<dyn Fn(&Path)>;
    let kinds: Vec<(&str, f64, Writer)> = vec![
        ("int16.wav", step(16), Box::new(|p| wav(p, 16, false))),
        ("int24.wav", step(24), Box::new(|p| wav(p, 24, false))),
        ("float.wav", 0.0, Box::new(|p| wav(p, 32, true))),
        (
            "f4.npy",
            0.0,
            Box::new(|p| npy(p, "<f4", |x| (x as f32).to_le_bytes().to_vec())),
        ),
        (
            "f8.npy",
            0.0,
            Box::new(|p| npy(p, ">f8", |x| x.to_be_bytes().to_vec())),
        ),
        ("comma.csv", 0.0, Box::new(|p| text(p, ","))),
        ("tab.tsv", 0.0, Box::new(|p| text(p, "\t"))),
    ];
    for (file, resolution, write) in kinds {
        let folder = tempfile::tempdir().expect("a folder");
        write(&folder.path().join(file));
        describe(folder.path(), file, file.ends_with("wav"));
        let recording = reader::load(folder.path()).expect(file);
        held_against_the_truth(&recording, resolution, file);
        let (checked, _) = check::check(&recording).expect(file);
        assert!(checked.worst() < Severity::Fault, "{file}: {checked}");
    }
}

/// Floats may hold metres a second squared as they are, gravity and all; full scale ends integers.
#[test]
fn a_wav_of_floats_is_not_clipped_where_integers_would_be() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("all.wav");
    let spec = hound::WavSpec {
        channels: 9,
        sample_rate: RATE_HZ,
        bits_per_sample: 32,
        sample_format: hound::SampleFormat::Float,
    };
    let mut writer = hound::WavWriter::create(&path, spec).expect("a file");
    for row in rows() {
        for (value, scale) in row.iter().zip(SCALES) {
            writer
                .write_sample((value * scale) as f32)
                .expect("written");
        }
    }
    writer.finalize().expect("written");
    describe(folder.path(), "all.wav", true);
    let toml = folder.path().join("recording.toml");
    let told = fs::read_to_string(&toml).expect("read");
    let unscaled: Vec<&str> = told.lines().filter(|l| !l.starts_with("scale")).collect();
    fs::write(&toml, unscaled.join("\n")).expect("written");
    let recording = reader::load(folder.path()).expect("read");
    let (checked, _) = check::check(&recording).expect("checked");
    let clipped = checked
        .at_least(Severity::Note)
        .find(|f| f.kind == FindingKind::Clipping);
    assert!(clipped.is_none(), "{checked}");
}

#[test]
fn a_file_that_is_longer_than_memory_may_hold_is_read_to_its_end_and_kept_to_its_limit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("all.csv");
    text(&path, ",");
    let table = fs::read_to_string(&path).expect("read");
    let mut lines: Vec<&str> = table.lines().collect();
    let late = ",".repeat(8);
    lines[7001] = &late;
    fs::write(&path, lines.join("\n")).expect("written");
    describe(folder.path(), "all.csv", false);
    let recording = reader::load_at_most(folder.path(), 9 * 3000).expect("read");
    assert!(recording.channels.iter().all(|c| c.samples.len() == 3000));
    let clock = &recording.clocks[0];
    assert!(clock.shortened);
    let missing = recording.channels.iter().map(|c| c.numbers.missing);
    assert_eq!(missing.sum::<u64>(), 9, "what is not kept is checked");
    let (checked, timeline) = check::check(&recording).expect("checked");
    assert!(timeline.len() <= 3000);
    assert!(checked.to_string().contains("longer than memory"));
}

#[test]
fn a_damaged_file_of_each_kind_is_named() {
    for (file, bytes) in [
        ("all.wav", &b"RIFF\x10\0\0\0WAVEfmt "[..]),
        ("all.npy", b"\x93NUMPY\x01\x00\xff\xff{'descr'"),
        ("all.csv", b"c0,c1\n1,two\n"),
        ("all.mp3", b"ID3"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join(file), bytes).expect("written");
        describe(folder.path(), file, false);
        let error = reader::load(folder.path()).expect_err(file);
        assert!(error.to_string().contains(file), "{error}");
        assert!(!error.remedy().is_empty());
    }
}
