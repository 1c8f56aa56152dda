//! A recording as a device.

use asperity_formats::Asset;
use asperity_host::device::replay::{AtEnd, Replay};
use asperity_host::device::supervised::{Plausible, Supervised};
use asperity_host::device::{Device, DeviceError};
use asperity_host::session_log::Entry;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};

use super::session::{BUILTIN, SEED, entries, file, read, sample};

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
                read_fault: (sample.elapsed_ticks == 0).then_some(DeviceError::Garbled),
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
        Err(DeviceError::Disconnected),
        "the recording is over"
    );
    assert_eq!(replay.recover(), Err(DeviceError::Disconnected));

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
