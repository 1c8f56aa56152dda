//! The shape of an AHAP. A value is checked where it is used, so that one which is not used refuses no file.

use crate::interchange::parse::WRONG_JSON;
use asperity_io::diagnostic::Fault;
use serde::{
    Deserialize, Deserializer,
    de::{self, IgnoredAny, MapAccess, SeqAccess, Visitor},
};
use std::{fmt, marker::PhantomData};

/// Most entries of a list: an empty one takes three bytes of a file, and many more of memory.
const MAX_ENTRIES: usize = 500_000;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "PascalCase")]
pub(super) struct Document {
    #[serde(default)]
    pub(super) version: Scalar,
    pub(super) pattern: List<Item>,
}

/// Entry of a pattern.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "PascalCase")]
pub(super) struct Item {
    pub(super) event: Option<Box<Event>>,
    pub(super) parameter: Option<Box<Parameter>>,
    pub(super) parameter_curve: Option<Box<Curve>>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "PascalCase", default)]
#[derive(Default)]
pub(super) struct Event {
    pub(super) event_type: Scalar,
    pub(super) time: Scalar,
    pub(super) event_duration: Scalar,
    pub(super) event_parameters: List<EventParameter>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "PascalCase", default)]
pub(super) struct EventParameter {
    #[serde(rename = "ParameterID")]
    pub(super) id: Scalar,
    pub(super) parameter_value: Scalar,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "PascalCase", default)]
pub(super) struct Parameter {
    #[serde(rename = "ParameterID")]
    pub(super) id: Scalar,
    pub(super) parameter_value: Scalar,
    pub(super) time: Scalar,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "PascalCase", default)]
pub(super) struct Curve {
    #[serde(rename = "ParameterID")]
    pub(super) id: Scalar,
    pub(super) time: Scalar,
    pub(super) parameter_curve_control_points: List<Point>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "PascalCase", default)]
pub(super) struct Point {
    pub(super) time: Scalar,
    pub(super) parameter_value: Scalar,
}

/// A number, a text, or what else there is.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) enum Scalar {
    /// Left out, or null.
    #[default]
    Absent,
    Number(f64),
    Text(String),
    /// A truth value, a list or an object, in words.
    Other(&'static str),
}

impl Scalar {
    /// The number; `None` where it is left out.
    pub(super) fn number(&self, field: impl FnOnce() -> String) -> Result<Option<f64>, Fault> {
        let found = match self {
            Self::Absent => return Ok(None),
            Self::Number(number) => return Ok(Some(*number)),
            Self::Text(text) => format!("the text {}", super::notes::quoted(text)),
            Self::Other(kind) => (*kind).to_owned(),
        };
        let what = format!("{found}, must be a number");
        Err(Fault::new(what, WRONG_JSON).field(field()))
    }

    /// The number, which must be there.
    pub(super) fn required(&self, field: impl Fn() -> String) -> Result<f64, Fault> {
        let missing = || Fault::new("missing, must be a number", WRONG_JSON).field(field());
        self.number(&field)?.ok_or_else(missing)
    }

    /// The text; empty where it is none.
    pub(super) fn text(&self) -> &str {
        match self {
            Self::Text(text) => text,
            _ => "",
        }
    }
}

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(AnyScalar)
    }
}

struct AnyScalar;

impl<'de> Visitor<'de> for AnyScalar {
    type Value = Scalar;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E: de::Error>(self) -> Result<Scalar, E> {
        Ok(Scalar::Absent)
    }

    fn visit_bool<E: de::Error>(self, _: bool) -> Result<Scalar, E> {
        Ok(Scalar::Other("true or false"))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Scalar, E> {
        Ok(Scalar::Number(value as f64))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Scalar, E> {
        Ok(Scalar::Number(value as f64))
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Scalar, E> {
        Ok(Scalar::Number(value))
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Scalar, E> {
        Ok(Scalar::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Scalar, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Scalar::Other("a list"))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Scalar, A::Error> {
        while map.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Scalar::Other("an object"))
    }
}

/// A list; null is an empty one.
#[derive(Debug)]
pub(super) struct List<T>(pub(super) Vec<T>);

impl<T> Default for List<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for List<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(AnyList(PhantomData))
    }
}

struct AnyList<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for AnyList<T> {
    type Value = List<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_unit<E: de::Error>(self) -> Result<List<T>, E> {
        Ok(List::default())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<List<T>, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = list.next_element()? {
            if values.len() == MAX_ENTRIES {
                let problem = format!("more than {MAX_ENTRIES} entries");
                return Err(de::Error::custom(problem));
            }
            values.push(value);
        }
        Ok(List(values))
    }
}
