//! Placeholders that tables hold where a value is missing or wrong.

/// Returns true if a text is what spreadsheets, databases and scripts write for a cell without a value, or with an
/// error.
pub(super) fn is_nothing(text: &str) -> bool {
    const WORDS: [&str; 16] = [
        "na",
        "n/a",
        "n/d",
        "n/a n/a",
        "nan",
        "nat",
        "nil",
        "none",
        "null",
        "undefined",
        "missing",
        "1#ind",
        "1#qnan",
        "1#inf",
        "n",
        "blank",
    ];
    // Words that are prompts unless marks stand around them.
    const MARKED: [&str; 2] = ["n", "blank"];
    let small = text.trim().to_lowercase();
    let core = small.trim_matches(is_mark).replace('.', "");
    is_error(text)
        || core.is_empty()
        || WORDS.contains(&core.as_str()) && (core != small || !MARKED.contains(&core.as_str()))
}

/// Returns true if a character is neither alphanumeric nor a picture.
fn is_mark(c: char) -> bool {
    !c.is_alphanumeric() && c < '\u{2190}' || matches!(c, 'ー' | '\u{ff01}'..='\u{ff0f}')
}

/// Returns true if a text is the error of a spreadsheet's formula: Excel localises them, as #REF!, #BEZUG!, #YOK and
/// #¿NOMBRE?; LibreOffice numbers some.
pub(super) fn is_error(text: &str) -> bool {
    let text = text.trim();
    let numbered = |name: &&str| {
        let rest = text
            .get(..name.len())
            .filter(|head| head.eq_ignore_ascii_case(name));
        let number = rest.and_then(|_| text[name.len()..].trim_start().strip_prefix(':'));
        number.is_some_and(|number| number.trim().parse::<u16>().is_ok())
    };
    let is_plain = |c: char| c.is_lowercase() || c.is_ascii_digit();
    text.strip_prefix(['#', '＃']).is_some_and(|rest| {
        !rest.contains(is_plain) && rest.contains(char::is_alphabetic)
            || rest.ends_with(['!', '?']) && !rest.contains(' ')
    }) || ["Err", "Fehler", "Erreur", "Errore"].iter().any(numbered)
}
