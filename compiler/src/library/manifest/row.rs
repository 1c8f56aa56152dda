//! A row of a manifest before it is checked, whatever its syntax.

/// A value of a field.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    Number(f64),
    /// A whole number that is not negative.
    Whole(u64),
    Bool(bool),
    Table(Vec<Field>),
    List(Vec<Field>),
    /// Something that no field takes, by the name of its type.
    Other(&'static str),
}

impl Value {
    /// The type, as errors call it.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Text(_) => "a text",
            Self::Number(_) | Self::Whole(_) => "a number",
            Self::Bool(_) => "true or false",
            Self::Table(_) => "a table",
            Self::List(_) => "a list",
            Self::Other(kind) => kind,
        }
    }
}

/// A key with its value. An item of a list has its index as key.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    pub(super) key: String,
    pub(super) line: usize,
    pub(super) value: Value,
}

/// The fields of a texture or of the defaults.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Row {
    pub(super) line: usize,
    pub(super) fields: Vec<Field>,
    /// Whether the syntax has texts only, which then also stand for numbers.
    pub(super) untyped: bool,
}

/// A file before it is checked.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Sheet {
    pub(super) defaults: Option<Row>,
    /// Paths of other manifests.
    pub(super) include: Vec<Field>,
    pub(super) rows: Vec<Row>,
    /// Keys at the top that no manifest has, or whose value is of another type.
    pub(super) wrong: Vec<Field>,
}

/// Textures that one manifest may list, includes and all; what is read beyond them is dropped.
pub(super) const MAX_ROWS: usize = 1 << 17;
/// Faults that are reported one by one.
pub(super) const MAX_FAULTS: usize = 100;

/// Adds a field under a dotted key: `blend.a` is `a` in the table `blend`.
///
/// # Errors
/// A key that is there already.
pub(super) fn put(
    fields: &mut Vec<Field>,
    key: &str,
    line: usize,
    value: Value,
) -> Result<(), String> {
    // One level of tables is all that a key has.
    let nested = key.split_once('.').filter(|(_, rest)| !rest.contains('.'));
    let (own, value) = match nested {
        Some((table, rest)) => {
            let inner = Field {
                key: rest.to_owned(),
                line,
                value,
            };
            if let Some(Value::Table(found)) = fields
                .iter_mut()
                .find(|field| field.key == table)
                .map(|field| &mut field.value)
            {
                if found.iter().any(|field| field.key == rest) {
                    return Err(twice(key));
                }
                found.push(inner);
                return Ok(());
            }
            (table, Value::Table(vec![inner]))
        }
        None => (key, value),
    };
    if fields.iter().any(|field| field.key == own) {
        return Err(twice(own));
    }
    fields.push(Field {
        key: own.to_owned(),
        line,
        value,
    });
    Ok(())
}

fn twice(key: &str) -> String {
    format!("{key:?} is stated twice")
}
