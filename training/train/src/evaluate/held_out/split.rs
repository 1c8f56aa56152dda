//! Which materials a fold leaves out.

use crate::rng::Stream;
use std::collections::BTreeMap;

/// Positions of every fold's held-out materials, each ascending: every family is dealt
/// over the folds as evenly as it can be.
pub(super) fn stratified(families: &[&str], folds: usize, seed: u64) -> Vec<Vec<usize>> {
    let mut draws = Stream::seeded(seed);
    let mut parts = vec![Vec::new(); folds];
    let mut next = 0;
    for members in by_family(families).values_mut() {
        draws.shuffle(members);
        for &member in members.iter() {
            parts[next % folds].push(member);
            next += 1;
        }
    }
    sorted(parts)
}

/// The same, but whole families: largest first, each to the smallest fold so far.
pub(super) fn whole_families(families: &[&str], folds: usize, seed: u64) -> Vec<Vec<usize>> {
    let mut draws = Stream::seeded(seed);
    let mut groups: Vec<Vec<usize>> = by_family(families).into_values().collect();
    draws.shuffle(&mut groups);
    groups.sort_by_key(|members| std::cmp::Reverse(members.len()));
    let mut parts: Vec<Vec<usize>> = vec![Vec::new(); folds];
    for members in groups {
        if let Some(smallest) = parts.iter_mut().min_by_key(|part| part.len()) {
            smallest.extend(members);
        }
    }
    sorted(parts)
}

fn by_family<'f>(families: &[&'f str]) -> BTreeMap<&'f str, Vec<usize>> {
    let mut groups: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (index, family) in families.iter().enumerate() {
        groups.entry(family).or_default().push(index);
    }
    groups
}

fn sorted(mut parts: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    parts.iter_mut().for_each(|part| part.sort_unstable());
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn families() -> Vec<&'static str> {
        let names = ["a", "b", "c", "d", "e", "f"];
        (0..57).map(|n| names[(n * n) % 6]).collect()
    }

    #[test]
    fn every_material_is_held_out_once() {
        let families = families();
        for parts in [stratified(&families, 5, 1), whole_families(&families, 3, 1)] {
            let mut all = parts.concat();
            all.sort_unstable();
            assert_eq!(all, (0..families.len()).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_family_is_spread_evenly_or_not_at_all() {
        let families = families();
        let count =
            |part: &[usize], family| part.iter().filter(|&&i| families[i] == family).count();
        for family in ["a", "b", "d", "e"] {
            let spread = stratified(&families, 5, 1);
            let counts: Vec<usize> = spread.iter().map(|part| count(part, family)).collect();
            let (least, most) = (counts.iter().min(), counts.iter().max());
            assert!(most.unwrap() - least.unwrap() <= 1, "{counts:?}");
            let whole = whole_families(&families, 3, 1);
            assert_eq!(
                whole.iter().filter(|part| count(part, family) > 0).count(),
                1
            );
        }
    }

    #[test]
    fn another_seed_splits_otherwise() {
        assert_ne!(stratified(&families(), 5, 1), stratified(&families(), 5, 2));
    }
}
