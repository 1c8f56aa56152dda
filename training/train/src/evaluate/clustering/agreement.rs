//! Agreement of two labellings, by chance-corrected pair counts and by information.

use std::collections::BTreeMap;

/// Adjusted Rand index (Hubert and Arabie, 1985): 1 for the same partition, 0 on average
/// for chance.
pub(super) fn adjusted_rand(x: &[usize], y: &[usize]) -> f64 {
    let table = Table::of(x, y);
    let pairs = |count: f64| 0.5 * count * (count - 1.0);
    let total = pairs(table.total);
    let together: f64 = table.cells.values().map(|&n| pairs(n)).sum();
    let in_x: f64 = table.rows.values().map(|&n| pairs(n)).sum();
    let in_y: f64 = table.columns.values().map(|&n| pairs(n)).sum();
    if total == 0.0 {
        return 1.0;
    }
    let expected = in_x * in_y / total;
    let most = 0.5 * (in_x + in_y);
    if most == expected {
        1.0
    } else {
        (together - expected) / (most - expected)
    }
}

/// Mutual information over the arithmetic mean of the entropies: 0 to 1.
pub(super) fn normalised_mutual_information(x: &[usize], y: &[usize]) -> f64 {
    let table = Table::of(x, y);
    let entropy = |counts: &BTreeMap<usize, f64>| -> f64 {
        let shares = counts.values().map(|n| n / table.total);
        -shares.map(|p| p * libm::log(p)).sum::<f64>()
    };
    let information: f64 = table
        .cells
        .iter()
        .map(|(&(i, j), &n)| {
            n / table.total * libm::log(n * table.total / (table.rows[&i] * table.columns[&j]))
        })
        .sum();
    let scale = 0.5 * (entropy(&table.rows) + entropy(&table.columns));
    if scale > 0.0 {
        information / scale
    } else {
        1.0
    }
}

/// Contingency table of two labellings.
struct Table {
    cells: BTreeMap<(usize, usize), f64>,
    rows: BTreeMap<usize, f64>,
    columns: BTreeMap<usize, f64>,
    total: f64,
}

impl Table {
    fn of(x: &[usize], y: &[usize]) -> Self {
        let mut table = Self {
            cells: BTreeMap::new(),
            rows: BTreeMap::new(),
            columns: BTreeMap::new(),
            total: 0.0,
        };
        for (&i, &j) in x.iter().zip(y) {
            *table.cells.entry((i, j)).or_default() += 1.0;
            *table.rows.entry(i).or_default() += 1.0;
            *table.columns.entry(j).or_default() += 1.0;
            table.total += 1.0;
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_the_textbook() {
        let (x, y) = ([0, 0, 1, 1], [0, 0, 1, 2]);
        // scikit-learn's examples.
        assert!((adjusted_rand(&x, &y) - 0.571_428).abs() < 1e-5);
        assert!((normalised_mutual_information(&x, &y) - 0.8).abs() < 1e-9);
        assert_eq!(adjusted_rand(&x, &[1, 1, 0, 0]), 1.0);
        assert!((normalised_mutual_information(&x, &[1, 1, 0, 0]) - 1.0).abs() < 1e-12);
    }
}
