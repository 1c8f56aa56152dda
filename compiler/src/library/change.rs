//! Changes between two versions of a texture.

use crate::{
    emit::raise::raise,
    passes::{ceiling, reduce::Reference},
};
use asperity_formats::Asset;
use asperity_io::shown::counted;
use asperity_texture::model::{
    ContactLaw, Direction, FrictionLaw, TextureModel,
    attributes::{self, Attributes},
    mixture::{self, Field},
};
use serde::Serialize;
use std::fmt;

/// Changes between two versions of a texture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Change {
    /// Sections that differ, by their tags.
    pub sections: Vec<String>,
    /// RMS distance of the log spectra over 10–450 Hz, level included, dB: at 95 % of the places of
    /// the old grid, and at the worst. `None` where rates differ, or where one sounds and the other
    /// is silent.
    pub spectrum_db: Option<[f64; 2]>,
    /// Largest RMS of the vibration's force over the grid, N: old and new.
    pub vibration_n: [f64; 2],
    /// Largest force of a tap, N: old and new.
    pub tap_n: [f64; 2],
    /// Stiffness of the wall, N/m: old and new.
    pub stiffness_n_m: [f64; 2],
    /// Coefficient of friction: old and new.
    pub mu: [f64; 2],
    /// Its law over speed, factors of μ: old and new. Absent where neither has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<[Option<FrictionLaw>; 2]>,
    /// Depth under 1 N, mm: old and new. Absent where neither has a contact law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth_mm: Option<[f64; 2]>,
    /// Parts of the contact law that changed, by their names.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub contact: Vec<String>,
    /// Numbers of the direction that changed, by their names.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub direction: Vec<String>,
    /// What moved as far as a person notices: `rough`, `sharp`, `hard`, `slippery`, `soft`.
    pub felt: Vec<&'static str>,
    /// True if the picture changed.
    pub picture: bool,
    /// True if the change is haptic: in anything but picture, provenance, latent and history.
    pub haptic: bool,
}

impl Change {
    /// Compares two versions; `None` if they are equal.
    #[must_use]
    pub fn between(old: &Asset<'_>, new: &Asset<'_>) -> Option<Self> {
        let sections = sections(old, new);
        if sections.is_empty() {
            return None;
        }
        let haptic = sections
            .iter()
            .any(|tag| tag.starts_with(|first: char| first.is_ascii_uppercase()) && tag != "NAME");
        let (before, after) = (raise(old), raise(new));
        let both = |figure: fn(&TextureModel) -> f64| [figure(&before), figure(&after)];
        let gives_way = before.contact.is_some() || after.contact.is_some();
        let depth_mm = gives_way.then(|| both(depth_mm));
        let mut felt = felt(&attributes::of(&before), &attributes::of(&after));
        felt.extend(depth_mm.filter(is_softer_or_firmer).map(|_| "soft"));
        felt.extend(is_turned(before.direction, after.direction).then_some("direction"));
        Some(Self {
            spectrum_db: spectrum_db(&before, &after),
            vibration_n: both(|t| t.gains.vib_s2_m * t.gains.f_max_n * ceiling::loudest_m_s2(t)),
            tap_n: both(tap_n),
            stiffness_n_m: both(|t| t.wall.stiffness_n_m),
            mu: both(|t| t.friction.mu),
            law: (before.friction.law.is_some() || after.friction.law.is_some())
                .then(|| [&before, &after].map(|t| t.friction.law.clone())),
            depth_mm,
            contact: changed(before.contact.as_ref(), after.contact.as_ref()),
            direction: changed(before.direction.as_ref(), after.direction.as_ref()),
            felt,
            picture: old.preview_png() != new.preview_png(),
            haptic,
            sections,
        })
    }
}

/// Just-noticeable differences: level 1.6 dB, frequency 18 %, friction 10 %, compliance 20 %.
const NOTICED_DB: f64 = 1.6;
const NOTICED_FREQUENCY: f64 = 1.18;
const NOTICED_FRICTION: f64 = 1.1;
const NOTICED_COMPLIANCE: f64 = 1.2;

/// Depth under 1 N, mm, of what nothing pressed before.
fn depth_mm(texture: &TextureModel) -> f64 {
    let stiffness_n_m = texture.wall.stiffness_n_m;
    let wall = ContactLaw::default();
    texture
        .contact
        .as_ref()
        .unwrap_or(&wall)
        .pressed_mm(1.0, stiffness_n_m)
}

fn is_softer_or_firmer([old, new]: &[f64; 2]) -> bool {
    old.max(*new) >= NOTICED_COMPLIANCE * old.min(*new)
}

/// True if a stroke along an axis feels different.
fn is_turned(old: Option<Direction>, new: Option<Direction>) -> bool {
    let [old, new] = [old, new].map(|direction| direction.unwrap_or(Direction::NONE));
    let db = |direction: Direction| 10.0 * libm::log10(direction.power_ratio.max(1e-4));
    let apart = |old: f64, new: f64, least: f64| old.max(new) >= least * old.min(new);
    (db(old) - db(new)).abs() >= NOTICED_DB
        || apart(old.speed_ratio, new.speed_ratio, NOTICED_FREQUENCY)
        || apart(old.mu_forward, new.mu_forward, NOTICED_FRICTION)
        || apart(old.mu_backward, new.mu_backward, NOTICED_FRICTION)
}

/// The parts in which two laws or two directions differ.
fn changed<T: Serialize>(old: Option<&T>, new: Option<&T>) -> Vec<String> {
    let parts = |law: Option<&T>| match law.map(serde_json::to_value) {
        Some(Ok(serde_json::Value::Object(parts))) => parts,
        _ => serde_json::Map::new(),
    };
    let (old, new) = (parts(old), parts(new));
    let mut names: Vec<&String> = old.keys().chain(new.keys()).collect();
    names.sort();
    names.dedup();
    let changed = names
        .into_iter()
        .filter(|name| old.get(*name) != new.get(*name));
    changed.cloned().collect()
}

fn felt(old: &Attributes, new: &Attributes) -> Vec<&'static str> {
    let ln = |x: Option<f64>| x.map(libm::log);
    let (frequency, friction) = (libm::log(NOTICED_FREQUENCY), libm::log(NOTICED_FRICTION));
    let all = [
        ("rough", old.rough_db, new.rough_db, NOTICED_DB),
        ("sharp", ln(old.sharp_hz), ln(new.sharp_hz), frequency),
        ("hard", ln(old.hard_hz), ln(new.hard_hz), frequency),
        ("slippery", ln(Some(old.mu)), ln(Some(new.mu)), friction),
    ];
    let moved = |(name, old, new, least): (_, Option<f64>, Option<f64>, f64)| {
        let far = match (old, new) {
            (Some(old), Some(new)) => (new - old).abs() >= least,
            (old, new) => old.is_some() != new.is_some(),
        };
        far.then_some(name)
    };
    all.into_iter().filter_map(moved).collect()
}

fn sections(old: &Asset<'_>, new: &Asset<'_>) -> Vec<String> {
    let of = |asset: &Asset<'_>| -> Vec<([u8; 4], Vec<u8>)> {
        let body = |s| asset.section(&s).unwrap_or_default().to_vec();
        asset.sections().map(|s| (s.tag, body(s))).collect()
    };
    let (old, new) = (of(old), of(new));
    let mut tags: Vec<[u8; 4]> = Vec::new();
    for (mine, theirs) in [(&old, &new), (&new, &old)] {
        let changed = mine.iter().filter(|section| !theirs.contains(section));
        tags.extend(changed.map(|(tag, _)| *tag));
    }
    tags.sort_unstable();
    tags.dedup();
    tags.iter()
        .map(|tag| String::from_utf8_lossy(tag).into_owned())
        .collect()
}

fn spectrum_db(old: &TextureModel, new: &TextureModel) -> Option<[f64; 2]> {
    if old.grid == new.grid {
        return Some([0.0, 0.0]);
    }
    if old.grid.sample_rate_hz != new.grid.sample_rate_hz {
        return None;
    }
    // The places of a grid need an area, which a parsed one has.
    let field = Field::new(&new.grid);
    let inside = |&(v, f): &(f64, f64)| field.locate(v, f).is_some();
    if !mixture::places(&old.grid).iter().all(inside) {
        return None;
    }
    let distances = Reference::new(&old.grid)?.distances(&new.grid)?;
    let (p95, worst) = distances.summary();
    worst.is_finite().then_some([p95, worst])
}

fn tap_n(texture: &TextureModel) -> f64 {
    let samples = texture
        .taps
        .traces
        .iter()
        .flat_map(|trace| &trace.accel_m_s2);
    texture.gains.effective_mass_kg * samples.fold(0.0, |most: f64, a| most.max(a.abs()))
}

/// The figures that changed, in a line.
impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        match self.spectrum_db {
            Some([_, 0.0]) => {}
            Some([p95, worst]) => parts.push(format!(
                "spectra differ by {p95:.2} dB at 95 % of the grid, {worst:.2} dB at worst"
            )),
            None => parts.push("spectra cannot be compared".into()),
        }
        let pairs = [
            ("vibration", self.vibration_n, "N", 3),
            ("tap", self.tap_n, "N", 3),
            ("wall", self.stiffness_n_m, "N/m", 0),
            ("μ", self.mu, "", 3),
        ];
        for (what, [old, new], unit, digits) in pairs {
            if old != new {
                // With more digits where the usual ones show no difference.
                let differs = |n: &usize| format!("{old:.0$}", *n) != format!("{new:.0$}", *n);
                let digits = (digits..digits + 6).find(differs).unwrap_or(digits);
                let figure = format!("{what} {old:.digits$} → {new:.digits$} {unit}");
                parts.push(figure.trim_end().to_owned());
            }
        }
        if let Some([old, new]) = &self.law
            && old != new
        {
            let way = |law: &Option<FrictionLaw>| match law {
                Some(law) => counted(law.points.len(), "point", "points"),
                None => "constant".to_owned(),
            };
            parts.push(format!("μ over speed: {} → {}", way(old), way(new)));
        }
        if let Some([old, new]) = self.depth_mm
            && old != new
        {
            parts.push(format!("depth under 1 N {old:.1} → {new:.1} mm"));
        }
        if !self.contact.is_empty() {
            parts.push(format!("contact law: {}", self.contact.join(", ")));
        }
        if !self.direction.is_empty() {
            parts.push(format!("direction: {}", self.direction.join(", ")));
        }
        if self.picture {
            parts.push("picture changed".into());
        }
        if !self.felt.is_empty() {
            parts.push(format!("noticeable as {}", self.felt.join(", ")));
        }
        if parts.is_empty() {
            parts.push(format!("only in {}", self.sections.join(", ")));
        }
        f.write_str(&parts.join("; "))
    }
}
