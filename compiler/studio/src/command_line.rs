//! The command that makes the same bytes as the page.

use asperity_io::{output::FileNames, shown::shell_word};

/// The command that compiles this prompt to the bytes of a texture of this name, for a POSIX shell. `None` for a prompt
/// that no command line can hold, which ends texts at U+0000.
pub(crate) fn compile(prompt: &str, seed: u64, name: &str) -> Option<String> {
    if prompt.contains('\0') {
        return None;
    }
    let files = FileNames::of(&[name], "asp").files;
    let output = shell_word(files.first()?).into_owned();
    let seed = if seed == 0 {
        String::new()
    } else {
        format!(" --seed {seed}")
    };
    let prompt = quoted(prompt);
    Some(if prompt.starts_with("'-") {
        // What begins with a dash is no prompt unless options have ended.
        format!("asperity compile -o {output}{seed} -- {prompt}")
    } else {
        format!("asperity compile {prompt} -o {output}{seed}")
    })
}

/// A prompt in quotation marks, even if it is one word: people change it.
fn quoted(prompt: &str) -> String {
    match shell_word(prompt) {
        quoted if quoted.starts_with('\'') => quoted.into_owned(),
        plain => format!("'{plain}'"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prompt_is_one_word_of_a_shell() {
        let cases = [
            ("cork", 0, "asperity compile 'cork' -o cork.asp"),
            (
                "wet ice",
                7,
                "asperity compile 'wet ice' -o 'wet ice.asp' --seed 7",
            ),
            ("-x", 1, "asperity compile -o _-x.asp --seed 1 -- '-x'"),
            ("a'b", 0, r"asperity compile 'a'\''b' -o 'a'\''b.asp'"),
            ("$(id)", 0, "asperity compile '$(id)' -o '$(id).asp'"),
        ];
        for (prompt, seed, command) in cases {
            assert_eq!(compile(prompt, seed, prompt).as_deref(), Some(command));
        }
        assert_eq!(compile("a\0b", 0, "a b"), None);
    }
}
