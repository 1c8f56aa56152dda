//! Grids whose numbers cannot be in the units of their keys.

use asperity_recording::check::{LOADS_N, SPEEDS_MM_S};
use asperity_texture::model::{GridVertex, TextureModel, attributes};

/// Level of the stated stroke below which nobody feels a vibration, dB re 1 m/s²: the threshold at 200 Hz is about −40 dB
/// (ISO 13091-1).
const LEAST_DB: f64 = -60.0;

/// A warning for every quantity whose largest value no hand has, or that nobody feels.
pub(super) fn doubts(texture: &TextureModel) -> Vec<String> {
    let grid = &texture.grid;
    let largest = |of: fn(&GridVertex) -> f64| grid.vertices.iter().map(of).fold(0.0, f64::max);
    let speed_mm_s = largest(|vertex| vertex.speed_mm_s);
    let force_n = largest(|vertex| vertex.force_n);
    let ranges = [
        (
            "speed_mm_s",
            "mm/s",
            speed_mm_s,
            SPEEDS_MM_S,
            ["slower", "faster"],
        ),
        ("force_n", "N", force_n, LOADS_N, ["lighter", "heavier"]),
    ];
    let beyond = ranges.into_iter().filter_map(|(key, unit, value, range, words)| {
        let (word, other) = if value < range.0 {
            (words[0], "1,000 times larger")
        } else if value > range.1 {
            (words[1], "1,000 times smaller")
        } else {
            return None;
        };
        Some(format!(
            "grid.vertices: the largest {key} is {value} {unit}, {word} than a hand; if the unit is wrong, values in \
             {unit} are {other}"
        ))
    });
    let quiet = attributes::of(texture)
        .rough_db
        .filter(|level_db| *level_db < LEAST_DB)
        .map(|level_db| {
            format!(
                "grid.vertices: a usual stroke vibrates at {level_db:.0} dB re 1 m/s², which nobody feels; sigma_m_s2 is in \
                 m/s², 9.81 times the value in g"
            )
        });
    beyond.chain(quiet).collect()
}
