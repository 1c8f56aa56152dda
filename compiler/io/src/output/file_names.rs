//! File names of textures, which are safe on every system.
//!
//! A name becomes its file's name as far as it can. These become `_`: the characters that a system
//! refuses (`/ \ < > : " | ? *`), control characters, invisible ones and those that turn the
//! direction of text, and spaces and dots at the end. A name gets a `_` in front where it begins with a dash, a
//! dot, a tilde or a space, or where Windows takes it for a device (`NUL`, `COM1`). Names that
//! would then be one file, also where upper and lower case and composed and decomposed letters are
//! the same, are distinguished by a number.

use std::collections::HashMap;
use unicode_categories::UnicodeCategories as _;
use unicode_normalization::UnicodeNormalization as _;

/// Characters that some system refuses or takes for the border of a folder.
const REFUSED: &str = r#"/\<>:"|?*"#;
/// Names that Windows takes for devices, whatever follows a dot.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "conin$", "conout$"];
/// Such names with a digit behind them.
const PORTS: [&str; 2] = ["com", "lpt"];

/// File names of textures.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FileNames {
    /// File name of each texture, in their order; all differ.
    pub files: Vec<String>,
    /// Notes to the user: names that differ from those of their files.
    pub changed: Vec<String>,
}

impl FileNames {
    /// The files of textures of these names, with an ending such as `asp`.
    #[must_use]
    pub fn of(names: &[&str], ending: &str) -> Self {
        let mut taken: HashMap<String, usize> = HashMap::with_capacity(names.len());
        let mut found = Self::default();
        for name in names {
            let safe = safe(name);
            let mut file = format!("{safe}.{ending}");
            // Many names may come to one: each starts where the last one of them stopped.
            let mut next = taken.get(&folded(&file)).copied().unwrap_or(0);
            if next > 0 {
                let first = folded(&file);
                while taken.contains_key(&folded(&file)) {
                    next += 1;
                    file = format!("{safe} ({next}).{ending}");
                }
                taken.insert(first, next);
            }
            taken.insert(folded(&file), 1);
            if file.strip_suffix(ending).and_then(|f| f.strip_suffix('.')) != Some(name) {
                found
                    .changed
                    .push(format!("{name:?} is written as {file:?}"));
            }
            found.files.push(file);
        }
        found
    }
}

/// The name without what a system refuses or obeys.
fn safe(name: &str) -> String {
    let plain = |c: char| if is_refused(c) { '_' } else { c };
    let mut safe: String = name.chars().map(plain).collect();
    let kept = safe.trim_end_matches(|c: char| c == '.' || c.is_whitespace());
    let cut = safe[kept.len()..].chars().count();
    safe.truncate(kept.len());
    safe.extend(std::iter::repeat_n('_', cut));
    let led = safe.starts_with(|c: char| matches!(c, '-' | '.' | '~') || c.is_whitespace());
    if led || is_device(&safe) {
        safe.insert(0, '_');
    }
    safe
}

/// Returns true if a character is refused in file names, or invisible or misleading in them.
fn is_refused(c: char) -> bool {
    REFUSED.contains(c)
        || c.is_control()
        || c.is_other_format()
        || c.is_separator_line()
        || c.is_separator_paragraph()
        // Later than the table of categories: isolates and tags.
        || matches!(c, '\u{61c}' | '\u{2066}'..='\u{2069}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e0fff}')
}

fn is_device(name: &str) -> bool {
    let own = name.split('.').next().unwrap_or(name);
    let own = own.trim_end().to_lowercase();
    let is_port = |port: &&str| {
        let number = own.strip_prefix(*port).and_then(|rest| {
            let mut rest = rest.chars();
            rest.next().filter(|_| rest.next().is_none())
        });
        number.is_some_and(|n| n.is_ascii_digit() || matches!(n, '¹' | '²' | '³'))
    };
    DEVICES.contains(&own.as_str()) || PORTS.iter().any(is_port)
}

/// Returns the key under which two names collide on some file system: lower case, composed.
fn folded(name: &str) -> String {
    name.to_lowercase().nfc().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    fn file(name: &str) -> String {
        FileNames::of(&[name], "asp").files.remove(0)
    }

    #[test]
    fn a_name_that_every_system_takes_stays() {
        let names = [
            "oak",
            "Käse",
            "木の板",
            "2 mm",
            "a.b",
            "null",
            "com10",
            "x (2)",
            "e\u{301}",
        ];
        let found = FileNames::of(&names, "asp");
        let wanted: Vec<String> = names.iter().map(|name| format!("{name}.asp")).collect();
        assert_eq!((found.files, found.changed), (wanted, Vec::new()));
    }

    #[test]
    fn what_a_system_obeys_or_hides_is_replaced_and_told() {
        for (name, wanted) in [
            ("NUL", "_NUL.asp"),
            ("nul.txt", "_nul.txt.asp"),
            ("Com1 .x", "_Com1 .x.asp"),
            ("LPT²", "_LPT².asp"),
            ("CONIN$", "_CONIN$.asp"),
            ("-o", "_-o.asp"),
            ("..", "__.asp"),
            (".ssh", "_.ssh.asp"),
            ("~root", "_~root.asp"),
            (" oak", "_ oak.asp"),
            ("oak. .", "oak___.asp"),
            ("a/b\\c:d", "a_b_c_d.asp"),
            ("../../etc", "_.._.._etc.asp"),
            ("txt\u{202e}psa", "txt_psa.asp"),
            ("a\u{2066}b\u{200b}c\u{feff}", "a_b_c_.asp"),
            ("a\u{2028}b\u{e0041}", "a_b_.asp"),
        ] {
            let found = FileNames::of(&[name], "asp");
            assert_eq!(found.files, [wanted], "{name:?}");
            assert_eq!(found.changed.len(), 1, "{name:?}");
            // What is safe stays so.
            assert_eq!(file(wanted.strip_suffix(".asp").unwrap()), wanted);
        }
    }

    #[test]
    fn names_that_differ_are_files_that_differ() {
        let names = [
            "oak", "OAK", "oak (2)", "a/b", "a:b", "a_b", "é", "e\u{301}", "É", "NUL", "_NUL", "ﬁ",
            "fi",
        ];
        let found = FileNames::of(&names, "asp");
        let folded: HashSet<String> = found.files.iter().map(|file| folded(file)).collect();
        assert_eq!(folded.len(), names.len(), "{:?}", found.files);
        assert_eq!(
            found.files[..3],
            ["oak.asp", "OAK (2).asp", "oak (2) (2).asp"]
        );
        // Whatever comes to one file is numbered on, not counted anew.
        let many: Vec<String> = (0..20_000)
            .map(|n| {
                (0..16)
                    .map(|bit| if n >> bit & 1 == 1 { '?' } else { '*' })
                    .collect()
            })
            .collect();
        let many: Vec<&str> = many.iter().map(String::as_str).collect();
        let found = FileNames::of(&many, "asp");
        let differ: HashSet<&String> = found.files.iter().collect();
        assert_eq!(differ.len(), many.len());
    }
}
