//! Which part of a prompt its text encoder can read.
//!
//! The encoders were trained on English. Of other scripts they know some characters, but not what
//! they mean; of emoji hardly any. What they cannot read still moves the vector, so the user is warned.

use super::PromptError;
use asperity_language::words::in_letters;
use std::mem;

/// Characters of a prompt that a message repeats.
const EXCERPT: usize = 160;

/// A prompt, divided.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Understood {
    /// The words that were read, in their order.
    pub read: String,
    /// Text that was not read: other scripts, emoji, words without a token.
    pub unread: Vec<String>,
}

/// Refuses a prompt in which nothing can be seen.
///
/// # Errors
/// [`PromptError::Empty`].
pub fn check(prompt: &str) -> Result<(), PromptError> {
    let invisible = |c: char| c.is_whitespace() || c.is_control() || joins(c);
    if prompt.chars().all(invisible) {
        return Err(PromptError::Empty);
    }
    Ok(())
}

/// Divides a prompt. `reads` tells of a word in Latin letters whether the encoder has tokens for
/// it.
pub(super) fn understood(prompt: &str, reads: impl Fn(&str) -> bool) -> Understood {
    let mut read = Vec::new();
    let mut unread = Vec::new();
    for (script, run) in prompt.split_whitespace().flat_map(parted) {
        match script {
            Script::Latin if reads(&in_letters(&run)) => read.push(run),
            Script::Latin | Script::Other => unread.push(run),
            // Beside words, punctuation is no loss.
            Script::Neutral => {}
        }
    }
    if read.is_empty() && unread.is_empty() {
        unread = prompt.split_whitespace().map(str::to_owned).collect();
    }
    Understood {
        read: read.join(" "),
        unread,
    }
}

impl Understood {
    /// Returns a warning for the user, unless everything was read.
    pub(super) fn warning(&self) -> Option<String> {
        if self.unread.is_empty() {
            return None;
        }
        let quoted: Vec<String> = self.unread.iter().map(|run| format!("“{run}”")).collect();
        let unread = excerpt(quoted.join(", "));
        Some(if self.read.is_empty() {
            format!(
                "nothing of the prompt was understood: {unread}; describe the surface in English"
            )
        } else {
            format!(
                "not understood: {unread}; only “{}” was",
                excerpt(self.read.clone())
            )
        })
    }
}

/// As much of a text as one line of a message holds.
pub(super) fn excerpt(mut text: String) -> String {
    if let Some((end, _)) = text.char_indices().nth(EXCERPT) {
        text.truncate(end);
        text.push('…');
    }
    text
}

#[derive(Clone, Copy, PartialEq)]
enum Script {
    Latin,
    Other,
    /// Punctuation and signs, which belong to any script.
    Neutral,
}

/// A word whose letters are all read as Latin ones, such as ligatures and letters that look like Latin ones; else its
/// runs.
fn parted(word: &str) -> Vec<(Script, String)> {
    let latin = in_letters(word);
    let latin = || latin.chars().filter(|c| !joins(*c)).map(of);
    if latin().all(|script| script != Script::Other)
        && latin().any(|script| script == Script::Latin)
    {
        return vec![(Script::Latin, word.to_owned())];
    }
    // No word has letters of Latin and of Greek or Cyrillic: what remains of it is none.
    let has = |letter: fn(char) -> bool| word.contains(letter);
    if has(|c| c.is_ascii_alphabetic()) && has(|c| matches!(c, '\u{370}'..='\u{52f}')) {
        return vec![(Script::Other, word.to_owned())];
    }
    runs(word)
}

/// Splits a word where its script changes. Punctuation goes with what it follows.
fn runs(word: &str) -> Vec<(Script, String)> {
    let mut runs = Vec::new();
    let (mut script, mut run) = (Script::Neutral, String::new());
    for character in word.chars() {
        let next = if joins(character) {
            Script::Neutral
        } else {
            of(character)
        };
        if next != Script::Neutral && script != Script::Neutral && next != script {
            runs.push((script, mem::take(&mut run)));
        }
        if next != Script::Neutral {
            script = next;
        }
        run.push(character);
    }
    runs.push((script, run));
    runs
}

fn of(character: char) -> Script {
    match character {
        '0'..='9' | 'A'..='Z' | 'a'..='z' => Script::Latin,
        // Signs and fractions of Latin-1, times and divided by.
        '\0'..='\u{7f}' | '\u{80}'..='\u{bf}' | '×' | '÷' => Script::Neutral,
        // Latin with accents, which the encoder takes off.
        'À'..='\u{24f}' | '\u{1e00}'..='\u{1eff}' => Script::Latin,
        // The unit of micrometres.
        'μ' => Script::Latin,
        // Dashes, quotation marks, currencies, arrows, signs of mathematics.
        '\u{2010}'..='\u{205e}' | '\u{20a0}'..='\u{20cf}' | '\u{2190}'..='\u{22ff}' => {
            Script::Neutral
        }
        _ => Script::Other,
    }
}

/// Returns true if a character only modifies or joins its neighbours: accents, joiners, variants.
fn joins(character: char) -> bool {
    matches!(
        character,
        '\u{ad}'
            | '\u{300}'..='\u{36f}'
            | '\u{61c}'
            | '\u{200b}'..='\u{200f}'
            | '\u{202a}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{fe00}'..='\u{fe0f}'
            | '\u{feff}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn divided(prompt: &str) -> (String, Vec<String>) {
        let Understood { read, unread } = understood(prompt, |word| word != "qqq");
        (read, unread)
    }

    #[test]
    fn words_are_read_and_other_scripts_are_named() {
        let cases: [(&str, &str, &[&str]); 12] = [
            ("rough, gritty stone!", "rough, gritty stone!", &[]),
            ("crème brûlée – 60 % sugar", "crème brûlée 60 sugar", &[]),
            ("rough 木材 wood", "rough wood", &["木材"]),
            ("rough木材wood🔥", "rough wood", &["木材", "🔥"]),
            (
                "ﬂeece ｖｅｌｖｅｔ vеlvet",
                "ﬂeece ｖｅｌｖｅｔ vеlvet",
                &[],
            ),
            ("rough sжndpaper", "rough", &["sжndpaper"]),
            ("½ ㎜ − 3 μm", "½ ㎜ 3 μm", &[]),
            ("wet 👩‍🚒❤️ ice", "wet ice", &["👩‍🚒❤️"]),
            ("خشب ناعم", "", &["خشب", "ناعم"]),
            ("шершавый", "", &["шершавый"]),
            ("?! …", "", &["?!", "…"]),
            ("smooth qqq", "smooth", &["qqq"]),
        ];
        for (prompt, read, unread) in cases {
            let unread = unread.iter().map(|run| (*run).to_owned()).collect();
            assert_eq!(divided(prompt), (read.to_owned(), unread), "{prompt}");
        }
    }

    #[test]
    fn a_prompt_that_shows_nothing_is_empty() {
        for prompt in ["", " \t\n", "\u{200b}\u{feff}", "\u{0}"] {
            assert!(
                matches!(check(prompt), Err(PromptError::Empty)),
                "{prompt:?}"
            );
        }
        assert!(check("?").is_ok());
    }
}
