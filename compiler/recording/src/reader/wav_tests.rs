//! Headers that other programs write, and files that end where they should not.

use super::*;
use std::io::Cursor;

fn chunk(id: &[u8; 4], stated: u32, body: &[u8]) -> Vec<u8> {
    let mut bytes = id.to_vec();
    bytes.extend(stated.to_le_bytes());
    bytes.extend(body);
    bytes
}

fn format(tag: u16, channels: u16, bits: u16, bytes: u16) -> Vec<u8> {
    let align = channels * bytes;
    let mut body = tag.to_le_bytes().to_vec();
    body.extend(channels.to_le_bytes());
    body.extend(1000_u32.to_le_bytes());
    body.extend((1000 * u32::from(align)).to_le_bytes());
    body.extend(align.to_le_bytes());
    body.extend(bits.to_le_bytes());
    chunk(b"fmt ", 16, &body)
}

fn riff(chunks: &[Vec<u8>]) -> Vec<u8> {
    [b"RIFF\0\0\0\0WAVE".to_vec(), chunks.concat()].concat()
}

/// The rows of a file, and what is said of it.
fn read(bytes: &[u8]) -> Result<(Vec<Vec<f64>>, Vec<String>), Fault> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.wav");
    std::fs::write(&path, bytes).expect("written");
    let mut all = Vec::new();
    rows(&path, &mut |_, row| {
        all.push(row.to_vec());
        Ok(true)
    })?;
    let remarks = header(&path)?.remarks;
    Ok((all, remarks.into_iter().map(|remark| remark.what).collect()))
}

/// Three values of 16 bits, of half of full scale.
const HALF: [u8; 6] = [0, 0x40, 0, 0x40, 0, 0x40];

#[test]
fn every_kind_of_number_is_read() {
    let half = 0.5_f64;
    for (tag, bits, bytes) in [
        (1, 8, vec![192]),
        (1, 16, vec![0, 0x40]),
        (1, 24, vec![0, 0, 0x40]),
        (1, 32, vec![0, 0, 0, 0x40]),
        (3, 32, (half as f32).to_le_bytes().to_vec()),
        (3, 64, half.to_le_bytes().to_vec()),
    ] {
        let data = chunk(b"data", 2 * bytes.len() as u32, &bytes.repeat(2));
        let file = riff(&[format(tag, 2, bits, bytes.len() as u16), data]);
        let (rows, remarks) = read(&file).expect("read");
        assert_eq!(rows, [[0.5, 0.5]], "{tag} {bits}");
        assert!(remarks.is_empty() || bytes.len() == 1, "{remarks:?}");
    }
    let low = riff(&[format(1, 1, 24, 4), chunk(b"data", 4, &[0, 0, 0x40, 0xff])]);
    assert_eq!(read(&low).expect("read").0, [[0.5]]);
}

#[test]
fn chunks_of_odd_length_have_a_pad_byte() {
    let odd = chunk(b"LIST", 3, b"abc\0");
    let data = chunk(b"data", 3, &[0, 0, 0x40, 0]);
    let after = chunk(b"LIST", 4, b"late");
    for chunks in [
        vec![odd.clone(), format(1, 1, 24, 3), data.clone()],
        vec![format(1, 1, 24, 3), odd, data.clone(), after.clone()],
        // Written without the pad byte.
        vec![format(1, 1, 24, 3), data[..11].to_vec(), after],
    ] {
        let (rows, remarks) = read(&riff(&chunks)).expect("read");
        assert_eq!((rows, remarks), (vec![vec![0.5]], vec![]));
    }
}

#[test]
fn a_file_without_a_length_or_with_too_large_a_one_is_read_to_its_end_and_that_is_said() {
    for (stated, part) in [
        (0, "states no length"),
        (u32::MAX, "states no length"),
        (0x7fff_f000, "states no length"),
        (600, "is cut: 0.030 s of the 0.300 s"),
        (2, "states 0.001 s and holds 0.030 s"),
    ] {
        let (rows, remarks) = read(&riff(&[
            format(1, 1, 16, 2),
            chunk(b"data", stated, &HALF.repeat(10)),
        ]))
        .expect("read");
        let count = if stated == 2 { 1 } else { 30 };
        assert_eq!(rows.len(), count, "{stated}");
        assert!(
            remarks.len() == 1 && remarks[0].contains(part),
            "{stated} {remarks:?}"
        );
    }
    // Empty, with a chunk behind it.
    let empty = riff(&[
        format(1, 1, 16, 2),
        chunk(b"data", 0, &[]),
        chunk(b"LIST", 4, b"late"),
    ]);
    assert_eq!(read(&empty).expect("read"), (vec![], vec![]));
}

#[test]
fn a_file_of_more_than_four_gigabytes_states_its_length_elsewhere() {
    let sizes: Vec<u8> = [0_u64, 6, 0]
        .iter()
        .flat_map(|size| size.to_le_bytes())
        .collect();
    let mut file = riff(&[
        chunk(b"ds64", 24, &sizes),
        format(1, 1, 16, 2),
        chunk(b"data", u32::MAX, &HALF),
    ]);
    file[..4].copy_from_slice(b"RF64");
    let (rows, remarks) = read(&file).expect("read");
    assert_eq!((rows.len(), remarks.len()), (3, 0));
}

#[test]
fn what_is_not_read_says_what_it_is() {
    let data = chunk(b"data", 6, &HALF);
    for (file, part) in [
        (riff(&[format(7, 1, 8, 1), data.clone()]), "µ-law"),
        (riff(&[format(3, 1, 16, 2), data.clone()]), "16 bit floats"),
        (
            riff(&[format(1, 1, 64, 8), data.clone()]),
            "64 bit integers",
        ),
        (riff(std::slice::from_ref(&data)), "before their format"),
        (riff(&[format(1, 1, 16, 2)]), "ends within its header"),
        (b"RIFX\0\0\0\0WAVE".to_vec(), "RIFX"),
        (b"t,x\n0,1\n2,3\n".to_vec(), "none of a WAV"),
    ] {
        let error = read(&file).expect_err(part);
        assert!(error.to_string().contains(part), "{error}");
        assert!(!asperity_io::diagnostic::Diagnostic::remedy(&error).is_empty());
    }
}

#[test]
fn a_header_may_be_cut_anywhere() {
    let whole = riff(&[
        format(1, 1, 16, 2),
        chunk(b"LIST", 3, b"abc\0"),
        chunk(b"data", 6, &HALF),
    ]);
    for length in 0..56 {
        let found = read_header(&mut Cursor::new(&whole[..length])).expect("in memory");
        assert_eq!(found, ParsedHeader::Cut, "{length}");
    }
    let found = read_header(&mut Cursor::new(&whole[..56])).expect("in memory");
    assert!(matches!(found, ParsedHeader::Whole(wav) if wav.begin == 56 && wav.stated == 6));
}
