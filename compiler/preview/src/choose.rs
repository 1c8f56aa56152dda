//! From a description to a look.

use crate::{
    WIDTH_MM,
    appearance::Appearance,
    color::{Rgb, lit, luminance, mix},
    description::{Description, Feel},
    noise::hash,
    pattern::Pattern,
    stems::stems,
    table::{Material, TABLE, Table},
    words::{VisualContent, read},
};

/// Wavelength at which a pattern has its own number of features, mm.
const USUAL_MM: f64 = 0.9;
/// Level at which a pattern has its own depth, dB re 1 (m/s²)².
const USUAL_DB: f64 = -4.0;
/// Friction at which a material has its own gloss.
const USUAL_MU: f64 = 0.45;
/// Centroid of a tap below which the fine grain blurs, Hz.
const SOFT_HZ: f64 = 300.0;

/// The pattern of a description and its look: what its words name, else what its neighbours are, else how it
/// feels.
pub(crate) fn choose(description: &Description<'_>) -> (Pattern, Appearance) {
    let table: &Table = &TABLE;
    let content = read(description.words, table);
    let material = match content.material {
        Some(material) => material.clone(),
        None => of_neighbours(description.nearest, table)
            .unwrap_or_else(|| of_feel(description.feel, table)),
    };
    let mut appearance = Appearance {
        colors: colors(&material, &content),
        cells: material.cells,
        fineness: 1.0,
        relief: material.relief,
        gloss: material.gloss,
        slick: content.gloss,
        grain: (48, 0.0),
        seed: seed(description),
    };
    if let Some(feel) = description.feel {
        felt(&mut appearance, feel);
    }
    graded(&mut appearance, description.coarser);
    (material.pattern, appearance)
}

/// Grain of another size, half as many decades as it is, so that a picture shows both ends of a scale.
fn graded(appearance: &mut Appearance, coarser: f64) {
    let finer = libm::pow(coarser.clamp(1e-4, 1e4), -0.5).clamp(0.35, 3.0);
    appearance.fineness *= finer as f32;
    let (cells, strength) = appearance.grain;
    appearance.grain = ((f64::from(cells) * finer) as i32, strength);
}

/// Level, wavelength, friction and hardness move the look within bounds that leave it the
/// material's.
fn felt(appearance: &mut Appearance, feel: Feel) {
    let finer = libm::pow(
        (USUAL_MM / feel.wavelength_mm.max(1e-3)).clamp(0.1, 10.0),
        0.12,
    );
    appearance.fineness = finer.clamp(0.85, 1.18) as f32;
    let louder = ((feel.level_db - USUAL_DB) / 24.0).clamp(-0.6, 0.6);
    appearance.relief *= (1.0 + 0.55 * louder) as f32;
    appearance.slick += (0.5 * (USUAL_MU - feel.mu)).clamp(-0.15, 0.15) as f32;
    let cells = (WIDTH_MM / feel.wavelength_mm.clamp(0.3, 12.0)) as i32;
    let soft = (feel.hard_hz / SOFT_HZ).clamp(0.3, 1.0);
    let strength = 0.0016 * ((feel.level_db + 30.0) / 30.0).clamp(0.0, 1.5) * soft;
    appearance.grain = (cells.clamp(5, 90), strength as f32);
}

/// Picks the pattern with the largest share, in the mixed colours of the neighbours that have it.
fn of_neighbours(nearest: &[(&str, f64)], table: &Table) -> Option<Material> {
    let found: Vec<(&Material, f64)> = nearest
        .iter()
        .filter_map(|(name, share)| {
            let material = table.material(&stems(name)).or_else(|| table.family(name));
            Some((material?, *share))
        })
        .collect();
    let share_of = |pattern: Pattern| -> f64 {
        let same = found.iter().filter(|(m, _)| m.pattern == pattern);
        same.map(|(_, share)| share).sum()
    };
    // Of equal shares the one that comes first, which is the nearest.
    let mut best: Option<(&Material, f64)> = None;
    for (material, _) in &found {
        let share = share_of(material.pattern);
        if best.is_none_or(|(_, old)| share > old) {
            best = Some((material, share));
        }
    }
    let (material, total) = best?;
    let mut mixed = material.clone();
    for (part, color) in mixed.colors.iter_mut().enumerate() {
        let mut sum = [0.0f32; 3];
        for (other, share) in found.iter().filter(|(m, _)| m.pattern == material.pattern) {
            let theirs = other
                .colors
                .get(part)
                .or(other.colors.last())
                .copied()
                .unwrap_or(*color);
            let weight = if total > 0.0 {
                (share / total) as f32
            } else {
                0.0
            };
            for (channel, value) in sum.iter_mut().zip(theirs) {
                *channel += weight * value;
            }
        }
        if total > 0.0 {
            *color = sum;
        }
    }
    Some(mixed)
}

/// A material that feels so, where nothing says what it is.
fn of_feel(feel: Option<Feel>, table: &Table) -> Material {
    let name = match feel {
        Some(f) if f.level_db > -6.0 && f.hard_hz > SOFT_HZ => "60-grit sandpaper",
        Some(f) if f.level_db > -12.0 => "exposed aggregate concrete",
        Some(f) if f.hard_hz < 0.5 * SOFT_HZ => "upholstery foam",
        Some(f) if f.mu < 0.25 => "glazed tile",
        _ => "grained dashboard",
    };
    let grey = Material {
        pattern: Pattern::Moulded,
        colors: vec![[0.22; 3]],
        cells: None,
        relief: 1.0,
        gloss: None,
    };
    table.material(&stems(name)).cloned().unwrap_or(grey)
}

/// The material's colours, dyed and brightened as the words say.
fn colors(material: &Material, content: &VisualContent<'_>) -> Vec<Rgb> {
    let dyed = dyed_parts(material.pattern);
    let base = material
        .colors
        .first()
        .map_or(0.5, |c| luminance(*c))
        .max(0.01);
    let parts = material.colors.iter().enumerate();
    parts
        .map(|(part, &color)| {
            let own = match content.color {
                Some(dye) if part < dyed => {
                    let ratio = libm::powf((luminance(color) / base).clamp(0.05, 20.0), 0.6);
                    let dye = lit(dye, ratio.clamp(0.35, 2.2));
                    mix(color, dye, 0.92)
                }
                _ => color,
            };
            lit(own, content.brightness).map(|c| c.min(0.97))
        })
        .collect()
}

/// Number of a pattern's parts that take a dye; mortar, ground and the backing seen through holes do not.
fn dyed_parts(pattern: Pattern) -> usize {
    match pattern {
        Pattern::Brick | Pattern::Tile => 2,
        Pattern::Denim
        | Pattern::Net
        | Pattern::Lace
        | Pattern::Mesh
        | Pattern::Holes
        | Pattern::Hexagons
        | Pattern::Lozenges
        | Pattern::Rings
        | Pattern::Bristles
        | Pattern::Print
        | Pattern::Marble
        | Pattern::Terrazzo
        | Pattern::Cracks
        | Pattern::Stubble => 1,
        _ => usize::MAX,
    }
}

/// A seed of the words and the texture's own.
fn seed(description: &Description<'_>) -> u32 {
    let words = stems(description.words).concat();
    let mut seed = hash(description.seed as i32, (description.seed >> 32) as i32, 1);
    for byte in words.bytes() {
        seed = hash(i32::from(byte), 2, seed);
    }
    // Room below the largest number for the patterns to count on from it.
    seed >> 4
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::parse;

    fn described<'a>(words: &'a str, nearest: &'a [(&'a str, f64)]) -> (Pattern, Appearance) {
        choose(&Description {
            words,
            coarser: 1.0,
            nearest,
            feel: None,
            seed: 0,
        })
    }

    #[test]
    fn unknown_words_take_one_pattern_of_the_neighbours() {
        let nearest = [
            ("velvet", 0.4),
            ("denim", 0.35),
            ("saddle hide", 0.15),
            ("smooth calf", 0.10),
        ];
        assert_eq!(described("xyzzy", &nearest).0, Pattern::Velvet);
        let leathers = [("denim", 0.35), ("saddle hide", 0.3), ("smooth calf", 0.3)];
        let (pattern, appearance) = described("xyzzy", &leathers);
        assert_eq!(pattern, Pattern::Leather, "two that agree outweigh one");
        let (a, b) = (parse("#8c4c24").unwrap(), parse("#7a3c20").unwrap());
        let between = (luminance(a) + luminance(b)) / 2.0;
        assert!((luminance(appearance.colors[0]) - between).abs() < 0.01);
    }

    #[test]
    fn a_known_word_outweighs_neighbours_and_a_family_stands_in() {
        assert_eq!(described("cork", &[("velvet", 1.0)]).0, Pattern::Cork);
        assert_eq!(described("xyzzy", &[("woods", 1.0)]).0, Pattern::Board);
    }

    #[test]
    fn a_dye_leaves_the_mortar() {
        let (red, blue) = (described("brick", &[]).1, described("blue brick", &[]).1);
        assert_eq!(red.colors[2], blue.colors[2]);
        assert!(blue.colors[0][2] > blue.colors[0][0] && red.colors[0][0] > red.colors[0][2]);
    }

    #[test]
    fn feel_moves_grain_depth_and_gloss() {
        let feel = Feel {
            wavelength_mm: 1.0,
            level_db: -4.0,
            mu: 0.5,
            hard_hz: 800.0,
        };
        let with = |feel: Feel| {
            choose(&Description {
                words: "leather",
                coarser: 1.0,
                nearest: &[],
                feel: Some(feel),
                seed: 0,
            })
            .1
        };
        let usual = with(feel);
        assert!(
            with(Feel {
                level_db: 6.0,
                ..feel
            })
            .relief
                > 1.1 * usual.relief
        );
        assert!(
            with(Feel {
                wavelength_mm: 0.3,
                ..feel
            })
            .fineness
                > usual.fineness
        );
        assert!(with(Feel { mu: 0.2, ..feel }).slick > usual.slick);
        assert!(
            with(Feel {
                hard_hz: 200.0,
                ..feel
            })
            .grain
            .1 < usual.grain.1
        );
    }

    #[test]
    fn the_same_words_and_seed_give_the_same_arrangement() {
        let of = |words: &str, seed| {
            choose(&Description {
                words,
                coarser: 1.0,
                nearest: &[],
                feel: None,
                seed,
            })
            .1
            .seed
        };
        assert_eq!(of("Red brick", 3), of("red bricks", 3));
        assert_ne!(of("red brick", 3), of("red brick", 4));
    }
}
