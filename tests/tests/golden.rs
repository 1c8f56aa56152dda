//! Goldens: the committed asset of format version 1, and its committed render.
//!
//! `assets/builtin-v1.asp` was written by `asperity builtin` in format version 1. It is kept
//! whatever later versions write, and must stay readable.

use crate::support;
use asperity_formats::{Asset, Numerator, VertexKind};
use asperity_tests::oracle::{Oracle, Texture};
use std::{fmt::Write as _, fs, path::PathBuf};

const REGENERATE: &str = "if the change is meant, regenerate it with\n\
     ASPERITY_BLESS=1 cargo test -p asperity-tests --test it golden::\n\
     and look at the difference before committing it";

fn path(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests")).join(name)
}

fn blessing() -> bool {
    std::env::var_os("ASPERITY_BLESS").is_some()
}

fn committed(name: &str) -> Vec<u8> {
    fs::read(path(name)).unwrap_or_else(|error| panic!("{name}: {error}; {REGENERATE}"))
}

/// A tap, a stroke that speeds up and presses harder, a stop, a way back: 600 ms.
fn trajectory() -> String {
    (0..600).fold("t_s,x_mm,y_mm,z_mm\n".to_owned(), |mut csv, n| {
        let t = f64::from(n) / 1000.0;
        let z = if t < 0.05 {
            1.0 - 60.0 * t
        } else {
            -2.0 - 2.0 * (t - 0.05) * (0.6 - t) * 4.0
        };
        let x = match t {
            t if t < 0.05 => 0.0,
            t if t < 0.35 => 300.0 * (t - 0.05) * (t - 0.05),
            t if t < 0.45 => 27.0,
            t => 27.0 - 120.0 * (t - 0.45),
        };
        let _ = writeln!(csv, "{t},{x:.6},{:.6},{z:.6}", 0.3 * x);
        csv
    })
}

fn render(asset: &Asset<'_>, trajectory: &str) -> String {
    let mut out = Vec::new();
    let file = "trajectory.csv".as_ref();
    asperity::views::render::render(asset, None, file, trajectory.as_bytes(), &mut out, 7)
        .expect("a render");
    String::from_utf8(out).expect("text")
}

#[test]
fn the_render_of_the_builtin_texture_is_the_committed_one() {
    if blessing() {
        fs::write(path("data/trajectory.csv"), trajectory()).unwrap();
        let asset = support::builtin();
        let felt = render(&Asset::parse(&asset).unwrap(), &trajectory());
        fs::write(path("data/builtin-felt.csv"), felt).unwrap();
        return;
    }
    let bytes = committed("assets/builtin-v1.asp");
    let asset = Asset::parse(&bytes).expect("an asset of version 1");
    let trajectory = String::from_utf8(committed("data/trajectory.csv")).unwrap();
    let expected = String::from_utf8(committed("data/builtin-felt.csv")).unwrap();
    let found = render(&asset, &trajectory);
    for (number, (found, expected)) in found.lines().zip(expected.lines()).enumerate() {
        assert_eq!(found, expected, "line {}: {REGENERATE}", number + 1);
    }
    assert_eq!(
        found.lines().count(),
        expected.lines().count(),
        "{REGENERATE}"
    );
}

/// The committed render agrees with the oracle.
#[test]
fn the_committed_render_is_the_oracles() {
    if blessing() {
        return;
    }
    let bytes = committed("assets/builtin-v1.asp");
    let asset = Asset::parse(&bytes).unwrap();
    let config = asperity_runtime::Config::default();
    let mut slot = Box::new(asperity_runtime::HostTexture::new());
    slot.load(&asset, config.servo_rate_hz).unwrap();
    let mut oracle = Oracle::new(&asset, slot.cycle_samples(), &config, 7);
    let numbers = |name| -> Vec<Vec<f64>> {
        String::from_utf8(committed(name))
            .unwrap()
            .lines()
            .skip(1)
            .map(|line| {
                line.split(',')
                    .map(|x| x.parse().expect("a number"))
                    .collect()
            })
            .collect()
    };
    let (positions, felt) = (
        numbers("data/trajectory.csv"),
        numbers("data/builtin-felt.csv"),
    );
    assert_eq!(positions.len(), felt.len());
    let (mut taps, mut loudest) = (0, 0.0_f64);
    for (position, felt) in positions.iter().zip(&felt) {
        let position_m = std::array::from_fn(|i| (position[i + 1] / 1000.0) as f32);
        let exact = oracle.tick(&asperity_runtime::Sample::at(position_m));
        for (found, exact) in felt[8..11].iter().zip(exact.force_n) {
            assert!((found - exact).abs() < 2e-4, "{felt:?}: {exact:?}");
        }
        assert!(
            (felt[5] - exact.vib_m_s2).abs() < 1e-3,
            "{felt:?}: {exact:?}"
        );
        taps += u32::from(felt[11] as u32 & 2 != 0);
        loudest = loudest.max(exact.vib_m_s2.abs());
    }
    assert_eq!(taps, 1, "the trajectory taps once");
    assert!(loudest > 0.5, "and is heard: {loudest} m/s²");
}

#[test]
fn the_asset_of_version_1_stays_readable() {
    if blessing() {
        return;
    }
    let bytes = committed("assets/builtin-v1.asp");
    let asset = Asset::parse(&bytes).expect("an asset of version 1");
    assert_eq!(asset.version(), 1);
    assert_eq!(asset.name(), "Built-in Grit");
    let grid = asset.grid();
    assert_eq!(
        (grid.sample_rate_hz(), grid.numerator()),
        (1000.0, Numerator::Nyquist)
    );
    assert!(grid.vertices().any(|v| v.kind == VertexKind::Interior));
    assert_eq!(
        (asset.taps().sample_rate_hz(), asset.taps().traces().len()),
        (10_000.0, 13)
    );
    assert!(
        asset.haptic_len() <= 4096,
        "{} haptic bytes",
        asset.haptic_len()
    );
    let provenance = asset.provenance().expect("provenance");
    assert!(provenance.taps_synthetic && provenance.lsf_error_db <= 0.03);
    // Read through every function of the view.
    assert!(Asset::parse_haptic(&bytes[..asset.haptic_len()]).is_ok());
    assert!(Texture::new(&asset).vertices.len() >= 18);
}

/// As long as version 1 is current, the compiler writes the same bytes.
#[test]
fn the_builtin_texture_is_written_to_the_byte() {
    let current = support::builtin();
    let name = "assets/builtin-v1.asp";
    if blessing() {
        fs::write(path(name), &current).unwrap();
        return;
    }
    assert!(
        committed(name) == current,
        "the built-in texture or the writer changed. Before version 1 is released, {REGENERATE}; \
         after it, keep the file and drop this comparison"
    );
}
