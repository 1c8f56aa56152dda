//! Rows of JSON lines: an object a line.

use super::row::{Field, MAX_FAULTS, MAX_ROWS, Row, Sheet, Value, put};
use serde_json::Value as Json;

/// The objects of a text, and every line that is none, with the reason.
pub(super) fn parse(text: &str) -> (Sheet, Vec<(usize, String)>) {
    let mut sheet = Sheet::default();
    let mut wrong = Vec::new();
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        if sheet.rows.len() > MAX_ROWS || wrong.len() > MAX_FAULTS {
            break;
        }
        if content.trim().is_empty() {
            continue;
        }
        match serde_json::from_str(content) {
            Ok(Json::Object(object)) => {
                let mut fields = Vec::new();
                for (key, value) in object {
                    put(&mut fields, &key, line, of(value, line));
                }
                sheet.rows.push(Row {
                    line,
                    fields,
                    untyped: false,
                });
            }
            Ok(_) => wrong.push((
                line,
                "an object is wanted, such as {\"prompt\": \"cork\"}".into(),
            )),
            Err(error) => {
                let text = error.to_string();
                // The line within the line is always 1.
                let text = text.replace(" at line 1 column", ", column");
                wrong.push((line, text));
            }
        }
    }
    (sheet, wrong)
}

fn of(value: Json, line: usize) -> Value {
    match value {
        Json::Null => Value::Other("null"),
        Json::Bool(is) => Value::Bool(is),
        Json::Number(number) => match (number.as_u64(), number.as_f64()) {
            (Some(whole), _) => Value::Whole(whole),
            (None, Some(number)) => Value::Number(number),
            (None, None) => Value::Other("a number out of range"),
        },
        Json::String(text) => Value::Text(text),
        Json::Array(items) => {
            let items = items.into_iter().enumerate();
            Value::List(
                items
                    .map(|(index, item)| Field {
                        key: index.to_string(),
                        line,
                        value: of(item, line),
                    })
                    .collect(),
            )
        }
        Json::Object(object) => {
            let fields = object.into_iter();
            Value::Table(
                fields
                    .map(|(key, value)| Field {
                        key,
                        line,
                        value: of(value, line),
                    })
                    .collect(),
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_stands_for_itself() {
        let text =
            "{\"prompt\": \"cork\", \"seed\": 3}\n\n[1]\n{\"prompt\": }\n{\"name\": \"x\"}\n";
        let (sheet, wrong) = parse(text);
        let lines: Vec<usize> = sheet.rows.iter().map(|row| row.line).collect();
        assert_eq!(lines, [1, 5]);
        assert_eq!(sheet.rows[0].fields[1].value, Value::Whole(3));
        let lines: Vec<usize> = wrong.iter().map(|(line, _)| *line).collect();
        assert_eq!(lines, [3, 4]);
    }
}
