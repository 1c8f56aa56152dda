//! The committed render, on whatever runs the tests: the bits that the workspace's golden
//! test pins are those of this processor, byte order and word size too. Small enough for an
//! interpreter, which takes fewer ticks.

use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State, quantity::Quantity};
use std::sync::OnceLock;

const ASSET: &[u8] = include_bytes!("../../tests/tests/assets/builtin-v1.asp");
const TRAJECTORY: &str = include_str!("../../tests/tests/data/trajectory.csv");
const FELT: &str = include_str!("../../tests/tests/data/builtin-felt.csv");

/// Past the tap and into the stroke.
const TICKS_INTERPRETED: usize = 90;

fn numbers(line: &str) -> Vec<f64> {
    line.split(',').map(|x| x.parse().unwrap()).collect()
}

/// Loaded once: an interpreter takes its time.
fn texture() -> &'static HostTexture {
    static TEXTURE: OnceLock<Box<HostTexture>> = OnceLock::new();
    TEXTURE.get_or_init(|| {
        let mut texture = Box::new(HostTexture::new());
        let asset = Asset::parse_haptic(ASSET).unwrap();
        texture.load(&asset, 1000.0).unwrap();
        texture
    })
}

/// A package holds only files of its own folder, so two that belong elsewhere are kept twice.
#[test]
fn the_copies_are_the_files_they_copy() {
    let copies: [(&str, &[u8], &[u8]); 2] = [
        (
            "tests/tests/assets/builtin-v1.asp",
            ASSET,
            include_bytes!("data/builtin-v1.asp"),
        ),
        (
            "benches/session/textures.aspl",
            include_bytes!("../../benches/session/textures.aspl"),
            include_bytes!("data/textures.aspl"),
        ),
    ];
    for (file, original, copy) in copies {
        assert!(original == copy, "cp {file} runtime/tests/data/");
    }
}

#[test]
fn the_render_is_the_committed_one() {
    let renderer = Renderer::new(&Config::default()).unwrap();
    let (texture, mut state) = (texture(), State::new(7));
    let count = if cfg!(miri) {
        TICKS_INTERPRETED
    } else {
        usize::MAX
    };
    let rows = TRAJECTORY.lines().zip(FELT.lines()).skip(1).take(count);
    let mut taps = 0;
    for (position, felt) in rows {
        let (position, felt) = (numbers(position), numbers(felt));
        let position_m = std::array::from_fn(|axis| (position[1 + axis] / 1000.0) as f32);
        let output = renderer.tick(texture, &mut state, &Sample::at(position_m));
        let [x, y, z] = output.force_n;
        let found = [
            output.vib_m_s2,
            output.tap_n,
            output.friction_n,
            x,
            y,
            z,
            f32::from(output.flags.bits()),
        ];
        // Printed so that they read back to the same bits.
        let expected: Vec<f32> = felt[5..].iter().map(|x| *x as f32).collect();
        assert_eq!(
            found.map(f32::to_bits)[..],
            expected.iter().map(|x| x.to_bits()).collect::<Vec<_>>()[..],
            "{felt:?}: {output:?}"
        );
        taps += u32::from(output.tap_n != 0.0);
    }
    assert!(taps > 0, "the trajectory taps");
}

/// Whatever the impact speed and the place in the transient, its index stays inside.
#[test]
fn transients_are_read_inside_the_bank() {
    let texture = texture();
    let taps = texture.taps();
    let ticks = taps.ticks();
    for speed_m_s in [
        f32::NAN,
        f32::NEG_INFINITY,
        -1.0,
        0.0,
        1e-45,
        0.1,
        0.4,
        9.0,
        f32::INFINITY,
    ] {
        let chosen = taps.select(Quantity(speed_m_s));
        for tick in [0, ticks - 1, ticks, u32::MAX as usize, usize::MAX] {
            assert!(
                taps.acceleration(&chosen, tick).value().is_finite(),
                "{speed_m_s} m/s, tick {tick}"
            );
        }
    }
}

/// Whatever the query, the vertices are the grid's and the mixture is convex.
#[test]
fn queries_name_vertices_that_are_there() {
    let texture = texture();
    let vertices = Asset::parse(ASSET).unwrap().grid().vertices().len();
    let values = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        -0.0,
        0.0,
        1e-45,
        1e-3,
        1.0,
        50.0,
        250.0,
        1e9,
    ];
    for speed in values {
        for force in values {
            let query = texture.weights_at(speed, force);
            assert!(query.vertices.iter().all(|v| usize::from(*v) < vertices));
            assert!(
                query
                    .weights
                    .iter()
                    .all(|w| (0.0..=1.0).contains(&w.value())),
                "{query:?}"
            );
        }
    }
}

/// Faults of every kind, one after the other.
#[test]
fn faults_give_finite_forces() {
    let renderer = Renderer::new(&Config::default()).unwrap();
    let (texture, mut state) = (texture(), State::new(1));
    let pressed = [0.0, 0.0, -1e-3];
    for elapsed_ticks in [1, 1, 0, 0, 0, 1, 3, 4, u32::MAX, 1] {
        for position_m in [
            pressed,
            [f32::NAN; 3],
            [f32::INFINITY; 3],
            [1e38, 0.0, -1e38],
            pressed,
        ] {
            let sample = Sample {
                position_m,
                elapsed_ticks,
            };
            let output = renderer.tick(texture, &mut state, &sample);
            assert!(output.force_n.iter().all(|f| f.abs() <= 3.3), "{output:?}");
        }
    }
}
