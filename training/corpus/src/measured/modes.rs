//! Measured modes of struck objects, held against those of the generator's taps.
//!
//! Ten of the fourteen materials set
//! the constants of [`asperity::signal::impact`]; every third in alphabetical order was kept out of that.

use crate::generator::Physical;
use asperity::signal::impact::Impact;
use std::collections::BTreeMap;

const MODES_CSV: &str = include_str!("../../../corpora/measured/modes.csv");
/// Band of the modes that a trace at 10 kHz can hold, Hz.
const BAND_HZ: (f64, f64) = (100.0, 5000.0);
/// A mode this far below an object's strongest is not its first, dB.
const FIRST_WITHIN_DB: f64 = 20.0;

/// A measured material, the material of the reference corpus that it is compared with, and whether it
/// was kept out of the fit.
pub const PAIRS: [(&str, &str, bool); 14] = [
    ("cardboard", "corrugated cardboard", false),
    ("ceramic", "porcelain", false),
    ("fabric", "cotton shirt", true),
    ("glass", "window glass", false),
    ("leather", "smooth calf", false),
    ("metal", "galvanised steel", true),
    ("paper", "printer paper", false),
    ("plastic_hard", "ABS", false),
    ("plastic_soft_foam", "EVA foam mat", true),
    ("rubber", "ribbed rubber mat", false),
    ("stone", "polished granite", false),
    ("wood_hard", "varnished oak", true),
    ("wood_medium", "waxed walnut", false),
    ("wood_soft", "planed pine", false),
];

/// A mode of a struck object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Frequency, Hz.
    pub freq_hz: f64,
    /// Onset power, dB.
    pub level_db: f64,
    /// Time in which it falls by 60 dB, s.
    pub decay_s: f64,
}

/// The first mode of a material: geometric means over its objects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct First {
    /// Frequency, Hz.
    pub freq_hz: f64,
    /// Time in which it falls by 60 dB, s.
    pub decay_s: f64,
    /// Objects.
    pub objects: usize,
}

/// Modes by material and object. A line that is no mode is skipped; a test counts them.
#[must_use]
pub fn modes() -> BTreeMap<(&'static str, &'static str), Vec<Mode>> {
    let mut objects: BTreeMap<_, Vec<Mode>> = BTreeMap::new();
    for line in MODES_CSV.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let &[material, object, freq_hz, level_db, decay_s] = fields.as_slice() else {
            continue;
        };
        let (Ok(freq_hz), Ok(level_db), Ok(decay_s)) =
            (freq_hz.parse(), level_db.parse(), decay_s.parse())
        else {
            continue;
        };
        let mode = Mode {
            freq_hz,
            level_db,
            decay_s,
        };
        objects.entry((material, object)).or_default().push(mode);
    }
    objects
}

/// The first mode of a measured material: the lowest from 100 Hz to 5 kHz within 20 dB of the
/// strongest there, over its objects. `None` for an unknown material.
#[must_use]
pub fn first(material: &str) -> Option<First> {
    let (low, high) = BAND_HZ;
    let (mut log_freq, mut log_decay, mut objects) = (0.0, 0.0, 0);
    for ((name, _), modes) in modes() {
        if name != material {
            continue;
        }
        let band = || modes.iter().filter(|m| (low..high).contains(&m.freq_hz));
        let strongest = band().map(|m| m.level_db).fold(f64::NEG_INFINITY, f64::max);
        let first = band()
            .filter(|m| m.level_db >= strongest - FIRST_WITHIN_DB)
            .min_by(|a, b| a.freq_hz.total_cmp(&b.freq_hz));
        if let Some(first) = first {
            log_freq += libm::log(first.freq_hz);
            log_decay += libm::log(first.decay_s);
            objects += 1;
        }
    }
    let count = objects as f64;
    (objects > 0).then(|| First {
        freq_hz: libm::exp(log_freq / count),
        decay_s: libm::exp(log_decay / count),
        objects,
    })
}

/// The first mode of the generator's taps.
#[must_use]
pub fn generated(physical: &Physical) -> First {
    let mode = Impact::of_material(physical.modulus_mpa, physical.loss_factor).modes[0];
    First {
        freq_hz: mode.freq_hz,
        decay_s: mode.decay_s,
        objects: 1,
    }
}
