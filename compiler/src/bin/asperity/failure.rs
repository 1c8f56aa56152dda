//! What a failed command has to say.

use asperity::diagnostic::Diagnostic;

/// Several where many files were at fault.
pub(crate) type Failures = Vec<Box<dyn Diagnostic>>;

/// For `map_err`: one failure.
pub(crate) fn one(error: impl Diagnostic + 'static) -> Failures {
    vec![Box::new(error)]
}
