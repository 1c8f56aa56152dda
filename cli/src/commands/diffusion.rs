//! Pictures by Stable Diffusion, for the commands that take `--diffusion`.

use asperity::{
    learned::inference::BackendName,
    views::diffusion::{self, Drawn, Request},
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};
use std::path::Path;

/// The picture that is asked for, `size_px` wide or as the model makes it. Progress is shown.
pub(super) fn drawn(
    folder: &Path,
    backend: BackendName,
    request: Request,
    size_px: Option<u32>,
    console: Console,
) -> Result<Drawn, Failures> {
    let activity = console.activity();
    activity.set_message(format!("loading {}", folder.display()));
    activity.enable_steady_tick(std::time::Duration::from_millis(200));
    let model = diffusion::open(folder, backend).map_err(one)?;
    activity.finish_and_clear();
    let bar = console.bar(request.steps, "diffusion");
    let drawn = model.draw(request, size_px, &mut |step| bar.set_position(step as u64));
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
