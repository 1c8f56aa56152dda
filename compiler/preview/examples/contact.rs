//! A contact sheet: one tile a prompt.
//!
//! `cargo run --release -p asperity-preview --example contact -- sheet.png [PROMPT …]`

use asperity_preview::{Description, Picture};
use std::{env, error::Error, fs, time::Instant};

/// Prompts of the contact sheet in `docs/preview.md`.
const PROMPTS: [&str; 30] = [
    "cork",
    "velvet",
    "brushed metal",
    "sandpaper",
    "foam",
    "brick",
    "wire mesh",
    "leather",
    "wood",
    "ice",
    "denim",
    "marble",
    "gravel",
    "grass",
    "towel",
    "ceramic tile",
    "rubber",
    "paper",
    "glass",
    "wool",
    "sponge",
    "silk",
    "carpet",
    "concrete",
    "bark",
    "plastic",
    "cardboard",
    "felt",
    "sand",
    "snow",
];
/// Pixels of a tile, of a gap between two.
const TILE: usize = 168;
const GAP: usize = 8;
const COLUMNS: usize = 6;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let file = arguments
        .next()
        .ok_or("usage: contact SHEET.png [PROMPT …]")?;
    let named: Vec<String> = arguments.collect();
    let prompts: Vec<&str> = if named.is_empty() {
        PROMPTS.to_vec()
    } else {
        named.iter().map(String::as_str).collect()
    };
    let rows = prompts.len().div_ceil(COLUMNS);
    let columns = prompts.len().min(COLUMNS);
    let (width, height) = (columns * (TILE + GAP) + GAP, rows * (TILE + GAP) + GAP);
    let mut sheet = vec![255u8; 3 * width * height];
    for (k, prompt) in prompts.iter().enumerate() {
        let began = Instant::now();
        let description = Description {
            words: prompt,
            coarser: 1.0,
            nearest: &[],
            feel: None,
            seed: 0,
        };
        let picture = Picture::draw(&description, TILE as u32)?;
        let drawn = began.elapsed();
        let bytes = picture.compact_png()?;
        println!(
            "{:2} {prompt:24} {:6} bytes, drawn in {:5.1} ms, packed in {:5.1} ms",
            k + 1,
            bytes.len(),
            1e3 * drawn.as_secs_f64(),
            1e3 * (began.elapsed() - drawn).as_secs_f64()
        );
        // What is shown is what an asset holds.
        let pixels = decoded(&bytes)?;
        let (left, top) = (
            GAP + k % COLUMNS * (TILE + GAP),
            GAP + k / COLUMNS * (TILE + GAP),
        );
        for (y, row) in pixels.chunks(3 * TILE).enumerate() {
            let start = 3 * ((top + y) * width + left);
            sheet[start..start + row.len()].copy_from_slice(row);
        }
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(&sheet)?;
    fs::write(&file, bytes)?;
    Ok(())
}

fn decoded(bytes: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info()?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("too large")?];
    reader.next_frame(&mut pixels)?;
    Ok(pixels)
}
