//! `asperity plot`.

use super::{Failures, one};
use crate::cli::Plot;
use asperity::source::Source;

pub(crate) fn run(args: &Plot) -> Result<(), Failures> {
    let mut source = Source::open(&args.file).map_err(one)?;
    let _ = source.choose(args.texture.as_deref()).map_err(one)?;
    Ok(())
}
