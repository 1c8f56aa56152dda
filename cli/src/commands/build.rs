//! `asperity build`: a manifest becomes a library, a scene what its surfaces wear.

use super::{build_scene, library};
use crate::cli::Build;
use asperity::library::BuildFile;
use asperity_console::Console;
use asperity_io::diagnostic::Failures;

pub(crate) fn run(args: &Build, console: Console) -> Result<(), Failures> {
    let build = BuildFile::read(&args.scene, args.confined)?;
    if build.is_scene {
        build_scene::run(args, build, console)
    } else {
        library::build::run(args, build, console)
    }
}
