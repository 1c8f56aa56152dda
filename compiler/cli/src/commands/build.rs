//! `asperity build`: a manifest becomes a library, a scene what its surfaces wear.

use super::{build_scene, library};
use crate::cli::Build;
use asperity::library::manifest;
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    input::{self, InputError, Kind, Reach},
};

pub(crate) fn run(args: &Build, console: Console) -> Result<(), Failures> {
    let extension = args.scene.extension().unwrap_or_default();
    let has_rows = ["csv", "jsonl", "ndjson"]
        .iter()
        .any(|e| extension.eq_ignore_ascii_case(e));
    let kind = if has_rows {
        Kind::Manifest
    } else {
        Kind::Scene
    };
    let text = input::read_text(&args.scene, kind).map_err(|problem| {
        one(InputError {
            file: args.scene.clone(),
            problem,
        })
    })?;
    let reach = if args.confined {
        Reach::beside(&args.scene).map_err(|error| {
            one(InputError {
                file: args.scene.clone(),
                problem: error.into(),
            })
        })?
    } else {
        Reach::Anywhere
    };
    if !has_rows && manifest::is_scene(&text) {
        build_scene::run(args, &text, reach, console)
    } else {
        library::build::run(args, &text, reach, console)
    }
}
