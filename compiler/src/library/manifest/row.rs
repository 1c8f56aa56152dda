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

impl Value {
    /// The whole number, 0 or more, that it is, however that is written; a text counts where the syntax has no other
    /// values. Beyond 2⁵³ only digits are exact.
    pub(super) fn whole(&self, untyped: bool) -> Option<u64> {
        const EXACT: f64 = (1_u64 << 53) as f64;
        let number = match self {
            Self::Whole(whole) => return Some(*whole),
            Self::Number(number) => *number,
            Self::Text(text) if untyped => match text.trim().parse() {
                Ok(whole) => return Some(whole),
                // 1.000 may be one or a thousand.
                Err(_) if grouped(text.trim()) || rounded(text.trim()) => return None,
                Err(_) => text.trim().parse().ok()?,
            },
            _ => return None,
        };
        ((0.0..EXACT).contains(&number) && number.fract() == 0.0).then_some(number as u64)
    }

    /// The value as an error repeats it.
    pub(super) fn shown(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => format!("{number:?}"),
            Self::Whole(whole) => whole.to_string(),
            other => other.kind().to_owned(),
        }
    }
}

/// Returns true if digits are grouped by threes with points: 1.000, 12.500.000.
fn grouped(text: &str) -> bool {
    let digits = text.trim_start_matches(['+', '-']);
    let mut groups = digits.split('.');
    let first = groups.next().unwrap_or_default();
    let is_number = |group: &str| group.bytes().all(|b| b.is_ascii_digit());
    (1..=3).contains(&first.len())
        && !first.starts_with('0')
        && digits.contains('.')
        && is_number(first)
        && groups.all(|group| group.len() == 3 && is_number(group))
}

/// Returns true if a spreadsheet showed a number with fewer digits than it has: 1.23457E+11.
fn rounded(text: &str) -> bool {
    let parts = text.split_once(['e', 'E']);
    parts.is_some_and(|(digits, exponent)| {
        let decimals = digits
            .split_once('.')
            .map_or(0, |(_, decimals)| decimals.len());
        let exponent = exponent.parse::<usize>().unwrap_or(0);
        decimals > 0 && exponent > decimals
    })
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
pub(super) struct ManifestRow {
    pub(super) line: usize,
    pub(super) fields: Vec<Field>,
    /// True if the syntax has texts only, which then also stand for numbers.
    pub(super) untyped: bool,
}

/// A file before it is checked.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Sheet {
    pub(super) defaults: Option<ManifestRow>,
    /// Paths of other manifests.
    pub(super) include: Vec<Field>,
    pub(super) rows: Vec<ManifestRow>,
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
