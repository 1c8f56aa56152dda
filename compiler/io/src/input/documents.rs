//! Detection of a file's format, whatever its name: by its first bytes, by what its text declares, or by the keys of
//! its JSON.

use super::{
    format::{Format, HEAD, Unread},
    lenient_json::lenient_json,
    signatures::{self, GLTF, PLIST, named, unread, without_mark},
};
use serde::de::{
    DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor,
};
use std::fmt;

/// Keys of an object that are looked at.
const KEYS: usize = 64;
/// Most bytes of what a server answers instead of a file.
const ANSWER: usize = 2048;

/// Remedy for effects in formats that are not read.
const EXPORT: &str = "it is not read: export the effect as AHAP, .haptic or HJIF, then run `asperity import ahap`, \
                      `haptic` or `hjif`";
const REFUSAL: Unread = unread(
    "a server's message of an error, not the file",
    "download the file again, from the address of the file itself",
);

impl Format {
    /// The format of a file, or of its beginning; `None` for one that is not known.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Option<Self> {
        Self::of_magic(bytes).or_else(|| of_json(bytes))
    }

    /// The format without a look at the keys of JSON.
    pub(super) fn of_magic(bytes: &[u8]) -> Option<Self> {
        signatures::of(bytes).or_else(|| of_text(bytes))
    }
}

/// The format of a text, without a look at the keys of JSON.
fn of_text(bytes: &[u8]) -> Option<Format> {
    let text = without_mark(bytes).trim_ascii_start();
    let head = &text[..text.len().min(HEAD)];
    let has = |part: &str| head.windows(part.len()).any(|w| w == part.as_bytes());
    match head.first()? {
        b'<' => of_xml(text),
        b'{' | b'[' if is_python(head) => named!(
            "a value as Python prints it, not JSON",
            "write it with json.dump instead of print or str",
        ),
        b'"' => {
            // A string of JSON that holds an object or a list.
            let mut inner = head[1..].trim_ascii_start();
            while let [b'\\', b'n' | b'r' | b't', rest @ ..] = inner {
                inner = rest.trim_ascii_start();
            }
            let is_quoted = matches!(inner.first(), Some(b'{' | b'[')) && has("\\\"");
            let quoted = named!(
                "JSON within a string of JSON, encoded twice",
                "decode it once, as `jq -r . FILE` does"
            );
            quoted.filter(|_| is_quoted)
        }
        _ if head.starts_with(b"%YAML") && has("tag:unity3d.com") => named!(
            "a Unity asset (YAML)",
            "give the .haptic or .ahap file that Unity imported",
        ),
        _ if head.starts_with(b"fileFormatVersion:") => named!(
            "a Unity .meta file",
            "give the file beside it, whose name does not end in .meta",
        ),
        _ if head.starts_with(b"%YAML") => named!("a YAML text", "give the file that was meant"),
        _ => is_refusal(text).then_some(Format::Unread(&REFUSAL)),
    }
}

/// Returns true if the first key of a text in braces is in single quotes.
fn is_python(text: &[u8]) -> bool {
    let inner = text.iter().position(|b| !b"{[ \n\r\t".contains(b));
    // TOML has such keys in brackets, but not in braces.
    inner.is_some_and(|at| text[at] == b'\'' && text[..at].contains(&b'{'))
}

/// Returns true if a text is a single HTTP status line: `404: Not Found`.
fn is_refusal(text: &[u8]) -> bool {
    let Ok(line) = std::str::from_utf8(&text[..text.len().min(ANSWER)]) else {
        return false;
    };
    let line = line.trim_end();
    let line = line.strip_prefix("HTTP/1.1 ").unwrap_or(line);
    let (status, words) = line.split_at_checked(3).unwrap_or(("", line));
    let is_status = status.starts_with(['4', '5']) && status.bytes().all(|b| b.is_ascii_digit());
    let words = words.trim_start_matches([':', ' ', '-']);
    let is_words = |text: &str| {
        let is_word = |c: char| c.is_ascii_alphabetic() || " '.".contains(c);
        !text.is_empty() && text.chars().all(is_word)
    };
    is_status && is_words(words) || ["Not Found", "Forbidden", "Access Denied"].contains(&line)
}

/// An XML or an HTML document by its root.
fn of_xml(text: &[u8]) -> Option<Format> {
    let head = String::from_utf8_lossy(&text[..text.len().min(HEAD)]);
    let mut rest = head.as_ref();
    // Declarations, comments and the document's type come before the root.
    let root = loop {
        rest = rest.trim_start();
        let end = match rest.get(..4)? {
            "<!--" => "-->",
            start if start.starts_with("<?") => "?>",
            start if start.starts_with("<!") => {
                let kind = rest[2..].trim_start_matches(|c: char| c.is_ascii_alphabetic());
                let kind = kind.trim_start().to_ascii_lowercase();
                if kind.starts_with("html") {
                    break "html".into();
                }
                ">"
            }
            _ => {
                let name = rest.strip_prefix('<')?;
                let is_name = |c: char| c.is_alphanumeric() || ":-_.".contains(c);
                break name[..name.find(|c| !is_name(c)).unwrap_or(name.len())].to_owned();
            }
        };
        rest = rest.split_once(end)?.1;
    };
    match root.to_ascii_lowercase().as_str() {
        "html" | "head" | "body" | "title" | "script" => named!(
            "a web page (HTML)",
            "download the file itself, not the page that shows it",
        ),
        "vibration-effect" | "vibration-select" => named!("an Android vibration (XML)", EXPORT),
        "plist" => Some(Format::Unread(&PLIST)),
        // Of a storage service.
        "error" if head.contains("<Code>") => Some(Format::Unread(&REFUSAL)),
        "" => None,
        _ if head.contains("<modelSet") => Some(Format::Hatt),
        // Some tables have heads in such brackets.
        _ if head.contains("</") || head.contains("/>") || head.contains("<?xml") => {
            Some(Format::Xml)
        }
        _ => None,
    }
}

/// A format by the keys of an object.
fn of_json(bytes: &[u8]) -> Option<Format> {
    let bytes = without_mark(bytes);
    if bytes.trim_ascii_start().first() != Some(&b'{') {
        return None;
    }
    // A part of a file may end within a character.
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => std::str::from_utf8(&bytes[..error.valid_up_to()]).ok()?,
    };
    let mut keys = Vec::new();
    let text = lenient_json(text);
    // A fault behind the keys that tell is for the reader of the format to name.
    let _ = Keys(&mut keys).deserialize(&mut serde_json::Deserializer::from_str(&text));
    let of = |key: &str| {
        keys.iter()
            .find(|(name, _)| name == key)
            .map(|(_, value)| value)
    };
    let has = |key: &str| of(key).is_some();
    let within = |key: &str, inner: &[&str]| match of(key) {
        Some(Shape::Object(names)) => names.iter().any(|name| inner.contains(&name.as_str())),
        _ => false,
    };
    if of("format") == Some(&Shape::Text("asperity-model".into())) {
        Some(Format::Model)
    } else if has("Pattern") {
        Some(Format::Ahap)
    } else if has("signals") {
        Some(Format::Haptic)
    } else if of("version") == Some(&Shape::Number) && has("tracks") {
        named!(
            "a .haptic file of version 0 (.vij)",
            "export it again as .haptic of version 1, then run `asperity import haptic`",
        )
    } else if has("perceptions") {
        Some(Format::Hjif)
    } else if has("m_vibration") || has("m_version") || has("m_stiffness") || has("m_texture") {
        named!("an Interhaptics .haps file", EXPORT)
    } else if within("project", &["layout", "tracks"]) {
        named!("a bHaptics .tact file", EXPORT)
    } else if has("clips") && has("version") {
        named!(
            "a Haptics Studio project (.hasp)",
            "export its clip from Haptics Studio as .haptic, then run `asperity import haptic`",
        )
    } else if within("asset", &["version"]) {
        Some(Format::Unread(&GLTF))
    } else if has("amplitudes") && (has("timings") || has("durations")) {
        named!("an Android vibration waveform (JSON)", EXPORT)
    } else if within("actions", &["pos"]) {
        named!("a funscript (positions over time)", EXPORT)
    } else if has("action_sets") || has("default_bindings") {
        named!("a SteamVR action manifest", EXPORT)
    } else if has("message") && (has("documentation_url") || has("status")) {
        Some(Format::Unread(&REFUSAL))
    } else {
        None
    }
}

/// As much of a value as tells formats apart.
#[derive(Debug, PartialEq)]
enum Shape {
    Number,
    Text(String),
    /// The keys of an object, or of the first one of a list.
    Object(Vec<String>),
    Other,
}

/// Collects keys and shapes, up to the first fault.
struct Keys<'a>(&'a mut Vec<(String, Shape)>);

impl<'de> DeserializeSeed<'de> for Keys<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Keys<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            if self.0.len() == KEYS {
                return Err(A::Error::custom("no format has so many keys"));
            }
            self.0.push((key, Shape::Other));
            let shape = map.next_value_seed(ShapeOf)?;
            if let Some(last) = self.0.last_mut() {
                last.1 = shape;
            }
        }
        Ok(())
    }
}

struct ShapeOf;

impl<'de> DeserializeSeed<'de> for ShapeOf {
    type Value = Shape;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Shape, D::Error> {
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for ShapeOf {
    type Value = Shape;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E>(self) -> Result<Shape, E> {
        Ok(Shape::Other)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Shape, E> {
        Ok(Shape::Other)
    }

    fn visit_i64<E>(self, _: i64) -> Result<Shape, E> {
        Ok(Shape::Number)
    }

    fn visit_u64<E>(self, _: u64) -> Result<Shape, E> {
        Ok(Shape::Number)
    }

    fn visit_f64<E>(self, _: f64) -> Result<Shape, E> {
        Ok(Shape::Number)
    }

    fn visit_str<E>(self, text: &str) -> Result<Shape, E> {
        Ok(Shape::Text(text.to_owned()))
    }

    /// The first entry tells what the others are.
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Shape, A::Error> {
        let first = list.next_element_seed(ShapeOf)?;
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(match first {
            Some(Shape::Object(names)) => Shape::Object(names),
            _ => Shape::Other,
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Shape, A::Error> {
        let mut names = Vec::new();
        while let Some((name, _)) = map.next_entry::<String, IgnoredAny>()? {
            if names.len() < KEYS {
                names.push(name);
            }
        }
        Ok(Shape::Object(names))
    }
}
