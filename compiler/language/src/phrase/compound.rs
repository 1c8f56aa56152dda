//! Things by what they are made of: "bamboo mat", "a gate of steel".
//!
//! The material is what is stroked, and material and thing together are what yields. A vector of both
//! words may lie near a third thing, such as the mat of another material.

use super::Phrase;
use crate::lexicon::{is_name, own_part, substance};

/// Things whose own relief is felt, of whatever they are made: "wire mesh", "nylon brush".
const RELIEFS: &[&str] = &[
    "band", "blanket", "braid", "bristle", "bristles", "broom", "brush", "carpet", "chain",
    "chips", "cloth", "comb", "cord", "fabric", "fibre", "file", "fur", "grate", "grater", "grid",
    "grille", "gravel", "hair", "knit", "lattice", "mesh", "net", "netting", "pebbles", "pile",
    "rasp", "rope", "rug", "scourer", "screw", "shavings", "sieve", "sponge", "string", "thread",
    "towel", "tread", "twine", "weave", "wire", "wool", "yarn", "zip",
];

/// "bamboo mat", "a mat of bamboo", "a mat made of bamboo".
pub(super) fn made(words: &[String]) -> Option<Phrase> {
    let texts: Vec<&str> = words.iter().map(String::as_str).collect();
    let texts = match &texts[..] {
        ["a" | "an" | "the", rest @ ..] => rest,
        all => all,
    };
    let (object, material) = match texts {
        [material, object] => (object, material),
        [object, "of" | "from", material] | [object, "made", "of" | "from", material] => {
            (object, material)
        }
        _ => return None,
    };
    let material = substance(material)?;
    let head = object.rsplit(' ').next()?;
    let whole = is_name(object) && substance(object).is_none() && !RELIEFS.contains(&head);
    whole.then(|| Phrase::Made {
        material: material.to_owned(),
        object: (*object).to_owned(),
    })
}

/// "axe handle", which is a name; a vector of it lies near axes.
pub(super) fn part(words: &[String]) -> Option<Phrase> {
    let [name] = words else { return None };
    let part = own_part(name)?.to_owned();
    Some(Phrase::Part {
        name: name.clone(),
        part,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_material_stands_before_its_thing_or_behind_it() {
        let read = |text: &str| {
            let words: Vec<String> = text.split(' ').map(str::to_owned).collect();
            made(&words)
        };
        let mat = Phrase::Made {
            material: "bamboo".into(),
            object: "mat".into(),
        };
        for text in [
            "bamboo mat",
            "a bamboo mat",
            "the mat of bamboo",
            "mat from bamboo",
            "a mat made of bamboo",
            "mat made from bamboo",
        ] {
            assert_eq!(read(text).as_ref(), Some(&mat), "{text}");
        }
        // A relief is felt whatever it is made of, and a mat is no material.
        for text in ["steel mesh", "mat bamboo", "bamboo", "mat on bamboo"] {
            assert_eq!(read(text), None, "{text}");
        }
    }
}
