//! Rows of JSON lines: objects, each in a line or over several, also in a list and with commas between them.

use super::{
    check::own_key,
    row::{Field, MAX_FAULTS, MAX_ROWS, ManifestRow, Sheet, Value, put},
};
use crate::sources::Registry;
use asperity_io::input::{json_fault, lenient_json};
use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess, SeqAccess, Visitor},
};
use std::fmt;

/// The objects of a text, and every value that is none, with its line and the reason.
pub(super) fn parse(text: &str, registry: &Registry) -> (Sheet, Vec<(usize, String)>) {
    let text = lenient_json(text);
    let mut sheet = Sheet::default();
    let mut wrong = Vec::new();
    let mut values = Values::new(&text);
    for (line, content) in values.by_ref() {
        if sheet.rows.len() > MAX_ROWS || wrong.len() > MAX_FAULTS {
            return (sheet, wrong);
        }
        match row(content, line, registry) {
            Ok(row) => sheet.rows.push(row),
            Err(fault) => wrong.push(fault),
        }
    }
    // A list without its end may have lost rows.
    if wrong.is_empty()
        && let Some((line, message)) = values.fault()
    {
        wrong.push((line, message.into()));
    }
    (sheet, wrong)
}

/// The values at the top of a text, each with the line where it begins, 1-based. Commas between them and the brackets of
/// one list around all of them are passed over.
struct Values<'t> {
    rest: &'t str,
    line: usize,
    /// The line of the bracket that opens the list.
    opened: Option<usize>,
    is_closed: bool,
    /// The line of the first value outside the list.
    outside: Option<usize>,
    /// True once a value was read.
    begun: bool,
}

impl<'t> Values<'t> {
    fn new(text: &'t str) -> Self {
        Self {
            rest: text,
            line: 1,
            opened: None,
            is_closed: false,
            outside: None,
            begun: false,
        }
    }

    /// Returns the fault of the enclosing list, if any, once all values are read.
    fn fault(&self) -> Option<(usize, &'static str)> {
        let outside = |line| (line, "must stand in the list, which is closed before");
        match self.opened {
            Some(line) if !self.is_closed => Some((line, "a list is opened here and never closed")),
            _ => self.outside.map(outside),
        }
    }

    /// Bytes of the value at the front: an object or a list to the bracket that closes it, anything else to the end of
    /// its line.
    fn length(&self) -> usize {
        let bytes = self.rest.as_bytes();
        let (mut depth, mut in_text, mut escaped) = (0_usize, false, false);
        // The byte before, but for space.
        let mut before = b'{';
        for (at, &byte) in bytes.iter().enumerate() {
            match byte {
                // No text goes over a line: its quote was forgotten.
                b'\n' if depth == 0 => return at,
                b'\n' if in_text => (in_text, escaped) = (false, false),
                // An object at the front of a line, where none is expected, is the next value.
                b'{' if at > 0 && bytes[at - 1] == b'\n' && !b",:[{".contains(&before) => {
                    return at;
                }
                _ if in_text => {
                    in_text = escaped || byte != b'"';
                    escaped = !escaped && byte == b'\\';
                }
                b'"' => in_text = true,
                // The end of a list around it.
                b']' if depth == 0 && at > 0 => return at,
                b'{' | b'[' => depth += 1,
                b'}' | b']' => {
                    depth = depth.saturating_sub(1);
                    // What follows in the line belongs to it, and makes it wrong.
                    let next = bytes[at + 1..].iter().find(|b| !matches!(b, b' ' | b'\t'));
                    if depth == 0 && next.is_none_or(|next| b",]\r\n".contains(next)) {
                        return at + 1;
                    }
                }
                _ => {}
            }
            if !byte.is_ascii_whitespace() {
                before = byte;
            }
        }
        bytes.len()
    }
}

impl<'t> Iterator for Values<'t> {
    type Item = (usize, &'t str);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let first = self.rest.chars().next()?;
            match first {
                '\n' => self.line += 1,
                '[' if !self.begun && self.opened.is_none() => self.opened = Some(self.line),
                ']' if self.opened.is_some() && !self.is_closed => self.is_closed = true,
                _ if first == ',' || first.is_whitespace() => {}
                _ => break,
            }
            self.rest = &self.rest[first.len_utf8()..];
        }
        self.begun = true;
        if self.is_closed {
            self.outside.get_or_insert(self.line);
        }
        let (value, rest) = self.rest.split_at(self.length());
        let line = self.line;
        self.line += value.matches('\n').count();
        self.rest = rest;
        Some((line, value.trim_end()))
    }
}

/// Parses an object, whose keys may be dotted.
fn row(content: &str, line: usize, registry: &Registry) -> Result<ManifestRow, (usize, String)> {
    let json: Json = serde_json::from_str(content).map_err(|error| {
        // The line within the value is said by the line of the text.
        let within = format!(" at line {} column", error.line());
        let message = json_fault(content, &error).replace(&within, ", column");
        (line + error.line().saturating_sub(1), message)
    })?;
    let Value::Table(object) = json.at(line) else {
        return Err((
            line,
            "must be an object, such as {\"prompt\": \"cork\"}".into(),
        ));
    };
    let mut fields = Vec::new();
    for Field { key, value, .. } in object {
        put(&mut fields, &own_key(&key, registry), line, value)
            .map_err(|message| (line, message))?;
    }
    Ok(ManifestRow {
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
        Ok(Value::Other(NULL))
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
            if value == Value::Other(NULL) {
                continue;
            }
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

/// Placeholder for an absent field.
const NULL: &str = "null";
/// Keys of one object at most: each is compared with all before it.
const MAX_KEYS: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> (Sheet, Vec<(usize, String)>) {
        super::parse(text, &Registry::default())
    }

    #[test]
    fn every_line_stands_for_itself() {
        let text = "{\"prompt\": \"cork\", \"seed\": 3}\n\n[1]\n{\"prompt\": }\n{\"name\": \"x\"}\n\
             {\"prompt\": \"x\n{\"prompt\": \"y\"\n{\"name\": \"z\"}\nno object, but words\n";
        let (sheet, wrong) = parse(text);
        let lines: Vec<usize> = sheet.rows.iter().map(|row| row.line).collect();
        assert_eq!(lines, [1, 5, 8]);
        assert_eq!(sheet.rows[0].fields[1].value, Value::Whole(3));
        let lines: Vec<usize> = wrong.iter().map(|(line, _)| *line).collect();
        assert_eq!(lines, [3, 4, 6, 7, 9], "{wrong:?}");
    }

    /// However the objects are laid out, they are the same rows.
    #[test]
    fn every_layout_gives_the_same_rows() {
        let fields = |text: &str| {
            let (sheet, wrong) = parse(text);
            assert!(wrong.is_empty(), "{text}: {wrong:?}");
            let row = |row: &ManifestRow| -> Vec<(String, Value)> {
                row.fields
                    .iter()
                    .map(|f| (f.key.clone(), f.value.clone()))
                    .collect()
            };
            let lines: Vec<usize> = sheet.rows.iter().map(|row| row.line).collect();
            (sheet.rows.iter().map(row).collect::<Vec<_>>(), lines)
        };
        let plain = "{\"name\": \"a, [b]}\", \"seed\": 3}\n{\"name\": \"c\"}\n";
        let expected = fields(plain).0;
        for (text, lines) in [
            (
                "{\n \"name\": \"a, [b]}\",\n \"seed\": 3\n}\n{\n \"name\": \"c\"\n}",
                [1, 5],
            ),
            (
                "[{\"name\": \"a, [b]}\", \"seed\": 3}, {\"name\": \"c\"}]",
                [1, 1],
            ),
            (
                "[\r\n {\r\n  \"name\": \"a, [b]}\",\r\n  \"seed\": 3.0,\r\n },\r\n {\"name\": \"c\"},\r\n]\r\n",
                [2, 6],
            ),
            (
                "{\"name\": \"a, [b]}\", \"seed\": 3},\n{\"name\": \"c\"},\n",
                [1, 2],
            ),
            (
                "{\"Name\": \"a, [b]}\", \"SEED\": 3, \"prompt\": null}\n{\"NAME\": \"c\"}",
                [1, 2],
            ),
        ] {
            let (rows, found) = fields(text);
            let whole = |value: &Value| match value {
                Value::Number(n) => Value::Whole(*n as u64),
                other => other.clone(),
            };
            let rows: Vec<Vec<(String, Value)>> = rows
                .into_iter()
                .map(|row| row.into_iter().map(|(k, v)| (k, whole(&v))).collect())
                .collect();
            assert_eq!((rows, found), (expected.clone(), lines.to_vec()), "{text}");
        }
        for (text, line, what) in [
            ("[\n{\"name\": \"a\"},\n", 1, "never closed"),
            ("{\"name\": \"a\"}\n]\n", 2, "expected value"),
            (
                "{\"name\": \"a\"}\n[{\"name\": \"b\"}]\n",
                2,
                "must be an object",
            ),
            ("[{\"name\": \"a\"}]\n{\"name\": \"b\"}\n", 2, "in the list"),
            ("{\n\"name\": NaN\n}", 2, "JSON has no NaN"),
            ("{\n\"name\": None}", 2, "in small letters"),
            ("{\"name\": \"a\"}\n{'name': 'a'}", 2, "double quotes"),
        ] {
            let (_, wrong) = parse(text);
            assert_eq!(wrong.len(), 1, "{text}: {wrong:?}");
            assert_eq!(wrong[0].0, line, "{text}: {wrong:?}");
            assert!(wrong[0].1.contains(what), "{text}: {wrong:?}");
        }
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
