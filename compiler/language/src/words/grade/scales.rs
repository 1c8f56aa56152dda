//! Conversion of the numbers to units of length, or to the scales of the attributes.

use super::{Grade, Scale};

/// FEPA 43-1 and 43-2 (ISO 6344): number of a P grade, mean diameter of its grain, µm.
const FEPA_P: &[(f64, f64)] = &[
    (12.0, 1815.0),
    (16.0, 1324.0),
    (20.0, 1000.0),
    (24.0, 764.0),
    (30.0, 642.0),
    (36.0, 538.0),
    (40.0, 425.0),
    (50.0, 336.0),
    (60.0, 269.0),
    (80.0, 201.0),
    (100.0, 162.0),
    (120.0, 125.0),
    (150.0, 100.0),
    (180.0, 82.0),
    (220.0, 68.0),
    (240.0, 58.5),
    (280.0, 52.2),
    (320.0, 46.2),
    (360.0, 40.5),
    (400.0, 35.0),
    (500.0, 30.2),
    (600.0, 25.8),
    (800.0, 21.8),
    (1000.0, 18.3),
    (1200.0, 15.3),
    (1500.0, 12.6),
    (2000.0, 10.3),
    (2500.0, 8.4),
];
/// JIS R 6001-2: number of a precision grade, median diameter of its grain, µm.
const JIS: &[(f64, f64)] = &[
    (240.0, 57.0),
    (280.0, 48.0),
    (320.0, 40.0),
    (360.0, 35.0),
    (400.0, 30.0),
    (500.0, 25.0),
    (600.0, 20.0),
    (700.0, 17.0),
    (800.0, 14.0),
    (1000.0, 11.5),
    (1200.0, 9.5),
    (1500.0, 8.0),
    (2000.0, 6.7),
    (2500.0, 5.5),
    (3000.0, 4.0),
    (4000.0, 3.0),
    (6000.0, 2.0),
    (8000.0, 1.2),
];
/// ASTM E11 (ISO 565): number of a sieve, its opening, µm.
const SIEVES: &[(f64, f64)] = &[
    (4.0, 4750.0),
    (6.0, 3350.0),
    (8.0, 2360.0),
    (10.0, 2000.0),
    (12.0, 1700.0),
    (16.0, 1180.0),
    (20.0, 850.0),
    (30.0, 600.0),
    (40.0, 425.0),
    (50.0, 300.0),
    (60.0, 250.0),
    (70.0, 212.0),
    (80.0, 180.0),
    (100.0, 150.0),
    (140.0, 106.0),
    (200.0, 75.0),
    (270.0, 53.0),
    (325.0, 45.0),
    (400.0, 38.0),
    (500.0, 25.0),
    (635.0, 20.0),
];

/// Sandpaper that the model knows: its grain, µm, and its name.
pub const PAPERS: [(f64, &str); 5] = [
    (269.0, "60-grit sandpaper"),
    (125.0, "120-grit sandpaper"),
    (68.0, "220-grit sandpaper"),
    (35.0, "400-grit sandpaper"),
    (18.3, "1000-grit wet-and-dry paper"),
];

/// Names of sharpening stones, which are graded by JIS.
const STONES: &[&str] = &[
    "stone",
    "whetstone",
    "waterstone",
    "oilstone",
    "hone",
    "diamond",
    "ceramic",
    "plate",
    "steel",
];
/// Things whose own grain is known, the first that a name holds: its words, and the grade that it has
/// where none is said.
const GRAINS: &[(&[&str], f64)] = &[
    (STONES, 11.5),
    (&["wheel", "disc", "disk", "grinder"], 269.0),
    (&["belt"], 201.0),
    (&["sponge", "block", "pad"], 125.0),
    (
        &["sieve", "screen", "mesh", "gauze", "wire", "net", "netting"],
        2000.0,
    ),
    (&["powder", "flour", "dust"], 75.0),
    (&["gravel", "pebble", "pebbles", "chippings"], 8000.0),
    (
        &["sand", "salt", "sugar", "beads", "grit", "shot", "garnet"],
        425.0,
    ),
];
/// Grain of sandpaper of no said grade, µm.
const PAPER: f64 = 100.0;

/// Returns true for a name of sandpaper in general, which the model knows by its grades.
#[must_use]
pub fn is_paper(name: &str) -> bool {
    const NAMES: &[&str] = &[
        "sandpaper",
        "sand paper",
        "sheet of sandpaper",
        "piece of sandpaper",
        "glasspaper",
        "abrasive paper",
        "abrasive sheet",
        "sanding paper",
        "wet and dry paper",
        "paper",
    ];
    NAMES.contains(&name)
}

/// Returns true if a number beside a name is its grit.
pub(crate) fn is_abrasive(name: &str) -> bool {
    const WORDS: &[&str] = &[
        "sandpaper",
        "glasspaper",
        "emery",
        "sanding",
        "abrasive",
        "whetstone",
        "waterstone",
        "grinding",
    ];
    let says = name.split(' ').any(|word| WORDS.contains(&word));
    says || (is_paper(name) && name != "paper")
}

/// Grain of a material where none is stated, µm.
#[must_use]
pub fn own_grain_um(name: &str) -> f64 {
    let holds = |words: &&(&[&str], f64)| name.split(' ').any(|word| words.0.contains(&word));
    GRAINS.iter().find(holds).map_or(PAPER, |(_, um)| *um)
}

/// Grain of a grit, µm: by JIS for stones, by FEPA for all else, as grit without a letter is sold.
#[must_use]
pub fn grit_um(number: f64, name: &str) -> f64 {
    let stone = name.split(' ').any(|word| STONES.contains(&word));
    // JIS numbers its macrogrits as FEPA does.
    let fine = number >= JIS[0].0;
    interpolated(if stone && fine { JIS } else { FEPA_P }, number)
}

/// Opening of a sieve, µm.
fn mesh_um(number: f64) -> f64 {
    interpolated(SIEVES, number)
}

/// Ra of a metal of which nothing is said: ground, µm.
const GROUND_UM: f64 = 0.8;
/// Threads of a plain bed sheet.
const SHEET: f64 = 200.0;
/// Denier of plain nylon.
const NYLON: f64 = 40.0;
/// Teeth of a plain file per inch.
const BASTARD: f64 = 30.0;
/// Ribs of plain corduroy per inch.
const CORDUROY: f64 = 11.0;
/// Pile of a plain carpet, mm.
const CARPET_MM: f64 = 8.0;

impl Grade {
    /// Returns the ratio of the relief to the named material's own; 1 for numbers that do not concern relief.
    #[must_use]
    pub fn coarser(self, name: &str) -> f64 {
        match self.scale {
            Scale::Grit { .. } => grit_um(self.value, name) / own_grain_um(name),
            Scale::Mesh => mesh_um(self.value) / own_grain_um(name),
            Scale::Ra => self.value / GROUND_UM,
            // Twice the threads are half as far apart; four times the denier are twice as thick.
            Scale::Threads => SHEET / self.value,
            Scale::Denier => (self.value / NYLON).sqrt(),
            Scale::Cut => BASTARD / self.value,
            Scale::Wale => CORDUROY / self.value,
            Scale::Pile => (self.value / CARPET_MM).sqrt(),
            Scale::ShoreA | Scale::ShoreD | Scale::Mohs => 1.0,
        }
    }
}

/// A table between its lines and beyond its ends, straight in logarithms.
fn interpolated(table: &[(f64, f64)], x: f64) -> f64 {
    let after = table.iter().position(|(knot, _)| *knot >= x);
    let after = after.unwrap_or(table.len() - 1).max(1);
    let [(x0, y0), (x1, y1)] =
        [table[after - 1], table[after]].map(|(x, y)| (libm::log(x), libm::log(y)));
    libm::exp(y0 + (libm::log(x) - x0) / (x1 - x0) * (y1 - y0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_fall_and_go_on_beyond_their_ends() {
        for table in [FEPA_P, JIS, SIEVES] {
            assert!(
                table
                    .windows(2)
                    .all(|pair| pair[0].0 < pair[1].0 && pair[0].1 > pair[1].1)
            );
            for (number, um) in table {
                assert!((interpolated(table, *number) / um - 1.0).abs() < 1e-12);
            }
            let (last, um) = table[table.len() - 1];
            assert!((0.2 * um..um).contains(&interpolated(table, 2.0 * last)));
        }
    }

    #[test]
    fn stones_are_graded_by_jis() {
        assert_eq!(grit_um(1000.0, "whetstone").round(), 12.0);
        assert_eq!(grit_um(1000.0, "sandpaper").round(), 18.0);
        assert_eq!(grit_um(120.0, "oilstone"), grit_um(120.0, "sandpaper"));
    }

    /// Claim: a grain is as coarse as the material's own where it has its size, and by as much coarser
    /// as it is larger.
    #[test]
    fn coarser_is_a_ratio_of_grains() {
        let coarser = |scale, value, name| Grade { scale, value }.coarser(name);
        let (p, mesh) = (Scale::Grit { p: true }, Scale::Mesh);
        let paper = coarser(p, 150.0, "sandpaper");
        assert!((0.8..1.2).contains(&paper), "P150 is sandpaper: {paper}");
        let ratio = coarser(p, 80.0, "sandpaper") / coarser(p, 150.0, "sandpaper");
        assert!((ratio - grit_um(80.0, "sandpaper") / grit_um(150.0, "sandpaper")).abs() < 1e-12);
        let sand = coarser(mesh, 40.0, "sand");
        assert!((0.8..1.2).contains(&sand), "mesh 40 is sand: {sand}");
        assert!(coarser(mesh, 20.0, "sand") > 1.5 && coarser(mesh, 80.0, "sand") < 0.7);
    }

    #[test]
    fn paper_is_what_is_graded_as_paper() {
        assert!(["sandpaper", "abrasive paper"].into_iter().all(is_paper));
        assert!(!["wallpaper", "cork", "sand", ""].into_iter().any(is_paper));
    }
}
