//! Rows of JSON lines: an object a line.

use super::row::{Field, MAX_FAULTS, MAX_ROWS, Row, Sheet, Value, put};
use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess, SeqAccess, Visitor},
};
use std::fmt;

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
        match row(content, line) {
            Ok(row) => sheet.rows.push(row),
            Err(message) => wrong.push((line, message)),
        }
    }
    (sheet, wrong)
}

/// One object, whose keys may be dotted.
fn row(content: &str, line: usize) -> Result<Row, String> {
    let json: Json = serde_json::from_str(content).map_err(|error| {
        // The line within the line is always 1.
        error.to_string().replace(" at line 1 column", ", column")
    })?;
    let Value::Table(object) = json.at(line) else {
        return Err("must be an object, such as {\"prompt\": \"cork\"}".into());
    };
    let mut fields = Vec::new();
    for Field { key, value, .. } in object {
        put(&mut fields, &key, line, value)?;
    }
    Ok(Row {
        line,
        fields,
        untyped: false,
    })
}

/// A JSON value without its line. Serde's own takes the last of two values of one key.
struct Json(Value);

impl Json {
    /// The value, with its line at every field.
    fn at(self, line: usize) -> Value {
        let fields = |fields: Vec<Field>| -> Vec<Field> {
            let placed = |field: Field| Field {
                line,
                value: Self(field.value).at(line),
                ..field
            };
            fields.into_iter().map(placed).collect()
        };
        match self.0 {
            Value::Table(inner) => Value::Table(fields(inner)),
            Value::List(items) => Value::List(fields(items)),
            other => other,
        }
    }
}

impl<'de> Deserialize<'de> for Json {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Any).map(Self)
    }
}

struct Any;

impl<'de> Visitor<'de> for Any {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Other("null"))
    }

    fn visit_bool<E>(self, is: bool) -> Result<Value, E> {
        Ok(Value::Bool(is))
    }

    fn visit_u64<E>(self, whole: u64) -> Result<Value, E> {
        Ok(Value::Whole(whole))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Value, E> {
        Ok(Value::Number(number as f64))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Value, E> {
        Ok(Value::Number(number))
    }

    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(Value::Text(text.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Value, A::Error> {
        let mut items = Vec::new();
        while let Some(Json(value)) = list.next_element()? {
            let key = items.len().to_string();
            items.push(Field {
                key,
                line: 1,
                value,
            });
        }
        Ok(Value::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<Value, A::Error> {
        let mut fields: Vec<Field> = Vec::new();
        while let Some((key, Json(value))) = object.next_entry::<String, Json>()? {
            if fields.iter().any(|field| field.key == key) {
                return Err(de::Error::custom(format!("{key:?} is stated twice")));
            }
            fields.push(Field {
                key,
                line: 1,
                value,
            });
            if fields.len() > MAX_KEYS {
                return Err(de::Error::custom(format!("more than {MAX_KEYS} keys")));
            }
        }
        Ok(Value::Table(fields))
    }
}

/// Keys of one object at most: each is compared with all before it.
const MAX_KEYS: usize = 64;

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

    #[test]
    fn values_keep_type_order_and_line() {
        let line = r#"{"b": [true, null], "a": {"x": -1, "y": 2.5}, "blend.a": "p"}"#;
        let (sheet, wrong) = parse(&format!("\n{line}"));
        assert!(wrong.is_empty(), "{wrong:?}");
        let fields = &sheet.rows[0].fields;
        let keys: Vec<&str> = fields.iter().map(|field| field.key.as_str()).collect();
        assert_eq!(keys, ["b", "a", "blend"]);
        let Value::Table(inner) = &fields[1].value else {
            panic!("a table")
        };
        assert_eq!((inner[0].line, &inner[0].value), (2, &Value::Number(-1.0)));
        assert_eq!((inner[1].line, &inner[1].value), (2, &Value::Number(2.5)));
    }

    #[test]
    fn a_key_that_is_stated_twice_is_refused() {
        for text in [
            r#"{"name":"oak","prompt":"rough oak","prompt":"ice"}"#,
            r#"{"blend": {"a": "x", "b": "y", "a": "z"}}"#,
            r#"{"blend": {"a": "x", "b": "y"}, "blend.a": "z"}"#,
            r#"{"blend.a": "x", "blend": {"a": "z"}}"#,
        ] {
            let (sheet, wrong) = parse(text);
            assert!(sheet.rows.is_empty(), "{text}");
            assert!(wrong[0].1.contains("twice"), "{text}: {}", wrong[0].1);
        }
    }
}
