//! How people write numbers with a meaning.

use super::{Grade, Scale, parts::Parts};
use crate::words::Token;

/// What a prompt is about, where a number alone has two readings: "95A", "1000D".
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Context {
    polymer: bool,
    textile: bool,
    file: bool,
}

const POLYMERS: &[&str] = &[
    "rubber",
    "silicone",
    "tpu",
    "tpe",
    "urethane",
    "polyurethane",
    "elastomer",
    "neoprene",
    "gel",
    "latex",
    "gasket",
    "seal",
    "sole",
    "roller",
    "bumper",
    "plastic",
    "nylon",
    "durometer",
    "shore",
];
const TEXTILES: &[&str] = &[
    "nylon",
    "polyester",
    "cordura",
    "tights",
    "stockings",
    "stocking",
    "pantyhose",
    "fabric",
    "cloth",
    "yarn",
    "microfibre",
    "webbing",
    "hosiery",
    "ripstop",
    "oxford",
    "backpack",
    "tent",
    "denier",
];

impl Context {
    pub(crate) fn of(tokens: &[Token]) -> Self {
        let says = |words: &[&str]| {
            tokens.iter().any(|token| match token {
                Token::Word(word) => words.contains(&word.as_str()),
                Token::Break => false,
            })
        };
        Self {
            polymer: says(POLYMERS),
            textile: says(TEXTILES),
            file: says(&["file", "files"]),
        }
    }

    /// Of a file.
    pub(super) fn of_file() -> Self {
        Self {
            file: true,
            ..Self::default()
        }
    }
}

/// Words that may stand between a scale and its number: "grit size of 80".
const FILLERS: &[&str] = &[
    "of", "is", "size", "hardness", "rating", "number", "value", "about", "around", "grade",
    "scale", "no", "height", "depth", "length",
];
/// Units of what is measured otherwise: "mesh 20 mm wide" is no mesh 20.
const LENGTHS: &[&str] = &[
    "mm", "cm", "m", "in", "inch", "inches", "kg", "g", "ft", "x",
];
const MICROMETRES: &[&str] = &[
    "μm",
    "um",
    "micron",
    "microns",
    "micrometre",
    "micrometres",
    "micrometer",
    "micrometers",
];

/// The grade that tokens begin with, and how many it takes.
pub(crate) fn read(tokens: &[Token], context: Context) -> Option<(usize, Grade)> {
    const FORMS: [fn(&mut Parts<'_>, Context) -> Option<Grade>; 9] =
        [cut, ra, shore, mohs, threads, denier, pile, mesh, grit];
    let parts = Parts::new(tokens);
    FORMS.iter().find_map(|form| {
        let mut parts = parts.clone();
        let grade = form(&mut parts, context)?;
        Some((parts.tokens()?, grade))
    })
}

fn grade(scale: Scale, value: Option<f64>, range: std::ops::RangeInclusive<f64>) -> Option<Grade> {
    let value = value.filter(|value| range.contains(value))?;
    Some(Grade { scale, value })
}

/// A number after the name of its scale: "grit size: 80".
fn after(parts: &mut Parts<'_>) -> Option<f64> {
    parts.pass(FILLERS);
    let value = parts.number()?;
    let length = parts.clone().eat(LENGTHS);
    (!length).then_some(value)
}

/// "P80", "#80", "80 grit", "grit 80", "80-grade grit".
fn grit(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    const GRIT: &[&str] = &["grit", "grits"];
    let (p, value) = if parts.eat(&["p"]) {
        (true, parts.number())
    } else if parts.eat(&["#"]) {
        let value = parts.number();
        parts.eat(GRIT);
        (false, value)
    } else if parts.eat(GRIT) {
        parts.pass(FILLERS);
        let p = parts.eat(&["p"]);
        parts.eat(&["#"]);
        (p, after(parts))
    } else {
        let value = parts.number();
        if !parts.eat(GRIT) {
            return None;
        }
        (false, value)
    };
    grade(Scale::Grit { p }, value, 6.0..=30_000.0)
}

/// "20 mesh", "mesh 20", "mesh size 20".
fn mesh(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    let value = if parts.eat(&["mesh"]) {
        after(parts)
    } else {
        parts.eat(&["#"]);
        let value = parts.number();
        if !parts.eat(&["mesh"]) {
            return None;
        }
        parts.eat(&["size"]);
        value
    };
    grade(Scale::Mesh, value, 2.0..=3000.0)
}

/// "Shore A 60", "60A Shore", "durometer 60", "30A" of a polymer.
fn shore(parts: &mut Parts<'_>, context: Context) -> Option<Grade> {
    const SCALE: &[&str] = &["shore", "durometer", "duro"];
    const LETTERS: &[&str] = &["a", "d"];
    let mut d = None;
    if parts.eat(&["hardness"]) {
        parts.pass(FILLERS);
    }
    let value = if parts.eat(SCALE) {
        parts.pass(&["hardness", "scale"]);
        if parts.eat(&["a"]) {
            d = Some(false);
        } else if parts.eat(&["d"]) {
            d = Some(true);
        }
        parts.pass(FILLERS);
        let value = parts.number();
        if let Some(letter) = parts.glued_letter(LETTERS) {
            d = Some(letter == "d");
        }
        // "durometer 60 Shore A", "durometer of 70A Shore"
        if parts.eat(SCALE) && parts.eat(&["d"]) {
            d = Some(true);
        } else if d.is_none() {
            parts.eat(&["a"]);
        }
        value
    } else {
        let value = parts.number();
        let letter = parts.glued_letter(LETTERS);
        d = letter.map(|letter| letter == "d");
        let said = parts.eat(SCALE);
        if said {
            parts.eat(&["hardness"]);
            if d.is_none() && parts.eat(&["d"]) {
                d = Some(true);
            } else if d.is_none() {
                parts.eat(&["a"]);
            }
            parts.eat(&["hardness"]);
        }
        let cloth = d == Some(true) && context.textile;
        if !said && (letter.is_none() || !context.polymer || cloth) {
            return None;
        }
        value
    };
    let scale = if d == Some(true) {
        Scale::ShoreD
    } else {
        Scale::ShoreA
    };
    grade(scale, value, 0.0..=100.0)
}

/// "Mohs 7", "7 Mohs", "hardness 7 on the Mohs scale".
fn mohs(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    const MOHS: &[&str] = &["mohs", "moh's"];
    if parts.eat(&["hardness"]) {
        parts.pass(FILLERS);
    }
    let value = if parts.eat(MOHS) {
        after(parts)
    } else {
        let value = parts.number();
        let said = parts.eat(MOHS) || parts.eat_all(&["on", "the", "mohs"]);
        parts.eat(&["hardness", "scale"]);
        value.filter(|_| said)
    };
    grade(Scale::Mohs, value, 1.0..=10.0)
}

/// "Ra 0.8", "Ra = 3.2 µm", "0.4 µm Ra", "roughness of 6.3 µm".
fn ra(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    parts.eat(&["surface", "average", "mean"]);
    let named = parts.eat(&["roughness"]);
    parts.pass(FILLERS);
    let said = parts.eat(&["ra"]);
    parts.pass(FILLERS);
    let value = parts.number()?;
    let (unit, factor) = if parts.eat(MICROMETRES) {
        (true, 1.0)
    } else if parts.eat(&["nm", "nanometre", "nanometres"]) {
        (true, 1e-3)
    } else if parts.eat(&["μin", "uin", "microinch", "microinches"]) {
        (true, 0.0254)
    } else {
        (false, 1.0)
    };
    // A number, a unit and then "Ra"; or a roughness with a unit.
    let said = said || parts.eat(&["ra"]) || (named && unit);
    if !said {
        return None;
    }
    // Binary fractions are not shown.
    let value = (value * factor * 1e6).round() / 1e6;
    grade(Scale::Ra, Some(value), 0.001..=200.0)
}

/// "400 thread count", "thread count of 400", "400 TC".
fn threads(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    const THREADS: &[&str] = &["thread", "threads"];
    let value = if parts.eat(&["tc"]) || parts.eat_all(&["thread", "count"]) {
        after(parts)
    } else {
        let value = parts.number();
        let counted = parts.eat(THREADS)
            && (parts.eat(&["count"])
                || parts.eat_all(&["per", "square", "inch"])
                || parts.eat_all(&["per", "inch"]));
        value.filter(|_| counted || parts.eat(&["tc"]))
    };
    grade(Scale::Threads, value, 20.0..=3000.0)
}

/// "15 denier", "15 den", "denier 15", "1000D nylon", "100 dtex".
fn denier(parts: &mut Parts<'_>, context: Context) -> Option<Grade> {
    const DENIER: &[&str] = &["denier", "den", "deniers"];
    let value = if parts.eat(DENIER) {
        after(parts)
    } else {
        let value = parts.number();
        if context.textile && parts.glued_letter(&["d"]).is_some() {
            value
        } else if parts.eat(&["dtex"]) {
            value.map(|dtex| (90.0 * dtex).round() / 100.0)
        } else {
            value.filter(|_| parts.eat(DENIER))
        }
    };
    grade(Scale::Denier, value, 1.0..=10_000.0)
}

/// "12 mm pile", "pile of 30 mm", "pile height 1.5 cm".
fn pile(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    let named = parts.eat(&["pile"]);
    if named {
        parts.pass(FILLERS);
    }
    let value = parts.number()?;
    let factor = if parts.eat(&[
        "mm",
        "millimetre",
        "millimetres",
        "millimeter",
        "millimeters",
    ]) {
        1.0
    } else if parts.eat(&[
        "cm",
        "centimetre",
        "centimetres",
        "centimeter",
        "centimeters",
    ]) {
        10.0
    } else if parts.eat(&["in", "inch", "inches"]) {
        25.4
    } else {
        return None;
    };
    if !named {
        parts.eat(&["deep", "long", "high", "tall", "thick"]);
        if !parts.eat(&["pile"]) {
            return None;
        }
    }
    grade(
        Scale::Pile,
        Some((1e3 * value * factor).round() / 1e3),
        0.2..=200.0,
    )
}

/// Cuts of files (ISO 234) and of Swiss files, and about how many teeth they have per inch at 200 mm;
/// makers differ.
pub(super) const CUTS: [(&str, f64); 12] = [
    ("coarse cut", 20.0),
    ("bastard cut", 30.0),
    ("second cut", 42.0),
    ("smooth cut", 60.0),
    ("dead smooth cut", 100.0),
    ("cut 00", 38.0),
    ("cut 0", 51.0),
    ("cut 1", 64.0),
    ("cut 2", 79.0),
    ("cut 3", 97.0),
    ("cut 4", 117.0),
    ("cut 6", 173.0),
];

/// "bastard file", "second-cut file", "dead smooth file", "Swiss cut 00" of a file.
fn cut(parts: &mut Parts<'_>, context: Context) -> Option<Grade> {
    parts.eat(&["swiss"]);
    let (after, teeth) = CUTS
        .iter()
        .filter(|_| context.file)
        .find_map(|(cut, teeth)| {
            let mut after = parts.clone();
            let found = match cut.strip_suffix(" cut") {
                Some(name) => {
                    let name: Vec<&str> = name.split(' ').collect();
                    let named = after.eat_all(&name);
                    named && (after.eat(&["cut"]) || after.clone().eat(&["file", "files"]))
                }
                None => after.eat_all(&cut.split(' ').collect::<Vec<_>>()),
            };
            found.then_some((after, *teeth))
        })?;
    *parts = after;
    grade(Scale::Cut, Some(teeth), 1.0..=1000.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::normalise;

    /// The first grade of a prompt, as it is shown.
    fn shown(prompt: &str) -> Option<String> {
        let tokens = normalise(prompt);
        let context = Context::of(&tokens);
        (0..tokens.len()).find_map(|at| Some(read(&tokens[at..], context)?.1.to_string()))
    }

    #[test]
    fn a_number_is_read_in_every_notation() {
        for (prompt, expected) in [
            ("P80 sandpaper", "P80"),
            ("sandpaper P 80", "P80"),
            ("80-grit sandpaper", "80 grit"),
            ("80grit paper", "80 grit"),
            ("sandpaper, grit 80", "80 grit"),
            ("sandpaper, grit: 80", "80 grit"),
            ("sandpaper with a grit size of 80", "80 grit"),
            ("#80 sandpaper", "80 grit"),
            ("grit P120", "P120"),
            ("a 1,000 grit whetstone", "1000 grit"),
            ("20-mesh sand", "20 mesh"),
            ("sand, mesh size 60", "60 mesh"),
            ("Shore A 60 rubber", "Shore A 60"),
            ("rubber, 60 Shore A", "Shore A 60"),
            ("60A Shore rubber", "Shore A 60"),
            ("rubber of Shore hardness A60", "Shore A 60"),
            ("30A silicone", "Shore A 30"),
            ("TPU 95A", "Shore A 95"),
            ("plastic, Shore D80", "Shore D 80"),
            ("plastic, Shore 80D", "Shore D 80"),
            ("rubber of Shore 60A", "Shore A 60"),
            ("75D durometer plastic", "Shore D 75"),
            ("durometer 40 rubber", "Shore A 40"),
            ("a mineral of Mohs hardness 7", "Mohs 7"),
            ("6.5 Mohs stone", "Mohs 6.5"),
            ("stone with hardness 3 on the Mohs scale", "Mohs 3"),
            ("steel, Ra 0.8", "Ra 0.8 µm"),
            ("Ra = 3.2 µm steel", "Ra 3.2 µm"),
            ("Ra 0,4 steel", "Ra 0.4 µm"),
            ("0.4µm Ra aluminium", "Ra 0.4 µm"),
            ("steel with a surface roughness of 6.3 microns", "Ra 6.3 µm"),
            ("63 µin Ra steel", "Ra 1.6002 µm"),
            ("400 thread count sheets", "400 thread count"),
            ("sheets with a thread count of 1,200", "1200 thread count"),
            ("600TC percale", "600 thread count"),
            ("15 denier tights", "15 denier"),
            ("1000D nylon", "1000 denier"),
            ("100 dtex polyester", "90 denier"),
            ("12 mm pile carpet", "12 mm pile"),
            ("a rug with a pile height of 3cm", "30 mm pile"),
            ("bastard file", "bastard cut"),
            ("a dead-smooth file", "dead smooth cut"),
            ("file, second cut", "second cut"),
            ("Swiss cut 00 file", "cut 00"),
            ("half-inch … 0.5 inch pile rug", "12.7 mm pile"),
        ] {
            assert_eq!(shown(prompt).as_deref(), Some(expected), "{prompt}");
            assert_eq!(
                Grade::of(expected).map(|g| g.to_string()).as_deref(),
                Some(expected)
            );
        }
    }

    #[test]
    fn other_numbers_are_none() {
        for prompt in [
            "3 mm thick rubber",
            "wire mesh 20 mm wide",
            "80 sheets of paper",
            "oak from 1870",
            "type 2 rubber",
            "A4 paper",
            "grit",
            "Mohs",
            "Shore A 400 rubber",
            "a pile of 30 leaves",
            "2 threads of wool",
            "4D",
        ] {
            assert_eq!(shown(prompt), None, "{prompt}");
        }
    }
}
