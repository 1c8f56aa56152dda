//! The plain Rust loop that rendering from Python is compared with.
//!
//! `plain-loop ASSET POSITIONS FORCES ROUNDS` ticks through positions (three little-endian floats
//! each, m), writes the forces in the same form, and then prints the nanoseconds a tick of each
//! round, which keeps the last output only.

use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};
use std::{env, error::Error, fs, hint::black_box, time::Instant};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [asset, positions, forces, rounds] = arguments.as_slice() else {
        return Err("usage: plain-loop ASSET POSITIONS FORCES ROUNDS".into());
    };
    let bytes = fs::read(asset)?;
    let asset = Asset::parse(&bytes)?;
    let config = Config {
        servo_rate_hz: asset.grid().sample_rate_hz(),
        ..Config::default()
    };
    let renderer = Renderer::new(&config)?;
    let mut texture = Box::new(HostTexture::new());
    texture.load(&asset, config.servo_rate_hz)?;
    let floats: Vec<f32> = fs::read(positions)?
        .as_chunks::<4>()
        .0
        .iter()
        .map(|bytes| f32::from_le_bytes(*bytes))
        .collect();
    let positions_m = floats.as_chunks::<3>().0;

    let mut state = State::new(1);
    let mut written = Vec::with_capacity(positions_m.len() * 12);
    for &position_m in positions_m {
        let output = renderer.tick(&texture, &mut state, &Sample::at(position_m));
        written.extend(output.force_n.iter().flat_map(|x| x.to_le_bytes()));
    }
    fs::write(forces, written)?;

    for _ in 0..rounds.parse::<u32>()? {
        let mut state = State::new(1);
        let start = Instant::now();
        for &position_m in positions_m {
            black_box(renderer.tick(&texture, &mut state, &Sample::at(position_m)));
        }
        let ns = start.elapsed().as_secs_f64() * 1e9 / positions_m.len().max(1) as f64;
        println!("{ns}");
    }
    Ok(())
}
