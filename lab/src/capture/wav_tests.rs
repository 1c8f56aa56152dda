//! A file that grows under the reader, and everything that can happen to it.

use super::*;
use std::fs::OpenOptions;
use std::io::Write as _;

const FULL: Full = Full {
    acceleration: 16.0,
    force: 20.0,
};

/// A header as `arecord` writes it: the length of the values is far too large.
fn header(channels: u16, bits: u16, rate_hz: u32) -> Vec<u8> {
    let align = channels * bits / 8;
    let mut bytes = b"RIFF\x24\x00\x00\x80WAVEfmt \x10\x00\x00\x00\x01\x00".to_vec();
    bytes.extend(channels.to_le_bytes());
    bytes.extend(rate_hz.to_le_bytes());
    bytes.extend((rate_hz * u32::from(align)).to_le_bytes());
    bytes.extend(align.to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    bytes.extend(b"data\x00\x00\x00\x80");
    bytes
}

/// A complaint, and the damage to a file that provokes it.
type Damage = (&'static str, fn(&Path));

struct Growing {
    folder: tempfile::TempDir,
    wav: Wav,
    samples: Samples,
}

impl Growing {
    fn new(layout: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let wav = Wav::follow(
            &folder.path().join("a.wav"),
            Layout::parse(layout).ok(),
            FULL,
        );
        Self {
            folder,
            wav,
            samples: Samples::default(),
        }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("a.wav")
    }

    fn write(&self, bytes: &[u8]) {
        let file = OpenOptions::new()
            .append(true)
            .create(true)
            .open(self.path());
        file.and_then(|mut file| file.write_all(bytes))
            .expect("it grows");
    }

    fn read(&mut self) -> Result<(), SensorError> {
        self.wav.read(Duration::from_millis(1), &mut self.samples)
    }
}

#[test]
fn a_file_is_followed_byte_by_byte_from_before_it_is_there() {
    let mut growing = Growing::new("ax,fz");
    growing.read().expect("no file yet");
    let mut bytes = header(2, 16, 4000);
    for n in 0..3_i16 {
        bytes.extend((n * 8192).to_le_bytes());
        bytes.extend((-n * 16_384).to_le_bytes());
    }
    for byte in bytes {
        growing.write(&[byte]);
        growing.read().expect("it grows");
    }
    assert_eq!(growing.samples.own, [0.0, 1.0, 2.0]);
    assert_eq!(growing.samples.values, [0.0, 0.0, 4.0, -10.0, 8.0, -20.0]);
    assert_eq!(growing.wav.stated_scale(), Some(1.0 / 4000.0));
}

#[test]
fn every_width_and_an_extensible_header_give_the_same_value() {
    let half = 0x4000_0000_i32.to_le_bytes();
    let mut extensible =
        b"RIFF\0\0\0\0WAVELIST\x03\0\0\0abc\0fmt \x28\0\0\0\xfe\xff\x01\0".to_vec();
    extensible.extend(8000_u32.to_le_bytes());
    extensible.extend(32_000_u32.to_le_bytes());
    extensible.extend([4, 0, 32, 0, 22, 0, 32, 0, 0, 0, 0, 0, 3, 0]);
    extensible.extend([0; 14]);
    extensible.extend(b"data\0\0\0\0");
    extensible.extend(0.5_f32.to_le_bytes());
    let mut double = header(1, 64, 8000);
    double[20] = 3;
    double.extend(0.5_f64.to_le_bytes());
    let with = |bits, value: &[u8]| [&header(1, bits, 8000), value].concat();
    for bytes in [
        with(16, &half[2..]),
        with(24, &half[1..]),
        with(32, &half),
        extensible,
        double,
    ] {
        let mut growing = Growing::new("a");
        growing.write(&bytes);
        growing.read().expect("it is followed");
        assert_eq!(growing.samples.values, [8.0]);
    }
}

#[test]
fn a_header_that_lies_is_refused_with_what_it_states() {
    for (bytes, layout, part) in [
        (b"#t_us,ax\n12,0.1\n".to_vec(), "a", "none of a WAV"),
        (header(1, 48, 8000), "a", "48 bit"),
        (header(1, 16, 7), "a", "7 Hz"),
        (header(2, 16, 8000), "a", "2 channels"),
        (header(1, 16, 8000), "t_us,a", "1 channels"),
        (header(2, 16, 8000), "t_us,a", "no place for a clock"),
        (
            b"RIFF\0\0\0\0WAVEfmt \xff\xff\xff\xff".to_vec(),
            "a",
            "bytes",
        ),
        (
            b"RIFF\0\0\0\0WAVEdata\0\0\0\0".to_vec(),
            "a",
            "before their format",
        ),
        (
            [&b"RIFF\0\0\0\0WAVE"[..], &[b'x'; 70_000]].concat(),
            "a",
            "",
        ),
    ] {
        let mut growing = Growing::new(layout);
        growing.write(&bytes);
        let found = growing.read();
        if part.is_empty() {
            // A chunk of 2 GB that is not there yet.
            assert!(found.is_ok() || found.is_err_and(|e| e.to_string().contains("bytes")));
            continue;
        }
        let error = found.expect_err(part).to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_file_that_is_shortened_replaced_or_rewritten_is_an_error() {
    let whole = [header(1, 16, 8000), vec![1; 64]].concat();
    let damages: [Damage; 3] = [
        ("shortened", |path| {
            let file = OpenOptions::new().write(true).open(path);
            file.and_then(|file| file.set_len(50))
                .expect("it is shortened");
        }),
        ("replaced", |path| {
            let bytes = fs::read(path).expect("the file");
            fs::remove_file(path).expect("it is removed");
            fs::write(path, bytes).expect("another one");
        }),
        ("header changed", |path| {
            let mut bytes = fs::read(path).expect("the file");
            bytes[24] ^= 1;
            let file = OpenOptions::new().write(true).open(path);
            file.and_then(|mut file| file.write_all(&bytes))
                .expect("it is changed");
        }),
    ];
    for (part, damage) in damages {
        let mut growing = Growing::new("a");
        growing.write(&whole);
        growing.read().expect("it is followed");
        damage(&growing.path());
        let error = (0..2 * SELDOM).find_map(|_| growing.read().err());
        let error = error.expect(part).to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_length_that_is_corrected_at_the_end_is_no_change() {
    let mut growing = Growing::new("a");
    growing.write(&[header(1, 16, 8000), vec![1; 64]].concat());
    growing.read().expect("it is followed");
    let mut bytes = fs::read(growing.path()).expect("the file");
    bytes[40..44].copy_from_slice(&64_u32.to_le_bytes());
    let file = OpenOptions::new().write(true).open(growing.path());
    file.and_then(|mut file| file.write_all(&bytes))
        .expect("as arecord ends");
    for _ in 0..SELDOM + 1 {
        growing.read().expect("the same file");
    }
    assert_eq!(growing.samples.len(), 32);
}
