//! Recordings: what was felt is felt again to the bit, and no damage goes unnoticed.

use std::io::Write;
use std::sync::{Arc, Mutex};

use asperity_formats::{Asset, Library};
use asperity_host::device::replay::{AtEnd, Replay};
use asperity_host::device::supervised::{Plausible, Supervised};
use asperity_host::device::{Device, Fault};
use asperity_host::recording::{
    Conditions, Encoder, Ending, Entry, Recording, RecordingError, TextureInfo, csv, render_again,
    start,
};
use asperity_runtime::{Config, Exchange, HostTexture, Renderer, Sample, State};

const BUILTIN: &[u8] = include_bytes!("../../tests/data/builtin-v1.asp");
const LIBRARY: &[u8] = include_bytes!("../../tests/data/textures.aspl");
const SEED: u64 = 3;

/// A texture of the library that serves 1 kHz.
fn other() -> &'static [u8] {
    let library = Library::parse(LIBRARY).expect("a library");
    let mut slot = Box::new(HostTexture::new());
    (0..library.index().len())
        .map(|index| library.bytes(index).expect("an asset"))
        .find(|bytes| {
            *bytes != BUILTIN
                && slot
                    .load(&Asset::parse(bytes).expect("an asset"), 1000.0)
                    .is_ok()
        })
        .expect("one at 1 kHz")
}

fn conditions() -> Conditions {
    Conditions {
        program: "test 1.0".into(),
        device: "null:".into(),
        texture: Some(TextureInfo::of("built in", BUILTIN)),
        seed: SEED,
        config: Config::default(),
    }
}

/// A stroke at some depth, with taps, and with samples of every bad kind.
fn sample(n: usize) -> Sample {
    let t_s = n as f32 * 1e-3;
    let z = if n % 700 < 60 {
        0.004 - 1e-4 * (n % 700) as f32
    } else {
        -0.002
    };
    let position_m = [
        0.03 * libm::sinf(6.0 * t_s),
        0.01 * libm::cosf(2.0 * t_s),
        z,
    ];
    match n % 997 {
        500..504 => Sample::STALE,
        504 => Sample {
            position_m,
            elapsed_ticks: 5,
        },
        700 => Sample::at([f32::NAN, 0.0, 0.0]),
        _ => Sample::at(position_m),
    }
}

/// Ticks of which the second texture begins in one.
fn entries(count: usize) -> Vec<Entry> {
    let renderer = Renderer::new(&Config::default()).expect("a configuration");
    let mut slots = [(); 3].map(|()| Box::new(HostTexture::new()));
    let [playing, one, two] = &mut slots;
    playing
        .load(&Asset::parse(BUILTIN).expect("an asset"), 1000.0)
        .expect("it fits");
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(playing, [one, two], SEED);
    let mut playing = std::ptr::from_ref(player.texture());
    let mut entries = Vec::new();
    for n in 0..count {
        if n == 1234 {
            preparer
                .prepare(&Asset::parse(other()).expect("an asset"), 1000.0)
                .expect("a slot");
        }
        let sample = sample(n);
        let output = renderer.tick_player(&mut player, &sample);
        let now = std::ptr::from_ref(player.texture());
        entries.push(Entry {
            buttons: (n / 300) as u32,
            read_fault: (sample.elapsed_ticks == 0).then_some(Fault::Stalled),
            next_texture: now != playing,
            ..Entry::new(sample, &output)
        });
        playing = now;
    }
    entries
}

fn file(entries: &[Entry]) -> Vec<u8> {
    let mut encoder = Encoder::new(Vec::new(), &conditions()).expect("a vector takes all");
    encoder
        .announce(&TextureInfo::of("other", other()))
        .expect("a vector takes all");
    entries
        .iter()
        .for_each(|entry| encoder.push(entry).expect("a vector takes all"));
    encoder.finish(0).expect("a vector takes all").0
}

fn read(bytes: &[u8]) -> Result<Recording, RecordingError> {
    Recording::read(&mut &*bytes)
}

fn asset(texture: &TextureInfo) -> Option<Vec<u8>> {
    [BUILTIN, other()]
        .into_iter()
        .find(|bytes| texture.is(bytes))
        .map(<[u8]>::to_vec)
}

/// A file that a thread writes and a test reads.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().expect("no panic").extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_session_with_two_textures_is_rendered_again_to_the_bit() {
    let entries = entries(6000);
    assert!(entries.iter().filter(|entry| entry.next_texture).count() == 1);
    let shared = Shared::default();
    let (mut recorder, writing) = start(shared.clone(), &conditions(), 16_384).expect("a thread");
    writing.announce(TextureInfo::of("other", other()));
    entries.iter().for_each(|entry| recorder.push(*entry));
    drop(recorder);
    let summary = writing.finish().expect("written");
    assert_eq!((summary.recorded, summary.lost), (6000, 0));

    let bytes = shared.0.lock().expect("no panic").clone();
    let recording = read(&bytes).expect("a recording");
    assert_eq!(recording.ending, Ending::Whole(summary));
    assert_eq!(recording.conditions, conditions());
    assert!(
        recording
            .entries
            .iter()
            .zip(&entries)
            .all(|(read, wrote)| read.has_bits_of(wrote))
    );
    let comparison = render_again(&recording, asset).expect("rendered");
    assert!(
        comparison.is_same() && comparison.compared == 6000,
        "{comparison:?}"
    );

    // The comparison can fail: in one bit of one force, and with another seed.
    let mut touched = recording.clone();
    let force = &mut touched.entries[4000].force_n[2];
    *force = f32::from_bits(force.to_bits() ^ 1);
    let comparison = render_again(&touched, asset).expect("rendered");
    assert_eq!(
        (comparison.different, comparison.first.expect("one").entry),
        (1, 4000)
    );
    let mut reseeded = recording.clone();
    reseeded.conditions.seed += 1;
    assert!(render_again(&reseeded, asset).expect("rendered").different > 1000);
    assert!(
        render_again(&recording, |_| None).is_err(),
        "no bytes, no comparison"
    );
    assert!(
        render_again(&recording, |_| Some(other().to_vec())).is_err(),
        "other bytes"
    );

    println!("{:.1} bytes a tick", bytes.len() as f64 / 6000.0);
}

#[test]
fn a_file_that_is_cut_anywhere_is_read_up_to_its_last_whole_block() {
    let entries = entries(1100);
    let whole = file(&entries);
    let head = file(&[]).len();
    let mut seen = Vec::new();
    for length in (0..whole.len() - 16)
        .step_by(7)
        .chain(whole.len() - 16..whole.len())
    {
        match read(&whole[..length]) {
            Ok(recording) => {
                assert!(matches!(recording.ending, Ending::Cut { .. }), "{length}");
                let got = recording.entries.len();
                assert!(got.is_multiple_of(250) || got == 1100, "whole blocks only");
                assert!(
                    recording
                        .entries
                        .iter()
                        .zip(&entries)
                        .all(|(read, wrote)| read.has_bits_of(wrote))
                );
                seen.push(got);
            }
            Err(RecordingError::Foreign { .. }) => assert!(length < 4),
            Err(error) => assert!(
                matches!(error, RecordingError::Conditions { .. }) && length < head,
                "{length}: {error}"
            ),
        }
    }
    assert!(
        seen.is_sorted()
            && [0, 250, 500, 750, 1000, 1100]
                .iter()
                .all(|count| seen.contains(count))
    );
}

#[test]
fn a_flipped_bit_anywhere_is_noticed() {
    let whole = file(&entries(600));
    let good = read(&whole).expect("a recording");
    for at in (0..whole.len()).step_by(5) {
        let mut bytes = whole.clone();
        bytes[at] ^= 1 << (at % 8);
        match read(&bytes) {
            // The two bytes after the version are free.
            Ok(recording) if (6..8).contains(&at) => {
                assert_eq!(recording.entries.len(), good.entries.len())
            }
            Ok(recording) => {
                assert!(matches!(recording.ending, Ending::Cut { .. }), "{at}");
                assert!(
                    recording
                        .entries
                        .iter()
                        .zip(&good.entries)
                        .all(|(read, wrote)| read.has_bits_of(wrote))
                );
            }
            Err(error) => assert!(!error.to_string().is_empty() && !error.remedy().is_empty()),
        }
    }
}

#[test]
fn foreign_newer_and_hostile_files_give_clear_errors() {
    let whole = file(&entries(10));
    for bytes in [&b""[..], b"AS", b"\x89PNG\r\n\x1a\n", BUILTIN] {
        assert!(matches!(read(bytes), Err(RecordingError::Foreign { .. })));
    }
    let mut newer = whole.clone();
    newer[4] = 2;
    let error = read(&newer).expect_err("newer");
    assert!(
        matches!(error, RecordingError::Version { found: 2, known: 1 }),
        "{error}"
    );

    // Blocks with a right checksum and wrong contents.
    let block = |kind: u8, body: &[u8]| {
        let mut bytes = vec![kind];
        bytes.extend_from_slice(&(body.len() as u32).to_le_bytes());
        bytes.extend_from_slice(body);
        let checksum = crc32fast::hash(&bytes);
        bytes.extend_from_slice(&checksum.to_le_bytes());
        bytes
    };
    let head = |conditions: &[u8]| [b"ASPR\x01\0\0\0".as_slice(), &block(0, conditions)].concat();
    assert!(matches!(
        read(&head(b"{}")),
        Err(RecordingError::Conditions { .. })
    ));
    assert!(matches!(
        read(&head(b"\xff")),
        Err(RecordingError::Conditions { .. })
    ));
    let good = serde_json::to_vec(&conditions()).expect("JSON");
    let with = |kind, body: &[u8]| read(&[head(&good), block(kind, body)].concat());
    for (kind, body) in [
        (1, &b"\xff\xff\xff\xff\x0f"[..]),
        (1, b"\x01\xff\xff"),
        (1, b"\x01\x08\x00"),
        (1, b"\x00\x00"),
        (1, b"\x01\x00\x08\x63\x00"),
        (2, b"nothing"),
        (3, b"\x05\x00"),
        (3, b""),
        (0, b"{}"),
    ] {
        let error = with(kind, body).expect_err("malformed");
        assert!(
            matches!(error, RecordingError::Malformed { at: 8.., .. }),
            "{kind} {body:?}: {error}"
        );
    }
    let later = with(77, b"of a later version").expect("skipped");
    assert!(matches!(later.ending, Ending::Cut { .. }) && later.entries.is_empty());
    // A length of 4 GiB asks for no memory.
    let long = read(&[head(&good), vec![1, 255, 255, 255, 255]].concat()).expect("cut");
    assert!(matches!(long.ending, Ending::Cut { .. }));
}

#[test]
fn a_slow_disk_loses_ticks_that_are_counted_and_never_stops_the_servo_thread() {
    /// Takes everything, after a while.
    struct Slow(Shared);
    impl Write for Slow {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            std::thread::sleep(std::time::Duration::from_millis(30));
            self.0.write(bytes)
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let shared = Shared::default();
    let entries = entries(5000);
    let (mut recorder, writing) = start(Slow(shared.clone()), &conditions(), 64).expect("a thread");
    for (n, entry) in entries.iter().enumerate() {
        recorder.push(*entry);
        if n % 100 == 0 {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
    }
    let lost = recorder.lost();
    drop(recorder);
    let summary = writing.finish().expect("written");
    assert!(
        lost > 0 && summary.lost == lost && summary.recorded + lost == 5000,
        "{summary:?}"
    );
    let bytes = shared.0.lock().expect("no panic").clone();
    let recording = read(&bytes).expect("a recording");
    // Where the entries stand among all ticks.
    let mut tick = 0;
    for entry in &recording.entries {
        tick += entry.lost_before as usize;
        let plain = Entry {
            lost_before: 0,
            ..*entry
        };
        assert!(plain.has_bits_of(&entries[tick]), "tick {tick}");
        tick += 1;
    }
    assert!(recording.lost() <= lost);
    let first = Recording {
        textures: vec![TextureInfo::of("other", other())],
        ..recording
    };
    let comparison = render_again(&first, asset).expect("rendered");
    assert!(
        comparison.not_compared > 0 && !comparison.is_same() && comparison.different == 0,
        "{comparison:?}"
    );
}

#[test]
fn a_full_disk_is_an_error_at_the_end_and_no_stop_of_the_servo_thread() {
    /// Takes the conditions, then nothing.
    struct Full(usize);
    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0 = self
                .0
                .checked_sub(1)
                .ok_or(std::io::ErrorKind::StorageFull)?;
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let (mut recorder, writing) = start(Full(6), &conditions(), 1024).expect("a thread");
    entries(3000)
        .into_iter()
        .for_each(|entry| recorder.push(entry));
    drop(recorder);
    assert!(matches!(writing.finish(), Err(RecordingError::Io(_))));
    assert!(
        start(Full(0), &conditions(), 16).is_err(),
        "the conditions do not fit"
    );
}

#[test]
fn a_replay_drives_the_tick_to_the_same_bits() {
    let renderer = Renderer::new(&Config::default()).expect("a configuration");
    let mut texture = Box::new(HostTexture::new());
    texture
        .load(&Asset::parse(BUILTIN).expect("an asset"), 1000.0)
        .expect("it fits");
    // Recorded through the same supervision, with faults but no missed period.
    let mut state = State::new(SEED);
    let recorded: Vec<Entry> = (0..3000)
        .map(|n| {
            let sample = Sample {
                elapsed_ticks: sample(n).elapsed_ticks.min(1),
                ..sample(n)
            };
            let position = sample.position_m.iter().all(|x| x.is_finite());
            let sample = if position { sample } else { Sample::STALE };
            Entry {
                read_fault: (sample.elapsed_ticks == 0).then_some(Fault::Garbled),
                ..Entry::new(sample, &renderer.tick(&texture, &mut state, &sample))
            }
        })
        .collect();
    let open = |entries: &[Entry], at_end| {
        let recording = read(&file(entries)).expect("a recording");
        Replay::new(recording, at_end, "test").expect("a replay")
    };
    let mut replay = open(&recorded, AtEnd::Leave);
    let mut state = State::new(SEED);
    for entry in &recorded {
        let sample = match replay.read() {
            Ok(reading) if reading.fresh => Sample::at(reading.position_m),
            Ok(_) => Sample::STALE,
            Err(fault) => {
                assert_eq!(Some(fault), entry.read_fault);
                Sample::STALE
            }
        };
        let output = renderer.tick(&texture, &mut state, &sample);
        replay.write(output.force_n).expect("it takes every force");
    }
    assert_eq!(replay.compared(), (3000, 0));
    assert_eq!(
        replay.read(),
        Err(Fault::Disconnected),
        "the recording is over"
    );
    assert_eq!(replay.recover(), Err(Fault::Disconnected));

    // Under supervision the end of the recording is a lost device: the force goes to zero.
    let mut supervised = Supervised::new(
        open(&recorded[..200], AtEnd::Leave),
        &Config::default(),
        Plausible::default(),
    );
    let mut state = State::new(SEED);
    let mut last = [0.0; 3];
    for _ in 0..210 {
        let seen = supervised.read(1);
        last = renderer.tick(&texture, &mut state, &seen.sample).force_n;
        supervised.write(last).expect("it takes every force");
    }
    assert_eq!(last, [0.0; 3]);
    assert_eq!(supervised.tally().episodes, 1);

    let mut again = open(&recorded[..2], AtEnd::Loop);
    let first = again.read();
    let _ = again.read();
    assert_eq!(again.read(), first);
}

#[test]
fn replay_uris_are_checked() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a b.aspr");
    std::fs::write(&path, file(&entries(50))).expect("written");
    let open = |text: String| Replay::open(&text.parse().expect("a URI"));
    let replay = open(format!("replay:{}?end=loop", path.display())).expect("a replay");
    assert!(
        replay.description().name.contains("null:"),
        "{}",
        replay.description().name
    );
    std::fs::write(&path, file(&[])).expect("written");
    let none = folder.path().join("none.aspr");
    for text in [
        "replay:".into(),
        format!("replay:{}", none.display()),
        format!("replay:{}", path.display()),
        format!("replay:{}?end=never", path.display()),
        format!("replay:{}?loop=1", path.display()),
    ] {
        let error = open(text).expect_err("refused");
        assert!(!error.to_string().is_empty() && !error.remedy().is_empty());
    }
}

#[test]
fn the_table_has_a_row_for_every_tick_and_its_floats_read_back() {
    let entries = entries(2000);
    let recording = read(&file(&entries)).expect("a recording");
    let mut table = Vec::new();
    csv::write(&recording, &mut table).expect("a vector takes all");
    let table = String::from_utf8(table).expect("text");
    let mut rows = table.lines();
    let columns: Vec<&str> = rows.next().expect("a head").split(',').collect();
    let column = |name: &str| {
        columns
            .iter()
            .position(|column| *column == name)
            .expect(name)
    };
    for (n, (row, entry)) in rows.zip(&entries).enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        assert_eq!(cells.len(), columns.len(), "{row}");
        assert_eq!(cells[column("tick")], n.to_string());
        for (axis, name) in ["fx_n", "fy_n", "fz_n"].iter().enumerate() {
            let force: f32 = cells[column(name)].parse().expect("a number");
            assert_eq!(force.to_bits(), entry.force_n[axis].to_bits());
        }
        let read_fault = entry
            .read_fault
            .map(|fault| fault.to_string())
            .unwrap_or_default();
        assert_eq!(cells[column("read_fault")], read_fault);
    }
    assert_eq!(table.lines().count(), 2001);
    assert!(
        table
            .lines()
            .last()
            .expect("a row")
            .split(',')
            .nth(column("texture"))
            == Some("1")
    );
}
