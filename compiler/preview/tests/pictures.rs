//! Properties of every picture.

use asperity_preview::{COMPACT_BYTES, Description, Feel, Picture, SIZE, SIZES};

/// A prompt for every class of pattern that a material of the corpora has.
fn names() -> Vec<String> {
    let table: toml::Table = include_str!("../data/materials.toml")
        .parse()
        .expect("the table");
    let rows = table["material"].as_table().expect("rows");
    let mut seen = Vec::new();
    let first = rows.iter().filter(|(_, row)| {
        let pattern = row["pattern"].as_str().map(str::to_owned);
        let new = !seen.contains(&pattern);
        seen.push(pattern);
        new
    });
    first.map(|(name, _)| name.clone()).collect()
}

fn draw(words: &str, size: u32, seed: u64) -> Picture {
    let description = Description {
        words,
        coarser: 1.0,
        nearest: &[],
        feel: None,
        seed,
    };
    Picture::draw(&description, size).expect("a picture")
}

fn luma(pixel: &[u8; 3]) -> i32 {
    i32::from(pixel[0]) + 2 * i32::from(pixel[1]) + i32::from(pixel[2])
}

#[test]
fn every_material_of_the_corpora_has_a_row() {
    let rows: toml::Table = include_str!("../data/materials.toml")
        .parse()
        .expect("the table");
    let rows = rows["material"].as_table().expect("rows");
    let corpora = concat!(env!("CARGO_MANIFEST_DIR"), "/../../training/corpora");
    let mut materials = 0;
    for entry in std::fs::read_dir(corpora).expect("the corpora") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let file: toml::Table = std::fs::read_to_string(&path)
            .expect("a corpus")
            .parse()
            .expect("TOML");
        let listed = file.get("material").and_then(|list| list.as_array());
        for material in listed.into_iter().flatten() {
            let name = material["name"].as_str().expect("a name");
            assert!(
                rows.contains_key(name),
                "{name} of {} has no row",
                path.display()
            );
            materials += 1;
        }
    }
    assert!(materials >= 350, "{materials}");
}

#[test]
fn each_pattern_fits_an_asset_and_gives_the_same_bytes_twice() {
    for name in names() {
        let png = draw(&name, SIZE, 0).compact_png().expect("a PNG");
        assert!(png.len() <= COMPACT_BYTES, "{name}: {} bytes", png.len());
        let small = || draw(&name, 64, 0).compact_png().expect("a PNG");
        assert_eq!(small(), small(), "{name}");
    }
}

#[test]
fn each_pattern_goes_on_over_its_border() {
    // The end of a trunk shows one thing: it repeats, with a seam.
    let whole = ["tree stump"];
    for name in names()
        .iter()
        .filter(|name| !whole.contains(&name.as_str()))
    {
        let picture = draw(name, 128, 1);
        let (n, pixels) = (128, picture.pixels());
        // The step over the border is like the steps inside.
        let step = |from: usize, to: usize, by_row: bool| -> f64 {
            let at = |k: usize, x: usize| {
                if by_row {
                    luma(&pixels[x * n + k])
                } else {
                    luma(&pixels[k * n + x])
                }
            };
            (0..n)
                .map(|x| f64::from((at(from, x) - at(to, x)).abs()))
                .sum::<f64>()
                / n as f64
        };
        for by_row in [true, false] {
            let inside = (0..n - 1)
                .map(|k| step(k, k + 1, by_row))
                .fold(0.0, f64::max);
            let over = step(n - 1, 0, by_row);
            assert!(
                over <= 1.25 * inside + 6.0,
                "{name}: {over} over the border, {inside} inside"
            );
        }
    }
}

#[test]
fn a_picture_at_another_size_is_the_same_picture() {
    for name in ["cork", "brick", "denim", "tree bark", "velvet"] {
        let (small, large) = (draw(name, 128, 0), draw(name, 512, 0));
        // Means over 8 × 8 fields.
        let fields = |picture: &Picture| -> Vec<f64> {
            let n = picture.size() as usize;
            let mut sums = vec![0.0; 64];
            for (k, pixel) in picture.pixels().iter().enumerate() {
                sums[k / n * 8 / n * 8 + k % n * 8 / n] += f64::from(luma(pixel));
            }
            sums.iter().map(|sum| sum / (n * n / 64) as f64).collect()
        };
        for (a, b) in fields(&small).iter().zip(fields(&large)) {
            assert!((a - b).abs() < 90.0, "{name}: {a} and {b} of 1020");
        }
    }
}

#[test]
fn seeds_and_feel_change_a_picture_and_leave_the_material() {
    let feel = |level_db| {
        let feel = Feel {
            wavelength_mm: 1.0,
            level_db,
            mu: 0.4,
            hard_hz: 900.0,
        };
        let description = Description {
            words: "leather",
            coarser: 1.0,
            nearest: &[],
            feel: Some(feel),
            seed: 0,
        };
        Picture::draw(&description, 128).expect("a picture")
    };
    assert_ne!(draw("cork", 64, 1).pixels(), draw("cork", 64, 2).pixels());
    let contrast = |picture: &Picture| {
        let mean = picture.pixels().iter().map(luma).sum::<i32>() / (128 * 128);
        picture
            .pixels()
            .iter()
            .map(|p| i64::from((luma(p) - mean).pow(2)))
            .sum::<i64>()
    };
    assert!(
        contrast(&feel(8.0)) > contrast(&feel(-16.0)) * 11 / 10,
        "louder is deeper"
    );
}

#[test]
fn words_in_any_script_and_length_give_a_picture() {
    for words in [
        "",
        "木",
        "🧱🧱",
        "a\u{0}b\u{202e}",
        &"cork ".repeat(5000),
        "-- ,,, ..",
        "ΒΕΛΟΎΔΟ",
    ] {
        assert_eq!(draw(words, 64, u64::MAX).size(), 64);
    }
    let description = Description {
        words: "x",
        coarser: 1.0,
        nearest: &[("cork", f64::NAN), ("oak", -1.0)],
        feel: None,
        seed: 0,
    };
    assert!(Picture::draw(&description, 64).is_ok());
    let feel = Feel {
        wavelength_mm: f64::NAN,
        level_db: f64::INFINITY,
        mu: -1.0,
        hard_hz: 0.0,
    };
    let description = Description {
        feel: Some(feel),
        ..description
    };
    assert!(Picture::draw(&description, 64).is_ok());
    for size in [0, SIZES.start() - 1, SIZES.end() + 1, u32::MAX] {
        assert!(Picture::draw(&description, size).is_err());
    }
}

#[test]
fn normals_lean_away_from_what_rises_with_green_up() {
    let picture = draw("string of pearls", 128, 0);
    let decoded = |bytes: Vec<u8>| {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
            .read_info()
            .expect("a PNG");
        let mut data = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut data).expect("a frame");
        data
    };
    let heights = decoded(picture.height_png().expect("a map"));
    let normals = decoded(picture.normal_png().expect("a map"));
    let height = |x: usize, y: usize| {
        let at = 2 * (y * 128 + x);
        i32::from(u16::from_be_bytes([heights[at], heights[at + 1]]))
    };
    let (mut right, mut down) = (0, 0);
    for y in 1..127 {
        for x in 1..127 {
            let normal = &normals[3 * (y * 128 + x)..][..3];
            let rise = height(x + 1, y) - height(x - 1, y);
            if rise.abs() > 2000 {
                assert_eq!(normal[0] < 128, rise > 0, "red at {x}, {y}");
                right += 1;
            }
            let rise = height(x, y + 1) - height(x, y - 1);
            if rise.abs() > 2000 {
                assert_eq!(normal[1] >= 128, rise > 0, "green at {x}, {y}");
                down += 1;
            }
        }
    }
    assert!(right > 1000 && down > 1000, "{right} {down}");
}
