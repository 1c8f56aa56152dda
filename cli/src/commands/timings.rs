//! Pass timings, printed on request.

use asperity::pipeline::Pipeline;
use asperity_console::Console;

/// Prints the times on standard error, where that was asked for.
pub(super) fn print(wanted: bool, pipeline: &Pipeline, console: Console) {
    if wanted {
        console.aside(pipeline.timings());
    }
}
