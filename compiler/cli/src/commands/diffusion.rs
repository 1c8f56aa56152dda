//! Pictures by Stable Diffusion, for the commands that take `--diffusion`.

use crate::cli::Diffusion;
use asperity::views::diffusion::{self, Drawn};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};
use std::path::{Path, PathBuf};

/// The files of the folder that the options name, which no output may replace.
pub(super) fn files(options: &Diffusion) -> Vec<PathBuf> {
    options
        .diffusion
        .as_deref()
        .map_or_else(Vec::new, diffusion::files)
}

/// The picture of a prompt, `size_px` wide or as the model makes it. Progress is shown.
pub(super) fn drawn(
    folder: &Path,
    options: &Diffusion,
    prompt: String,
    seed: u64,
    size_px: Option<u32>,
    console: Console,
) -> Result<Drawn, Failures> {
    let activity = console.activity();
    activity.set_message(format!("loading {}", folder.display()));
    activity.enable_steady_tick(std::time::Duration::from_millis(200));
    let model = diffusion::open(folder, options.diffusion_backend).map_err(one)?;
    activity.finish_and_clear();
    let bar = console.bar(options.steps.into(), "diffusion");
    let wanted = options.options(prompt, seed);
    let drawn = model.draw(&wanted, size_px, &mut |step| bar.set_position(step as u64));
    bar.finish_and_clear();
    let drawn = drawn.map_err(one)?;
    if drawn.cut > 0 {
        console.warn(&format!(
            "the last {} tokens of the prompt did not fit: the text encoder reads 75",
            drawn.cut
        ));
    }
    Ok(drawn)
}
