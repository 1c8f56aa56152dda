//! Rows of a TOML file, with their lines.

use super::row::{Field, ManifestRow, Sheet, Value};
use asperity_io::toml_error::TomlError;
use toml::de::{DeTable, DeValue};

/// Where lines begin in a text.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Self {
        let breaks = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        Self(breaks.map(|(at, _)| at).collect())
    }

    /// Line of a byte, 1-based.
    fn line(&self, at: usize) -> usize {
        1 + self.0.partition_point(|&end| end < at)
    }
}

/// The table at the top of a text.
pub(super) fn parse(text: &str) -> Result<Sheet, TomlError> {
    let top = DeTable::parse(text).map_err(|error| TomlError::new(text, &error))?;
    let lines = Lines::of(text);
    let mut sheet = Sheet::default();
    for field in fields(top.get_ref(), &lines) {
        match (field.key.as_str(), field.value) {
            ("defaults", Value::Table(fields)) => {
                sheet.defaults = Some(ManifestRow {
                    line: field.line,
                    fields,
                    untyped: false,
                });
            }
            ("include", Value::List(items)) => sheet.include = items,
            ("include", value @ Value::Text(_)) => sheet.include = vec![Field { value, ..field }],
            ("texture", Value::List(items)) => {
                for item in items {
                    match item.value {
                        Value::Table(fields) => sheet.rows.push(ManifestRow {
                            line: item.line,
                            fields,
                            untyped: false,
                        }),
                        value => sheet.wrong.push(Field {
                            key: "texture".into(),
                            value,
                            ..item
                        }),
                    }
                }
            }
            (_, value) => sheet.wrong.push(Field { value, ..field }),
        }
    }
    Ok(sheet)
}

fn fields(table: &DeTable<'_>, lines: &Lines) -> Vec<Field> {
    let mut fields: Vec<(usize, Field)> = table
        .iter()
        .map(|(key, value)| {
            let start = key.span().start;
            let field = Field {
                key: key.get_ref().to_string(),
                line: lines.line(start),
                value: of(value.get_ref(), lines),
            };
            (start, field)
        })
        .collect();
    // The table is sorted by keys; a report goes from top to bottom.
    fields.sort_by_key(|(start, _)| *start);
    fields.into_iter().map(|(_, field)| field).collect()
}

fn of(value: &DeValue<'_>, lines: &Lines) -> Value {
    match value {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(number) => {
            let digits = number.as_str().replace('_', "");
            match u64::from_str_radix(&digits, number.radix()) {
                Ok(whole) => Value::Whole(whole),
                Err(_) => digits
                    .parse()
                    .map_or(Value::Other("a number out of range"), Value::Number),
            }
        }
        DeValue::Float(number) => {
            let digits = number.as_str().replace('_', "");
            digits
                .parse()
                .map_or(Value::Other("a number out of range"), Value::Number)
        }
        DeValue::Boolean(is) => Value::Bool(*is),
        DeValue::Datetime(_) => Value::Other("a date"),
        DeValue::Array(items) => Value::List(
            items
                .iter()
                .enumerate()
                .map(|(index, item)| Field {
                    key: index.to_string(),
                    line: lines.line(item.span().start),
                    value: of(item.get_ref(), lines),
                })
                .collect(),
        ),
        DeValue::Table(table) => Value::Table(fields(table, lines)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_has_its_line() {
        let text = "include = [\n\"a.toml\",\n\"b.csv\"]\n[defaults]\nseed = 1_0\n\n[[texture]]\nname = 'x'\nblend = { a = \"p\", b = \"q\",\n t = 0.5 }\n[[texture]]\nprompt = \"y\"\nwhat = 1979-05-27\n";
        let sheet = parse(text).unwrap();
        let include: Vec<usize> = sheet.include.iter().map(|field| field.line).collect();
        assert_eq!(include, [2, 3]);
        let defaults = sheet.defaults.unwrap();
        assert_eq!(
            (defaults.fields[0].line, &defaults.fields[0].value),
            (5, &Value::Whole(10))
        );
        let rows: Vec<usize> = sheet.rows.iter().map(|row| row.line).collect();
        assert_eq!(rows, [7, 11]);
        let Value::Table(blend) = &sheet.rows[0].fields[1].value else {
            panic!("a table")
        };
        assert_eq!((blend[2].line, &blend[2].value), (10, &Value::Number(0.5)));
        assert_eq!(sheet.rows[1].fields[1].value.kind(), "a date");
        assert_eq!(parse("a = 1\nb = = 2").unwrap_err().line, 2);
    }
}
