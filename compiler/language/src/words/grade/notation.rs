//! Notations for numbers with a meaning.

use super::{Grade, Scale, is_abrasive, parts::Parts};
use crate::words::Token;

/// Subject of a prompt, which decides between two readings of a bare number: "95A", "1000D".
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Context {
    polymer: bool,
    textile: bool,
    file: bool,
    abrasive: bool,
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
                Token::Break(_) => false,
            })
        };
        Self {
            polymer: says(POLYMERS),
            textile: says(TEXTILES),
            file: says(&["file", "files"]),
            abrasive: tokens.len() == 1
                || tokens.iter().any(|token| match token {
                    Token::Word(word) => is_abrasive(word) || word == "paper",
                    Token::Break(_) => false,
                }),
        }
    }

    /// Context of a file.
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
/// Least number that a letter behind it makes a grade: "3D" is no hardness.
const LEAST_GLUED: f64 = 5.0;
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

/// The grade that tokens begin with, and how many it takes; its number may be out of range.
pub(super) fn any(tokens: &[Token], context: Context) -> Option<(usize, Grade)> {
    const FORMS: [fn(&mut Parts<'_>, Context) -> Option<Grade>; 10] = [
        cut, ra, shore, mohs, threads, denier, pile, mesh, grit, wale,
    ];
    let read = |grouped: bool| {
        let parts = Parts::new(tokens, grouped);
        FORMS.iter().find_map(|form| {
            let mut parts = parts.clone();
            let grade = form(&mut parts, context)?;
            Some((parts.tokens()?, grade))
        })
    };
    // "mesh 20 100 g" is no mesh of 20,100.
    let found = read(true);
    if found.is_some_and(|(_, grade)| grade.is_in_range()) {
        return found;
    }
    read(false).or(found)
}

/// The grade that tokens begin with, and how many it takes.
pub(crate) fn read(tokens: &[Token], context: Context) -> Option<(usize, Grade)> {
    any(tokens, context).filter(|(_, grade)| grade.is_in_range())
}

fn grade(scale: Scale, value: Option<f64>) -> Option<Grade> {
    Some(Grade {
        scale,
        value: value?,
    })
}

/// A number after the name of its scale: "grit size: 80".
fn after(parts: &mut Parts<'_>) -> Option<f64> {
    parts.pass(FILLERS);
    let value = parts.number()?;
    let length = parts.clone().eat(LENGTHS);
    (!length).then_some(value)
}

/// "P80", "#80", "80 grit", "grit 80", "80-grade grit".
fn grit(parts: &mut Parts<'_>, context: Context) -> Option<Grade> {
    const GRIT: &[&str] = &["grit", "grits"];
    // "P2" is also a mask, "#1" also the best.
    let sure = |grade: &Grade| context.abrasive || grade.is_in_range();
    let (p, value) = if parts.eat(&["p"]) {
        return grade(Scale::Grit { p: true }, parts.number()).filter(sure);
    } else if parts.eat(&["#"]) {
        let value = parts.number();
        let said = parts.eat(GRIT);
        return grade(Scale::Grit { p: false }, value).filter(|grade| said || sure(grade));
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
    grade(Scale::Grit { p }, value)
}

/// "20 mesh", "mesh 20", "mesh size 20".
fn mesh(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    let value = if parts.eat(&["mesh"]) {
        after(parts)
    } else {
        parts.eat(&["#"]);
        let spelt = parts.text()?.starts_with(char::is_alphabetic);
        // "two mesh bags"
        let value = parts.number().filter(|value| !spelt || *value >= 10.0);
        if !parts.eat(&["mesh"]) {
            return None;
        }
        parts.eat(&["size"]);
        value
    };
    grade(Scale::Mesh, value)
}

/// "14-wale corduroy".
fn wale(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    let value = parts.number()?;
    let said = parts.eat(&["wale", "wales"]);
    grade(Scale::Wale, Some(value).filter(|_| said))
}

/// "Shore A 60", "60A Shore", "durometer 60", "30A" of a polymer.
fn shore(parts: &mut Parts<'_>, context: Context) -> Option<Grade> {
    const SCALE: &[&str] = &["shore", "durometer", "duro"];
    const LETTERS: &[&str] = &["a", "d"];
    // Scales of other springs and tips, whose numbers are no Shore A.
    const OTHERS: &[&str] = &["00", "000", "b", "c", "do", "e", "m", "o", "oo", "ooo"];
    let mut d = None;
    if parts.eat(&["hardness"]) {
        parts.pass(FILLERS);
    }
    let value = if parts.eat(SCALE) {
        parts.pass(&["hardness", "scale"]);
        if parts.eat(OTHERS) {
            return None;
        }
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
            if parts.eat(OTHERS) {
                return None;
            }
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
        // "240A", "3D"
        value.filter(|value| said || (LEAST_GLUED..=100.0).contains(value))
    };
    let scale = if d == Some(true) {
        Scale::ShoreD
    } else {
        Scale::ShoreA
    };
    grade(scale, value)
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
    grade(Scale::Mohs, value)
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
    grade(Scale::Ra, Some(value))
}

/// "400 thread count", "thread count of 400", "400 TC".
fn threads(parts: &mut Parts<'_>, _: Context) -> Option<Grade> {
    const THREADS: &[&str] = &["thread", "threads"];
    let value = if parts.eat(&["tc"]) || parts.eat_all(&["thread", "count"]) {
        after(parts)
    } else {
        let value = parts.number();
        let counted = |parts: &mut Parts<'_>| {
            parts.eat_all(&["count"]) || parts.eat_all(&["per", "square", "inch"])
        };
        let screw = |parts: &mut Parts<'_>| parts.eat_all(&["per", "inch"]);
        let said = parts.eat(&["tc"]) || (parts.eat(THREADS) && counted(parts));
        // Of a screw, too, threads are counted.
        let may = |value: &f64| Scale::Threads.range().contains(value);
        value.filter(|value| said || (may(value) && screw(parts)))
    };
    grade(Scale::Threads, value)
}

/// "15 denier", "15 den", "denier 15", "1000D nylon", "100 dtex".
fn denier(parts: &mut Parts<'_>, context: Context) -> Option<Grade> {
    const DENIER: &[&str] = &["denier", "den", "deniers"];
    let value = if parts.eat(DENIER) {
        after(parts)
    } else {
        let value = parts.number();
        if context.textile && parts.glued_letter(&["d"]).is_some() {
            value.filter(|value| *value >= LEAST_GLUED)
        } else if parts.eat(&["dtex"]) {
            value.map(|dtex| (90.0 * dtex).round() / 100.0)
        } else {
            value.filter(|_| parts.eat(DENIER))
        }
    };
    grade(Scale::Denier, value)
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
    // "a 300 mm pile of leaves"
    let heap = !named && parts.clone().eat(&["of"]);
    grade(Scale::Pile, Some((1e3 * value * factor).round() / 1e3))
        .filter(|grade| grade.is_in_range() || !heap)
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
    grade(Scale::Cut, Some(teeth))
}

#[cfg(test)]
mod tests;
