//! Words without their endings, as the table of materials is looked up by.

/// Plurals that no ending tells.
const IRREGULAR: &[(&str, &str)] = &[("leaves", "leaf"), ("loaves", "loaf"), ("teeth", "tooth")];

/// Words in lower case without their plural ending.
pub(crate) fn stems(text: &str) -> Vec<String> {
    text.split(|c: char| !c.is_alphanumeric() && c != '\'')
        .filter(|word| !word.is_empty())
        .map(|word| stem(&word.to_lowercase()))
        .collect()
}

fn stem(word: &str) -> String {
    let cut = |ending: &str, new: &str| {
        let stem = word.strip_suffix(ending).filter(|stem| stem.len() >= 3)?;
        Some(format!("{stem}{new}"))
    };
    if let Some(singular) = IRREGULAR.iter().find(|(plural, _)| *plural == word) {
        return singular.1.to_owned();
    }
    if word.ends_with("ss") || word.ends_with("us") {
        return word.to_owned();
    }
    cut("ies", "y")
        .or_else(|| cut("'s", ""))
        .or_else(|| cut("shes", "sh"))
        .or_else(|| cut("ches", "ch"))
        .or_else(|| cut("s", ""))
        .unwrap_or_else(|| word.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plurals_and_possessives_are_their_singulars() {
        assert_eq!(stems("Bricks, LEAVES"), ["brick", "leaf"]);
        assert_eq!(stems("the cat's brushes"), ["the", "cat", "brush"]);
        assert_eq!(stems("glass moss cactus"), ["glass", "moss", "cactus"]);
    }
}
