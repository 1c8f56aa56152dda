//! Extracts a cell of a Markdown table, so that prose can quote it.

/// The cell that `path`, `row|column` or `row|column|part`, names in a table.
///
/// `row` is the row's first cell without emphasis, `column` the head of a column. `part` counts, from 1, what ` / ` parts
/// within a cell.
///
/// # Errors
/// What is missing, or there more than once.
pub fn cell(table: &str, path: &str) -> Result<String, String> {
    let names: Vec<&str> = path.split('|').collect();
    let (row, column, part) = match names[..] {
        [row, column] => (row, column, None),
        [row, column, part] => (row, column, Some(part)),
        _ => return Err(format!("{path} is not row|column or row|column|part")),
    };
    let mut lines = table
        .lines()
        .filter(|line| line.starts_with('|'))
        .map(cells);
    let heads = lines.next().ok_or("no table")?;
    let place = one(heads
        .iter()
        .enumerate()
        .filter(|(_, head)| **head == column))
    .map_err(|many| format!("{many} column {column}"))?
    .0;
    let found = one(lines.filter(|cells| cells.first().is_some_and(|first| *first == row)))
        .map_err(|many| format!("{many} row {row}"))?;
    let text = found
        .get(place)
        .ok_or_else(|| format!("row {row} has no column {column}"))?;
    let Some(part) = part else {
        return Ok((*text).to_owned());
    };
    let parts = part
        .parse()
        .ok()
        .and_then(|part: usize| text.split(" / ").nth(part.checked_sub(1)?));
    parts
        .map(str::to_owned)
        .ok_or_else(|| format!("{text} has no part {part}"))
}

fn cells(line: &str) -> Vec<&str> {
    let inside = line.trim().trim_start_matches('|').trim_end_matches('|');
    inside
        .split('|')
        .map(|cell| cell.trim().trim_matches('*'))
        .collect()
}

fn one<T>(mut found: impl Iterator<Item = T>) -> Result<T, &'static str> {
    match (found.next(), found.next()) {
        (Some(only), None) => Ok(only),
        (None, _) => Err("no"),
        (Some(_), Some(_)) => Err("more than one"),
    }
}

#[cfg(test)]
mod tests {
    use super::cell;

    const TABLE: &str = "text\n\n| kind | a | a / b |\n|---|---|---:|\n| **x** | 1 | 2 / 3 |\n| y | | |\n| y | 4 | |";

    #[test]
    fn rows_columns_and_parts_are_found_by_name() {
        assert_eq!(cell(TABLE, "x|a").unwrap(), "1");
        assert_eq!(cell(TABLE, "x|a / b").unwrap(), "2 / 3");
        assert_eq!(cell(TABLE, "x|a / b|2").unwrap(), "3");
    }

    #[test]
    fn what_is_missing_or_ambiguous_is_named() {
        for (path, fault) in [
            ("z|a", "no row z"),
            ("y|a", "more than one row y"),
            ("x|c", "no column c"),
            ("x|a / b|3", "2 / 3 has no part 3"),
            ("x|a / b|0", "2 / 3 has no part 0"),
            ("x", "x is not row|column or row|column|part"),
        ] {
            assert_eq!(cell(TABLE, path).unwrap_err(), fault);
        }
        assert_eq!(cell("no lines", "x|a").unwrap_err(), "no table");
    }
}
