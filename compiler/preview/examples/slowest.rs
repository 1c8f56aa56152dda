//! Draws every material at one size and lists the time that each takes, the slowest first.
//!
//! `cargo run --release -p asperity-preview --example slowest [PX [MATERIAL …]]`. Times are of all
//! threads of rayon's pool: `RAYON_NUM_THREADS=1` gives the time of one core. The least of three runs
//! counts; with materials, each is drawn once, so that a profiler counts one picture.

use asperity_preview::{Description, Picture};
use std::{hint::black_box, time::Instant};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let size = arguments.next().map_or(Ok(512), |text| text.parse())?;
    let asked: Vec<String> = arguments.collect();
    let (names, runs) = if asked.is_empty() {
        (materials()?, 3)
    } else {
        (asked, 1)
    };
    let mut times = Vec::with_capacity(names.len());
    for name in &names {
        let mut least = f64::INFINITY;
        for _ in 0..runs {
            let description = Description {
                words: name,
                coarser: 1.0,
                nearest: &[],
                feel: None,
                seed: 0,
            };
            let start = Instant::now();
            black_box(Picture::draw(black_box(&description), size)?);
            least = least.min(start.elapsed().as_secs_f64() * 1e3);
        }
        times.push((least, name));
    }
    times.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (time, name) in &times {
        println!("{time:8.1} ms  {name}");
    }
    Ok(())
}

/// Materials of the table, one for each pattern.
fn materials() -> Result<Vec<String>, toml::de::Error> {
    let table: toml::Table = include_str!("../data/materials.toml").parse()?;
    let mut seen = Vec::new();
    let rows = table["material"].as_table().into_iter().flatten();
    Ok(rows
        .filter(|(_, row)| {
            let new = !seen.contains(&row["pattern"]);
            seen.push(row["pattern"].clone());
            new
        })
        .map(|(name, _)| name.clone())
        .collect())
}
