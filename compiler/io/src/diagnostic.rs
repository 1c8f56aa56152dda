//! The common style of every failure that a user reads: the fault, then the remedy.

use crate::{
    input::{InputError, InputProblem},
    shown::{excerpt, plain},
};
use std::{
    error::Error,
    fmt::{self, Display},
    path::PathBuf,
};

/// An error that says what to do about it.
pub trait Diagnostic: Error {
    /// Returns the remedy: a step for the user, in one sentence.
    fn remedy(&self) -> String;

    /// Returns true for a usage error (exit status 2) rather than a failure (1).
    fn is_usage(&self) -> bool {
        false
    }
}

/// A fault in words, with its place and its remedy.
#[must_use]
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The file at fault, or the folder.
    pub file: Option<PathBuf>,
    /// The line or row at fault, from 1.
    pub line: Option<u64>,
    /// Path of the field at fault, e.g. `surface[1].texture`; may be empty.
    pub field: String,
    /// The fault.
    pub what: String,
    /// A step for the user, in one sentence.
    pub remedy: Box<str>,
    /// True if the command was called wrongly.
    pub usage: bool,
}

impl Fault {
    /// A fault without a place.
    pub fn new(what: impl Display, remedy: impl Into<Box<str>>) -> Self {
        Self {
            file: None,
            line: None,
            field: String::new(),
            what: what.to_string(),
            remedy: remedy.into(),
            usage: false,
        }
    }

    /// The text, the remedy and the exit status of another error.
    pub fn of(error: &dyn Diagnostic) -> Self {
        Self {
            usage: error.is_usage(),
            ..Self::new(error, error.remedy())
        }
    }

    /// Sets the file or the folder.
    pub fn at(self, file: impl Into<PathBuf>) -> Self {
        let file = Some(file.into());
        Self { file, ..self }
    }

    /// Sets the line, if it is known.
    pub fn line(self, line: impl Into<Option<u64>>) -> Self {
        let line = line.into();
        Self { line, ..self }
    }

    /// Sets the field.
    pub fn field(self, field: impl Into<String>) -> Self {
        let field = field.into();
        Self { field, ..self }
    }

    /// Puts a suggestion, if there is one, before the remedy.
    pub fn suggest(mut self, suggestion: Option<String>) -> Self {
        if let Some(suggestion) = suggestion {
            self.remedy = format!("{suggestion} {}", self.remedy).into();
        }
        self
    }

    /// Makes it a usage error.
    pub fn usage(self) -> Self {
        Self {
            usage: true,
            ..self
        }
    }
}

/// Formats `file:line: field: what`, without the parts of the place that are not known.
impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}", file.display())?;
            self.line.map_or(Ok(()), |line| write!(f, ":{line}"))?;
            f.write_str(": ")?;
        }
        if !self.field.is_empty() {
            write!(f, "{}: ", self.field)?;
        }
        f.write_str(&self.what)
    }
}

impl Error for Fault {}

impl Diagnostic for Fault {
    fn remedy(&self) -> String {
        self.remedy.to_string()
    }

    fn is_usage(&self) -> bool {
        self.usage
    }
}

impl From<InputProblem> for Fault {
    fn from(problem: InputProblem) -> Self {
        Self::new(&problem, problem.remedy())
    }
}

impl From<InputError> for Fault {
    fn from(error: InputError) -> Self {
        Self::from(error.problem).at(error.file)
    }
}

/// A failure to report to the user.
pub type Failure = Box<dyn Diagnostic + Send + Sync>;

impl<E: Diagnostic + Send + Sync + 'static> From<E> for Failure {
    fn from(error: E) -> Self {
        Box::new(error)
    }
}

/// Failures of one command; several where many files were at fault.
pub type Failures = Vec<Box<dyn Diagnostic>>;

/// For `map_err`: a failure as those of a command.
pub fn alone(failure: Failure) -> Failures {
    vec![failure]
}

/// For `map_err`: one failure.
pub fn one(error: impl Diagnostic + 'static) -> Failures {
    vec![Box::new(error)]
}

/// For `map_err`: faults as the failures of a command.
pub fn all(faults: Vec<Fault>) -> Failures {
    faults
        .into_iter()
        .map(|fault| Box::new(fault) as _)
        .collect()
}

/// The text that both commands print on stderr: `error: …`, `  help: …`. Errors repeat what files
/// and users say, so control characters are escaped and the long is shortened.
#[must_use]
pub fn report(error: &dyn Diagnostic) -> String {
    let (text, remedy) = texts(error);
    format!("error: {text}\n  help: {remedy}")
}

/// Returns the fault, with its causes, and the remedy: escaped and shortened as in [`report`].
#[must_use]
pub fn texts(error: &dyn Diagnostic) -> (String, String) {
    let mut text = error.to_string();
    let mut source = error.source();
    while let Some(cause) = source {
        text += &format!(": {cause}");
        source = cause.source();
    }
    let shown = |text: &str| excerpt(&plain(text));
    (shown(&text), shown(&error.remedy()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, thiserror::Error)]
    #[error("{0}: no such key")]
    struct Echo(String);

    impl Diagnostic for Echo {
        fn remedy(&self) -> String {
            format!("remove {}", self.0)
        }
    }

    #[test]
    fn a_fault_shows_what_is_known_of_its_place() {
        let fault = || Fault::new("no such key", "remove it");
        assert_eq!(fault().to_string(), "no such key");
        assert_eq!(fault().line(3).to_string(), "no such key");
        assert_eq!(fault().field("a.b").to_string(), "a.b: no such key");
        let placed = fault().at("x.toml").line(3).field("a.b").usage();
        assert_eq!(placed.to_string(), "x.toml:3: a.b: no such key");
        assert!(placed.is_usage() && !fault().is_usage());
        let suggested = fault().suggest(Some("did you mean \"c\"?".into()));
        assert_eq!(suggested.remedy(), "did you mean \"c\"? remove it");
    }

    #[test]
    fn what_an_error_repeats_is_escaped_and_shortened() {
        let escapes = report(&Echo("\u{1b}[31mred\u{9b}0m\u{202e}".into()));
        assert!(
            !escapes.chars().any(|c| c.is_control() && c != '\n'),
            "{escapes:?}"
        );
        assert!(
            escapes.contains("\\u{1b}[31mred\\u{9b}0m\\u{202e}: no such key"),
            "{escapes}"
        );
        let long = report(&Echo("x".repeat(1_000_000)));
        assert!(long.len() < 2000 && long.contains("…") && long.contains("no such key"));
        let lines = report(&Echo("x\n".repeat(1_000_000)));
        assert!(lines.lines().count() < 50);
    }
}
