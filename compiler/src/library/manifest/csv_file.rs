//! Rows of a CSV file, whose header names the fields: `name,prompt,seed`, and `blend.a` for what
//! TOML writes as `blend = { a = … }`.

use super::row::{MAX_ROWS, Row, Sheet, Value, put};

/// Columns that a file may have.
const MAX_COLUMNS: usize = 64;

/// The records of a text, or the line and the reason of what is no CSV.
pub(super) fn parse(text: &str) -> Result<Sheet, (usize, String)> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::Headers)
        .from_reader(text.as_bytes());
    let wrong = |error: &csv::Error| {
        let line = error.position().map_or(1, |place| place.line() as usize);
        let message = match error.kind() {
            csv::ErrorKind::UnequalLengths {
                expected_len, len, ..
            } => format!("{len} fields, the header has {expected_len}"),
            _ => error.to_string(),
        };
        (line, message)
    };
    let header = reader.headers().map_err(|error| wrong(&error))?.clone();
    if header.len() > MAX_COLUMNS {
        let message = format!("{} columns, {MAX_COLUMNS} at most", header.len());
        return Err((1, message));
    }
    let mut sheet = Sheet::default();
    for record in reader.records().take(MAX_ROWS + 1) {
        let record = record.map_err(|error| wrong(&error))?;
        let line = record.position().map_or(1, |place| place.line() as usize);
        let mut fields = Vec::new();
        let cells = header.iter().zip(&record);
        // An empty cell is a field that is not there.
        for (key, cell) in cells.filter(|(_, cell)| !cell.is_empty()) {
            put(&mut fields, key, line, Value::Text(cell.to_owned()));
        }
        sheet.rows.push(Row {
            line,
            fields,
            untyped: true,
        });
    }
    Ok(sheet)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_fields_and_records_know_their_lines() {
        let text = "name, prompt,blend.a,blend.b\nx,\"wet,\nice\",,\ny,,p,q\n";
        let sheet = parse(text).unwrap();
        assert_eq!(
            sheet.rows[0].fields[1].value,
            Value::Text("wet,\nice".into())
        );
        assert_eq!(sheet.rows[1].line, 4);
        let Value::Table(blend) = &sheet.rows[1].fields[1].value else {
            panic!("a table")
        };
        assert_eq!((blend.len(), blend[1].key.as_str()), (2, "b"));
        let (line, message) = parse("name,prompt\nx,y\nz\n").unwrap_err();
        assert_eq!((line, message.as_str()), (3, "1 fields, the header has 2"));
    }
}
