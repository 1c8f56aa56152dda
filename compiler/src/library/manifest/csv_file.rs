//! Rows of a CSV file, whose header names the fields: `name,prompt,seed`, and `blend.a` for what
//! TOML writes as `blend = { a = … }`. Commas, semicolons or tabs separate the cells.

use super::{
    cells::{Broken, Record, Records},
    check::{is_key, own_key},
    row::{MAX_ROWS, ManifestRow, Sheet, Value, put},
};
use crate::sources::Registry;

/// Columns that a file may have.
const MAX_COLUMNS: usize = 64;

/// The records of a text, or the line and the reason of what is no list of textures. Rows without
/// any text, which spreadsheets leave below a table, are none.
pub(super) fn parse(text: &str, registry: &Registry) -> Result<Sheet, Broken> {
    let mut records = Records::new(text);
    let mut sheet = Sheet::default();
    let Some(header) = records.find(|record| !record.as_ref().is_ok_and(Record::is_blank)) else {
        return Ok(sheet);
    };
    let keys = keys(header?, registry)?;
    records.columns = Some(keys.len());
    for record in records {
        let record = record?;
        if record.is_blank() {
            continue;
        }
        sheet.rows.push(row(&keys, record)?);
        // One more than may be, which the check refuses.
        if sheet.rows.len() > MAX_ROWS {
            break;
        }
    }
    Ok(sheet)
}

/// The keys of the columns; a column without a name has an empty one.
fn keys(header: Record, registry: &Registry) -> Result<Vec<String>, Broken> {
    let line = header.line;
    let cells = header.cells.iter();
    let keys: Vec<String> = cells
        .map(|cell| own_key(cell.trim(), registry).into_owned())
        .collect();
    if keys.len() > MAX_COLUMNS {
        let message = format!("{} columns, {MAX_COLUMNS} at most", keys.len());
        return Err((line, message));
    }
    // What it says instead is not repeated: it may be the first line of any file.
    if !keys.iter().any(|key| is_key(key, registry)) {
        let message = "no column of a texture, such as name,prompt; commas, semicolons or tabs \
                       separate the cells";
        return Err((line, message.into()));
    }
    for (index, key) in keys.iter().enumerate().filter(|(_, key)| !key.is_empty()) {
        if let Some(first) = keys[..index].iter().position(|other| other == key) {
            let (first, second) = (first + 1, index + 1);
            let message = format!("columns {first} and {second} are both called {key:?}");
            return Err((line, message));
        }
    }
    Ok(keys)
}

fn row(keys: &[String], record: Record) -> Result<ManifestRow, Broken> {
    let Record { line, cells } = record;
    let filled = |cell: &String| !cell.trim().is_empty();
    let stated = cells.iter().rposition(filled).map_or(0, |last| last + 1);
    if cells.len() < keys.len() || stated > keys.len() {
        let (found, wanted) = (stated.max(cells.len()), keys.len());
        let mut message = format!("{found} cells, the header has {wanted}");
        if found > wanted {
            message += "; a cell with a separator in it is put in quotes";
        }
        return Err((line, message));
    }
    let mut fields = Vec::new();
    // An empty cell is a field that is not there.
    for (index, (key, cell)) in keys.iter().zip(cells).enumerate() {
        if !filled(&cell) {
            continue;
        }
        if key.is_empty() {
            let message = format!("{cell:?} is in column {}, which has no name", index + 1);
            return Err((line, message));
        }
        put(&mut fields, key, line, Value::Text(cell)).map_err(|message| (line, message))?;
    }
    Ok(ManifestRow {
        line,
        fields,
        untyped: true,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Sheet, Broken> {
        super::parse(text, &Registry::default())
    }

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
    }

    /// Empty rows and columns, which spreadsheets write around a table, are neither faults nor textures.
    #[test]
    fn blank_rows_and_columns_without_a_name_are_passed_over() {
        let plain = parse("name,prompt\noak,rough oak\nice,wet ice\n").unwrap();
        let names = |sheet: &Sheet| -> Vec<Vec<Value>> {
            let row =
                |row: &ManifestRow| row.fields.iter().map(|field| field.value.clone()).collect();
            sheet.rows.iter().map(row).collect()
        };
        for text in [
            "\n,\nname,prompt\noak,rough oak\n,\n , \nice,wet ice\n,\n\n",
            "name;prompt\noak;rough oak\nice;wet ice\n;\n",
            "name\tprompt\r\noak\trough oak\r\n\t\r\nice\twet ice",
            "name,prompt,,\noak,rough oak,,\nice,wet ice,,,,,\n,,,\n",
            "sep=;\nname;prompt\noak;rough oak\nice;wet ice\n",
            "Name,PROMPT\noak,rough oak\nice,wet ice\n",
        ] {
            assert_eq!(names(&parse(text).unwrap()), names(&plain), "{text:?}");
        }
        assert!(parse("").unwrap().rows.is_empty());
        assert!(parse("\n,,\n").unwrap().rows.is_empty());
    }

    #[test]
    fn what_would_lose_a_cell_is_refused_at_its_line() {
        for (text, line, what) in [
            ("name,prompt\nx,y\nz\n", 3, "1 cells, the header has 2"),
            (
                "name,prompt\nx,wet, cold ice\n",
                2,
                "3 cells, the header has 2",
            ),
            (
                "name,prompt,\nx,y,z\n",
                2,
                "\"z\" is in column 3, which has no name",
            ),
            (
                "name,prompt,prompt\nx,y,z\n",
                1,
                "columns 2 and 3 are both called \"prompt\"",
            ),
            (
                "Prompt,name,prompt\nx,y,z\n",
                1,
                "columns 1 and 3 are both called \"prompt\"",
            ),
            ("name|prompt\nx|y\n", 1, "no column of a texture"),
            ("name,prompt\nx,\"y\nz,w\n", 2, "never closed"),
        ] {
            let (found, message) = parse(text).unwrap_err();
            assert_eq!(found, line, "{text:?}: {message}");
            assert!(message.contains(what), "{text:?}: {message}");
        }
        let (_, message) = parse("root:x:0:0:root:/root:/bin/bash\n").unwrap_err();
        assert!(!message.contains("root"), "{message}");
    }
}
