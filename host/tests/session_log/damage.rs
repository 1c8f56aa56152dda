//! No damage goes unnoticed.

use asperity_host::session_log::{Ending, SessionLogError, Summary};

use super::session::{BUILTIN, conditions, entries, file, read};

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
            Err(SessionLogError::Foreign { .. }) => assert!(length < 4),
            Err(error) => assert!(
                matches!(error, SessionLogError::Conditions { .. }) && length < head,
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
        assert!(matches!(read(bytes), Err(SessionLogError::Foreign { .. })));
    }
    let mut newer = whole.clone();
    newer[4] = 2;
    let error = read(&newer).expect_err("newer");
    assert!(
        matches!(error, SessionLogError::Version { found: 2, known: 1 }),
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
        Err(SessionLogError::Conditions { .. })
    ));
    assert!(matches!(
        read(&head(b"\xff")),
        Err(SessionLogError::Conditions { .. })
    ));
    // Conditions that no session can have had: queues are sized by the servo rate.
    for servo_rate_hz in [1e9, 20_001.0, 99.0, 0.0, -1.0] {
        let mut impossible = conditions();
        impossible.config.servo_rate_hz = servo_rate_hz;
        let error = read(&head(&serde_json::to_vec(&impossible).expect("JSON")));
        let told = error.expect_err("impossible").to_string();
        assert!(told.contains("config servo_rate_hz"), "{told}");
    }
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
            matches!(error, SessionLogError::Malformed { at: 8.., .. }),
            "{kind} {body:?}: {error}"
        );
    }
    // The end block counts the ticks that stand before it, and those that were lost.
    let without_end = &whole[..whole.len() - 11];
    let ended = |recorded, lost| read(&[without_end, &block(3, &[recorded, lost])].concat());
    assert!(matches!(
        ended(10, 7).expect("whole").ending,
        Ending::Whole(Summary {
            recorded: 10,
            lost: 7
        })
    ));
    for recorded in [9, 11] {
        let error = ended(recorded, 0).expect_err("another count");
        assert!(error.to_string().contains("count of ticks"), "{error}");
    }
    let later = with(77, b"of a later version").expect("skipped");
    assert!(matches!(later.ending, Ending::Cut { .. }) && later.entries.is_empty());
    // A length of 4 GiB asks for no memory.
    let long = read(&[head(&good), vec![1, 255, 255, 255, 255]].concat()).expect("cut");
    assert!(matches!(long.ending, Ending::Cut { .. }));
}
