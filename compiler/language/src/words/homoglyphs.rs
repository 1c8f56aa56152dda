//! Letters of other scripts that look like Latin ones.
//!
//! "sаndpaper" with a Cyrillic а is read as it looks. The pairs are those of Unicode's confusables (UTS #39) in
//! Cyrillic and Greek, and the small letters whose capitals are alike ("В", "Н"); `unicode-security` has the 6,500 of all
//! scripts, which is many for these.

/// Letters, each before the Latin one that it looks like.
const ALIKE: &[(&str, &str)] = &[
    // Cyrillic
    ("АВЕКМНОРСТУХІЈЅԚԜЅѴҺ", "ABEKMHOPCTYXIJSQWSVH"),
    ("авекмнорстухіїјѕԛԝԁһӏѵ", "abekmhopctyxiijsqwdhlv"),
    // Greek; its small mu stands in units.
    ("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "ABEZHIKMNOPTYX"),
    ("αγεικνορτυχϲϳ", "ayeikvoptuxcj"),
    // Of phonetic alphabets, and the dotless i.
    ("ɑɡı", "agi"),
];

/// A text whose words of Latin letters or digits hold no letter that only looks like one. A word with any other letter
/// of another script stays as it is, for it may be a word of that script.
pub(super) fn latin(text: &str) -> String {
    let mut latin = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let inside = first.is_alphanumeric();
        let end = rest.find(|c: char| c.is_alphanumeric() != inside);
        let (run, after) = rest.split_at(end.unwrap_or(rest.len()));
        let mixed = inside && run.contains(|c: char| c.is_ascii_alphanumeric());
        match mixed.then(|| run.chars().map(letter).collect::<Option<String>>()) {
            Some(Some(word)) => latin.push_str(&word),
            _ => latin.push_str(run),
        }
        rest = after;
    }
    latin
}

/// The Latin letter that a character is or looks like.
fn letter(character: char) -> Option<char> {
    if is_latin(character) || character.is_ascii_digit() {
        return Some(character);
    }
    ALIKE.iter().find_map(|(others, latin)| {
        let at = others.chars().position(|other| other == character)?;
        latin.chars().nth(at)
    })
}

fn is_latin(character: char) -> bool {
    character.is_ascii_alphabetic() || matches!(character, 'À'..='\u{130}' | '\u{132}'..='\u{24f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_of_latin_letters_is_read_as_it_looks() {
        for (typed, expected) in [
            ("sаndpaper", "sandpaper"),
            ("соrk, sιlk", "cork, silk"),
            ("LEАTHER ΝYLON", "LEATHER NYLON"),
            ("Р80", "P80"),
            ("crème 20 mm", "crème 20 mm"),
            // Words of their own, units, and letters that look like none.
            ("шелк бархат", "шелк бархат"),
            ("сок", "сок"),
            ("0.8 μm Ωm", "0.8 μm Ωm"),
            ("sжndpaper", "sжndpaper"),
        ] {
            assert_eq!(latin(typed), expected, "{typed}");
        }
    }

    #[test]
    fn every_letter_has_its_like() {
        for (others, alike) in ALIKE {
            assert_eq!(others.chars().count(), alike.chars().count(), "{others}");
            assert!(alike.is_ascii() && !others.contains(|c: char| c.is_ascii()));
        }
    }
}
