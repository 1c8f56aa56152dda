//! Disks that are slow or full keep no servo thread waiting.

use std::io::Write;

use asperity_host::session_log::{
    Ending, Entry, SessionLog, SessionLogError, TextureInfo, render_again, start,
};

use super::session::{Shared, asset, conditions, entries, other, read};

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
    assert_eq!(recording.ending, Ending::Whole(summary));
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
    let first = SessionLog {
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
    assert!(matches!(writing.finish(), Err(SessionLogError::Io(_))));
    assert!(
        start(Full(0), &conditions(), 16).is_err(),
        "the conditions do not fit"
    );
}
