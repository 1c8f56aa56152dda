//! The rows as tables of the documentation, one table for each quantity.

use super::row::{Figure, ScenarioResult, Verdict};
use std::fmt::Write as _;

/// Markdown of the rows, in their order.
///
/// Each theme has a heading, each quantity a table with a column for every method that any of
/// its rows tries. Skipped rows are marked.
#[must_use]
pub fn tables(rows: &[ScenarioResult]) -> String {
    let mut text = String::new();
    for theme in rows.chunk_by(|x, y| x.theme == y.theme) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "## {}\n", theme[0].theme);
        for quantity in theme.chunk_by(|x, y| x.quantity == y.quantity) {
            table(&mut text, quantity);
        }
    }
    text
}

fn table(text: &mut String, rows: &[ScenarioResult]) {
    let mut methods: Vec<&str> = Vec::new();
    for other in rows.iter().flat_map(|row| &row.others) {
        if !methods.contains(&other.method) {
            methods.push(other.method);
        }
    }
    let header: String = methods
        .iter()
        .map(|method| format!(" {method} |"))
        .collect();
    let mut quantity = rows[0].quantity.chars();
    let first = quantity.next().map(|c| c.to_uppercase().to_string());
    let first = first.unwrap_or_default();
    let _ = writeln!(text, "{first}{}:\n", quantity.as_str());
    let _ = writeln!(text, "| scenario | ours | at most |{header}");
    let _ = writeln!(text, "|---|---:|---:|{}", "---:|".repeat(methods.len()));
    for row in rows {
        if let Verdict::Skipped(reason) = &row.verdict {
            let _ = writeln!(
                text,
                "| {} | skipped: {reason} | |{}",
                row.scenario,
                " |".repeat(methods.len())
            );
            continue;
        }
        let _ = write!(
            text,
            "| {} | {} | {} |",
            row.scenario,
            Figure(row.ours),
            Figure(row.limit)
        );
        for method in &methods {
            let other = row.others.iter().find(|other| other.method == *method);
            let figure = other.map_or(String::new(), |other| Figure(other.figure).to_string());
            let _ = write!(text, " {figure} |");
        }
        text.push('\n');
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::super::row::Words;
    use super::*;

    #[test]
    fn rows_of_a_quantity_share_a_table_with_all_their_methods() {
        let words = Words {
            theme: "wall",
            quantity: "energy (mJ)",
            fails: "it bounces",
            instead: "it does not",
        };
        let rows = [
            words.row("soft", 0.0, 1.0, &[("as given", 2.0)]),
            words.row("stiff", 0.5, 1.0, &[("late", f64::INFINITY)]),
            words.skipped("real", "no data"),
        ];
        let expected = "## wall

Energy (mJ):

| scenario | ours | at most | as given | late |
|---|---:|---:|---:|---:|
| soft | 0 | 1.00 | 2.00 |  |
| stiff | 0.500 | 1.00 |  | ∞ |
| real | skipped: no data | | | |

";
        assert_eq!(tables(&rows), expected);
    }
}
