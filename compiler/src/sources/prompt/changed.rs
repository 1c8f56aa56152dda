//! Attribute changes relative to a base, as a phrase states them.

use super::phrase::{Change, Changes};
use asperity_texture::model::{
    attributes::Attributes,
    shift::{Scales, Shift, scales, to},
};

/// Step of a change: roughness in dB, slipperiness as −ln μ, hardness as ln of the centroid. Half a step is noticed
/// (amplitude 1.6 dB, frequency 18 %, friction 10 %).
pub const STEP: [f64; 3] = [5.0, 0.35, 0.42];

/// Returns `said`, clamped so that it differs from its base by the stated changes.
#[must_use]
pub fn changed(base: &Scales, said: &Scales, changes: &Changes) -> Scales {
    let changes = [changes.rough, changes.slippery, changes.hard];
    std::array::from_fn(|k| {
        let moved = || {
            let (change, base, said): (Change, f64, f64) = (changes[k]?, base[k]?, said[k]?);
            let steps = (said - base) / STEP[k];
            Some(base + STEP[k] * steps.clamp(change.least, change.most))
        };
        moved().or(said[k])
    })
}

/// Returns the shift after which a texture differs from its base by the stated changes.
#[must_use]
pub fn from_base(base: &Attributes, now: &Attributes, changes: &Changes) -> Shift {
    to(&changed(&scales(base), &scales(now), changes), now)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;
    use asperity_texture::model::attributes;

    #[test]
    fn what_was_learned_is_kept_within_the_range() {
        let base = attributes::of(&builtin::texture());
        let change = Change {
            least: 1.0,
            most: 1.3,
        };
        let changes = Changes {
            rough: Some(change),
            ..Changes::default()
        };
        for (learned_db, steps) in [(-3.0, 1.0), (5.5, 1.1), (30.0, 1.3)] {
            let rough_db = base.rough_db.map(|db| db + learned_db);
            let learned = Attributes { rough_db, ..base };
            let shift = from_base(&base, &learned, &changes);
            let moved = learned_db + shift.rough_db;
            assert!((moved - 5.0 * steps).abs() < 1e-9, "{learned_db}");
            assert_eq!((shift.slippery, shift.hard), (0.0, 0.0));
        }
    }
}
