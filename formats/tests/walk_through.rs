//! The walk-through in `SPEC.md` shows the bytes that the writer writes.

use crate::common;
use crate::common::small;
use asperity_formats::library;
use std::{fmt::Write, fs};

const SPEC: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/SPEC.md");

/// Length of each piece of [`small`], and its meaning.
const ASSET: &[(usize, &str)] = &[
    (4, "magic ASPT"),
    (2, "version 1"),
    (1, "7 sections"),
    (1, "reserved"),
    (4, "total length 322"),
    (4, "haptic length 282"),
    (4, "header CRC"),
    (4, "NAME"),
    (8, "  4 bytes, CRC"),
    (4, "GRID"),
    (8, "  100 bytes, CRC"),
    (4, "TAPS"),
    (8, "  34 bytes, CRC"),
    (4, "FRIC"),
    (8, "  20 bytes, CRC"),
    (4, "SURF"),
    (8, "  20 bytes, CRC"),
    (4, "prov"),
    (8, "  32 bytes, CRC"),
    (4, "prev"),
    (8, "  8 bytes, CRC"),
    (4, "NAME: Cork"),
    (4, "GRID: 1000 Hz"),
    (1, "  numerator: LSF"),
    (2, "  AR order 2, MA order 1"),
    (3, "  2 models, 5 vertices, 4 triangles"),
    (2, "  reserved"),
    (4, "  model 0: ω = π/4, π/2"),
    (2, "    B: ω = 3π/4"),
    (2, "    gain 1.5"),
    (4, "  model 1: codes 20000, 40000"),
    (2, "    B: code 65535"),
    (2, "    gain 0.5"),
    (8, "  vertex 0: 0 mm/s, 0 N"),
    (4, "    σ 0, model 0, edge"),
    (8, "  vertex 1: 200 mm/s, 0 N"),
    (4, "    σ 0.25, model 0, edge"),
    (8, "  vertex 2: 200 mm/s, 2 N"),
    (4, "    σ 1, model 1, edge"),
    (8, "  vertex 3: 0 mm/s, 2 N"),
    (4, "    σ 0, model 1, edge"),
    (8, "  vertex 4: 100 mm/s, 1 N"),
    (4, "    σ 0.5, model 0, interior"),
    (6, "  triangles 0 1 4, 1 2 4"),
    (6, "  triangles 2 3 4, 3 0 4"),
    (4, "TAPS: 10000 Hz"),
    (2, "  2 traces, reserved"),
    (2, "  3 samples each"),
    (8, "  trace 0: 0.1 m/s, peak 10 m/s²"),
    (3, "    codes 2047, −1024"),
    (2, "    code 0"),
    (8, "  trace 1: 0.3 m/s, peak 40 m/s²"),
    (3, "    codes 2047, −1024"),
    (2, "    code 13 (0.254 m/s²)"),
    (4, "FRIC: μ 0.5"),
    (1, "  1 anchor"),
    (8, "  μ 0.5, weight 1"),
    (7, "  6 bytes: Cork 1"),
    (4, "SURF: k 500 N/m"),
    (4, "  b 0.5 N·s/m"),
    (4, "  g_vib 0.0625 s²/m"),
    (4, "  m_eff 0.05 kg"),
    (4, "  F_max 3 N"),
    (5, "prov: generator hand"),
    (1, "  source: empty"),
    (5, "  source CRC deadbeef"),
    (6, "  a prompt: cork"),
    (2, "  seed 300"),
    (5, "  fidelity full"),
    (1, "  taps synthetic"),
    (4, "  LSF error 0.015625 dB"),
    (3, "  notes: µ"),
    (8, "prev: the signature of a PNG"),
];

/// The same for the index of a library.
const LIBRARY: &[(usize, &str)] = &[
    (4, "magic ASPL"),
    (2, "version 1"),
    (2, "flags"),
    (4, "1 texture"),
    (4, "index length 56"),
    (8, "total length 378"),
    (4, "index CRC"),
    (8, "entry 0: asset at 56"),
    (4, "  322 bytes"),
    (4, "  282 of them haptic"),
    (4, "  name at 0"),
    (2, "  of 4 bytes"),
    (2, "  reserved"),
    (4, "names: Cork"),
];

fn listing(bytes: &[u8], pieces: &[(usize, &str)]) -> String {
    let mut out = "```text\n".to_owned();
    let mut at = 0;
    for (len, meaning) in pieces {
        let hex: Vec<_> = bytes[at..at + len]
            .iter()
            .map(|b| format!("{b:02x}"))
            .collect();
        writeln!(out, "{at:04x}  {:<23}  {meaning}", hex.join(" ")).unwrap();
        at += len;
    }
    assert_eq!(at, bytes.len(), "the listing covers every byte");
    out + "```\n"
}

/// Compares what lies between two marks of `SPEC.md` with `expected`.
fn compare(mark: &str, expected: &str) {
    let spec = fs::read_to_string(SPEC).expect("SPEC.md");
    let (open, close) = (format!("<!-- {mark} -->\n"), format!("<!-- /{mark} -->\n"));
    let start = spec.find(&open).expect("opening mark") + open.len();
    let end = start + spec[start..].find(&close).expect("closing mark");
    if std::env::var_os("ASPERITY_BLESS").is_some() {
        // Renamed into place, since another test reads the file meanwhile.
        let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/SPEC.md.new");
        fs::write(beside, [&spec[..start], expected, &spec[end..]].concat()).unwrap();
        fs::rename(beside, SPEC).unwrap();
        return;
    }
    assert!(
        spec[start..end] == *expected,
        "SPEC.md and the writer disagree about {mark}; the writer says\n{expected}\n\
         ASPERITY_BLESS=1 cargo test -p asperity-formats --test it walk_through:: rewrites it"
    );
}

#[test]
fn the_listings_are_the_bytes() {
    let asset = small().encode();
    compare("asset", &listing(&asset, ASSET));
    let textures = [("Cork", &asset[..])];
    let mut bytes = vec![0; library::encoded_len(&textures)];
    library::encode_library(&textures, &mut bytes).unwrap();
    compare("library", &listing(&bytes[..56], LIBRARY));
}

#[test]
fn the_check_value_is_the_one_of_the_document() {
    assert_eq!(common::crc32(*b"123456789"), 0xcbf4_3926);
    assert!(fs::read_to_string(SPEC).unwrap().contains("0xCBF43926"));
}
