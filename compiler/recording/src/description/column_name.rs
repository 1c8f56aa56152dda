//! Parsing of a column's name: quantity, axis, unit, or a clock.
//!
//! `Time (s)`, `Acceleration x (m/s^2)`, `Ax(g)`, `acc_x [g]`, `force_z_mN`, `t_us`: the unit stands in
//! brackets, after a separator, or in words. A name that says nothing means nothing here.

use super::{
    quantity::{Quantity, Unit},
    schema::Axis,
};
use asperity_io::table::time_unit;

/// Spellings of units that a description writes in one way. Their case counts: mN is no MN.
const SPELLINGS: [(&str, &[&str]); 18] = [
    (
        "m/s^2",
        &[
            "m/s^2", "m/s²", "m/s2", "m/s/s", "m/s**2", "m_s2", "m_s_2", "ms2", "ms^2", "mps2",
            "m*s^-2", "ms-2", "m s-2", "m s^-2",
        ],
    ),
    ("mm/s^2", &["mm/s^2", "mm/s²", "mm/s2", "mm_s2", "mmps2"]),
    ("g", &["g", "G", "gee", "g-force"]),
    ("mg", &["mg", "mG", "milli-g"]),
    ("N", &["N", "n", "newton", "newtons", "Newton", "Newtons"]),
    ("mN", &["mN", "mn"]),
    ("kN", &["kN", "kn"]),
    ("kgf", &["kgf", "kg-f", "kg"]),
    ("lbf", &["lbf", "lb", "lbs"]),
    ("gf", &["gf", "g-f"]),
    ("N*m", &["N*m", "Nm", "N·m", "N.m", "N-m", "nm"]),
    ("N*mm", &["N*mm", "Nmm", "N·mm", "N.mm", "N-mm"]),
    ("m", &["m", "meter", "meters", "metre", "metres"]),
    ("mm", &["mm", "millimeter", "millimeters", "millimetres"]),
    ("um", &["um", "µm", "μm", "micron", "microns"]),
    ("cm", &["cm"]),
    ("mm/s", &["mm/s", "mm_s", "mmps"]),
    ("m/s", &["m/s", "m_s", "mps"]),
];

/// Meaning of a column's name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Meaning {
    /// Time, in a unit of a description if the name has one.
    Clock(Option<&'static str>),
    /// A channel.
    Channel {
        quantity: Quantity,
        axis: Axis,
        unit: Option<Unit>,
    },
    /// A quantity in a unit that is none of its own.
    OtherUnit(Quantity),
    /// An axis without a quantity: `x`.
    Bare(Axis),
    /// Nothing that is known.
    Unknown,
}

/// The meaning of a column's name. Of a path, such as `/imu/linear_acceleration/x`, the end tells.
pub(crate) fn meaning(name: &str) -> Meaning {
    let (stem, unit) = split(name.trim());
    if stem == "X_Value" {
        // LabVIEW's name of the time.
        return Meaning::Clock(None);
    }
    let whole = of_words(&words(&stem), unit);
    let mut parts = stem.rsplit(['/', '.']).filter(|part| !part.is_empty());
    let (Some(last), Some(before)) = (parts.next(), parts.next()) else {
        return whole;
    };
    match (whole, unit) {
        (Meaning::Unknown, _) => {}
        // Seconds of what?
        (_, Some(Symbol::Time(_))) if !words(&stem).iter().any(|word| is_time(word)) => {
            return Meaning::Unknown;
        }
        _ => return whole,
    }
    // A bare axis says nothing without what stands before it, and the parts of a stamp are no clock.
    let ends = [format!("{before} {last}"), last.to_owned()];
    let ends = ends.map(|end| of_words(&words(&end), unit));
    let told = |end: &Meaning| matches!(end, Meaning::Channel { .. } | Meaning::OtherUnit(_));
    ends.into_iter().find(told).unwrap_or(Meaning::Unknown)
}

/// Returns true if a field may stand in a row of units.
pub(crate) fn is_unit(field: &str) -> bool {
    let field = field.trim_matches(['(', ')', '[', ']']);
    symbol(field).is_some() || OTHER_UNITS.contains(&field)
}

/// Units of what else a logger writes.
const OTHER_UNITS: [&str; 24] = [
    "-", "V", "mV", "A", "mA", "deg", "°", "rad", "deg/s", "°/s", "rad/s", "Hz", "%", "°C", "C",
    "K", "Pa", "kPa", "bar", "uT", "µT", "W", "in", "cm/s",
];

/// The quantity that the name of a group of columns says.
pub(crate) fn in_group(group: &str) -> Option<Quantity> {
    words(group).iter().rev().find_map(|word| quantity_of(word))
}

fn of_words(words: &[String], mut unit: Option<Symbol>) -> Meaning {
    if let Some(Symbol::Time(unit)) = unit {
        return Meaning::Clock(Some(unit));
    }
    if words.iter().any(|word| is_time(word)) {
        return match unit {
            None => Meaning::Clock(words.iter().find_map(|word| time(word))),
            Some(_) => Meaning::Unknown,
        };
    }
    if let (None, [word]) = (unit, words)
        && let Some(unit) = time(word)
    {
        return Meaning::Clock(Some(unit));
    }
    let (mut quantity, mut axis) = (None, None);
    for word in words {
        let (of_word, along) = match quantity_of(word) {
            Some(quantity) => (Some(quantity), None),
            None => match short(word) {
                Some((quantity, along)) => {
                    if word.starts_with("gf") {
                        unit = unit.or(Some(Symbol::Of("g")));
                    }
                    (Some(quantity), Some(along))
                }
                None => (None, axis_of(word)),
            },
        };
        match (of_word, along) {
            (None, None) if !FILLERS.contains(&word.as_str()) => return Meaning::Unknown,
            _ => {}
        }
        if let (Some(known), Some(also)) = (quantity, of_word)
            && known != also
        {
            return Meaning::Unknown;
        }
        quantity = quantity.or(of_word);
        axis = axis.or(along);
    }
    let along = axis.unwrap_or(Axis::Along);
    match (quantity, unit) {
        (Some(quantity), Some(Symbol::Of(spelling))) => {
            // A scale shows grams where it weighs a force.
            let spelling = match (quantity, spelling) {
                (Quantity::Force, "g") => "gf",
                _ => spelling,
            };
            match Unit::named(spelling, quantity) {
                Some(unit) => Meaning::Channel {
                    quantity,
                    axis: along,
                    unit: Some(unit),
                },
                None => Meaning::OtherUnit(quantity),
            }
        }
        (Some(quantity), Some(Symbol::Strange)) => Meaning::OtherUnit(quantity),
        (Some(quantity), None) => Meaning::Channel {
            quantity,
            axis: along,
            unit: None,
        },
        (None, Some(Symbol::Of(spelling))) => match Unit::any(spelling) {
            // Names such as `X (mm)` or `channel 1 (g)`.
            Some(unit) => Meaning::Channel {
                quantity: unit.quantity,
                axis: along,
                unit: Some(unit),
            },
            None => Meaning::Unknown,
        },
        (None, None) => axis.map_or(Meaning::Unknown, Meaning::Bare),
        _ => Meaning::Unknown,
    }
}

/// Words that go with a quantity and say nothing of their own.
const FILLERS: [&str; 18] = [
    "linear",
    "total",
    "cell",
    "lin",
    "raw",
    "sensor",
    "tip",
    "tool",
    "stylus",
    "ch",
    "channel",
    "axis",
    "user",
    "calibrated",
    "filtered",
    "signal",
    "value",
    "data",
];

fn is_time(word: &str) -> bool {
    matches!(
        word,
        "t" | "time"
            | "timestamp"
            | "datetime"
            | "date"
            | "clock"
            | "elapsed"
            | "zeit"
            | "temps"
            | "tempo"
    )
}

/// The unit of time that a word names, as a description writes it.
fn time(word: &str) -> Option<&'static str> {
    time_unit(word).map(|(unit, _)| unit)
}

fn quantity_of(word: &str) -> Option<Quantity> {
    Some(match word {
        "a" | "acc" | "accel" | "acceleration" | "accelerometer" => Quantity::Acceleration,
        "f" | "force" | "load" => Quantity::Force,
        "torque" | "moment" => Quantity::Torque,
        "pos" | "position" | "displacement" | "disp" => Quantity::Position,
        "v" | "vel" | "velocity" | "speed" => Quantity::Speed,
        _ => return None,
    })
}

fn axis_of(word: &str) -> Option<Axis> {
    Some(match word {
        "x" => Axis::X,
        "y" => Axis::Y,
        "z" | "normal" | "height" => Axis::Z,
        "along" | "tangential" | "lateral" | "friction" | "shear" => Axis::Along,
        _ => return None,
    })
}

/// `ax`, `accelx`, `fz`, `fn`, `vy`, `px`, `tz`.
fn short(word: &str) -> Option<(Quantity, Axis)> {
    match word {
        "fn" => return Some((Quantity::Force, Axis::Z)),
        "ft" => return Some((Quantity::Force, Axis::Along)),
        // In g, as phones show it.
        "gfx" => return Some((Quantity::Acceleration, Axis::X)),
        "gfy" => return Some((Quantity::Acceleration, Axis::Y)),
        "gfz" => return Some((Quantity::Acceleration, Axis::Z)),
        _ => {}
    }
    let (stem, axis) = word.split_at_checked(word.len().checked_sub(1)?)?;
    let axis = match axis {
        "x" => Axis::X,
        "y" => Axis::Y,
        "z" => Axis::Z,
        _ => return None,
    };
    let quantity = match stem {
        "p" => Quantity::Position,
        "t" => Quantity::Torque,
        stem => quantity_of(stem)?,
    };
    Some((quantity, axis))
}

/// A unit as a header writes it.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Symbol {
    Time(&'static str),
    /// As a description writes it.
    Of(&'static str),
    /// Something in brackets that is no unit of a recording.
    Strange,
}

fn symbol(text: &str) -> Option<Symbol> {
    let text = text.trim();
    if let Some(unit) = time(&text.to_lowercase()) {
        return Some(Symbol::Time(unit));
    }
    SPELLINGS
        .iter()
        .find(|(_, spellings)| spellings.contains(&text))
        .map(|(unit, _)| Symbol::Of(unit))
}

/// A name without its unit, and the unit.
fn split(name: &str) -> (String, Option<Symbol>) {
    for (open, close) in [('(', ')'), ('[', ']'), ('{', '}'), ('<', '>')] {
        if let Some((stem, rest)) = name.split_once(open)
            && let Some((inside, _)) = rest.rsplit_once(close)
        {
            return (
                stem.to_owned(),
                Some(symbol(inside).unwrap_or(Symbol::Strange)),
            );
        }
    }
    // The longest end that is a unit: `x_mm_s2` before `s2`.
    let starts = name
        .char_indices()
        .filter(|(at, c)| *at > 0 && matches!(c, '_' | ' ' | ',' | '/' | '-' | '.' | ':'));
    for (at, separator) in starts {
        let end = &name[at + separator.len_utf8()..];
        if let Some(unit) = symbol(end) {
            return (name[..at].to_owned(), Some(unit));
        }
    }
    (name.to_owned(), None)
}

/// Lowercase words: at separators, digits, and before a capital that follows a small letter.
pub(super) fn words(stem: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    for c in stem.chars() {
        let begins = c.is_uppercase()
            && before.is_lowercase()
            && words.last().is_some_and(|word| word.len() > 1);
        if begins || !c.is_alphabetic() {
            words.push(String::new());
        }
        if c.is_alphabetic()
            && let Some(word) = words.last_mut()
        {
            word.extend(c.to_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channel(name: &str) -> (Quantity, Axis, Option<&'static str>) {
        match meaning(name) {
            Meaning::Channel {
                quantity,
                axis,
                unit,
            } => (quantity, axis, unit.map(|unit| unit.name)),
            other => panic!("{name}: {other:?}"),
        }
    }

    #[test]
    fn names_in_every_style_say_what_they_say() {
        use Axis::{Along, X, Y, Z};
        use Quantity::{Acceleration, Force, Position, Speed, Torque};
        for (name, quantity, axis, unit) in [
            ("Ax (g)", Acceleration, X, Some("g")),
            ("Ax(g)", Acceleration, X, Some("g")),
            ("acc_y [g]", Acceleration, Y, Some("g")),
            ("Acceleration x (m/s^2)", Acceleration, X, Some("m/s^2")),
            (
                "Linear Acceleration z (m/s^2)",
                Acceleration,
                Z,
                Some("m/s^2"),
            ),
            ("accel_x_mg", Acceleration, X, Some("mg")),
            ("ax_g", Acceleration, X, Some("g")),
            ("az_m_s2", Acceleration, Z, Some("m/s^2")),
            ("AccelX", Acceleration, X, None),
            ("accelerometerY", Acceleration, Y, None),
            ("a", Acceleration, Along, None),
            ("X (g)", Acceleration, X, Some("g")),
            ("channel 1 (g)", Acceleration, Along, Some("g")),
            ("Fn(N)", Force, Z, Some("N")),
            ("Ft(N)", Force, Along, Some("N")),
            ("force_z_mN", Force, Z, Some("mN")),
            ("fx_n", Force, X, Some("N")),
            ("Normal force", Force, Z, None),
            ("Tz [N*m]", Torque, Z, Some("N*m")),
            ("x [mm]", Position, X, Some("mm")),
            ("pos_x_um", Position, X, Some("um")),
            ("speed_mm_s", Speed, Along, Some("mm/s")),
            ("vx (mm/s)", Speed, X, Some("mm/s")),
            ("Fz (kg)", Force, Z, Some("kgf")),
            ("Force (g)", Force, Along, Some("gf")),
            ("fz_g", Force, Z, Some("gf")),
            ("Load cell (kg)", Force, Along, Some("kgf")),
            ("Fz (lbf)", Force, Z, Some("lbf")),
            ("gFx", Acceleration, X, Some("g")),
            ("field.linear_acceleration.x", Acceleration, X, None),
            ("/imu/linear_acceleration/y", Acceleration, Y, None),
            ("field.wrench.force.z", Force, Z, None),
            ("/ft/wrench/torque/x", Torque, X, None),
            ("/tip/pose/position/x", Position, X, None),
            ("AI 1/acc x (m/s2)", Acceleration, X, Some("m/s^2")),
        ] {
            assert_eq!(channel(name), (quantity, axis, unit), "{name}");
        }
    }

    #[test]
    fn clocks_have_the_unit_that_they_name() {
        for (name, unit) in [
            ("Time (s)", Some("s")),
            ("Time(ms)", Some("ms")),
            ("time [s]", Some("s")),
            ("t_us", Some("us")),
            ("timestamp_ns", Some("ns")),
            ("seconds_elapsed", Some("s")),
            ("Timestamp", None),
            ("t", None),
            ("millis", Some("ms")),
            ("Zeit [s]", Some("s")),
            ("Time ms", Some("ms")),
            ("%time", None),
            ("__time", None),
            ("X_Value", None),
            ("Date/Time", None),
        ] {
            assert_eq!(meaning(name), Meaning::Clock(unit), "{name}");
        }
    }

    #[test]
    fn what_a_name_does_not_say_is_not_guessed() {
        for name in [
            "label",
            "accuracy",
            "gyro_x",
            "gx (deg/s)",
            "temperature",
            "count",
            "/imu/orientation/x",
            "/imu/angular_velocity/x",
            "field.header.stamp.secs",
            "mass (kg)",
            "0",
            "",
        ] {
            assert_eq!(meaning(name), Meaning::Unknown, "{name}");
        }
        assert_eq!(meaning("x"), Meaning::Bare(Axis::X));
        for (name, quantity) in [
            ("Ax (deg)", Quantity::Acceleration),
            ("X position [in]", Quantity::Position),
            ("Fz (V)", Quantity::Force),
        ] {
            assert_eq!(meaning(name), Meaning::OtherUnit(quantity), "{name}");
        }
        // Its magnitude lies along no axis.
        assert_eq!(meaning("Absolute acceleration (m/s^2)"), Meaning::Unknown);
    }
}
