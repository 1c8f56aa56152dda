//! The files of the page, embedded. A request names one of this table or gets none.

/// A file of the page.
pub(crate) struct File {
    /// Its name in the address, relative to the page.
    pub(crate) name: &'static str,
    /// Its type.
    pub(crate) content_type: &'static str,
    /// Its bytes.
    pub(crate) bytes: &'static [u8],
}

macro_rules! files {
    ($folder:literal $($content_type:literal: $($name:literal)*;)*) => {
        &[$($(File {
            name: $name,
            content_type: $content_type,
            bytes: include_bytes!(concat!("../", $folder, $name)),
        },)*)*]
    };
}

/// Every file of `page/`.
pub(crate) const FILES: &[File] = files! {
    "page/"
    "text/html; charset=utf-8": "index.html";
    "text/css; charset=utf-8": "studio.css" "device/device.css" "files/files.css" "gallery/gallery.css" "output/output.css" "plots/plots.css"
        "steer/steer.css";
    "text/javascript; charset=utf-8":
        "auto.js" "begin.js" "devices.js" "dom.js" "drawers.js" "events.js" "force.js" "hand-panel.js" "hand.js" "keys.js" "limiter.js"
        "links.js" "lit.js" "loader.js" "path.js" "pointer.js" "project.js" "prompt-history.js" "prompt.js" "reading.js" "readout.js" "recorder.js"
        "server.js" "sound-panel.js" "sound.js" "studio.js" "suggest.js" "surface.js" "texts.js" "texture-panels.js"
        "view.js" "worklet.js"
        "device/feed.js" "device/jitter.js" "device/panel.js"
        "files/batch.js" "files/in.js" "files/map.js" "files/out.js"
        "gallery/attributes.js" "gallery/chosen.js" "gallery/compare.js" "gallery/filters.js" "gallery/gallery.js" "gallery/grid.js"
        "gallery/library.js" "gallery/scatter.js" "gallery/span.js" "gallery/thumbnails.js" "gallery/views.js"
        "library/own.js" "library/panel.js"
        "offline/module.js" "offline/offline.js" "offline/worker.js"
        "output/chain.js" "output/context.js" "output/equaliser-panel.js" "output/equaliser.js" "output/loudness.js" "output/modes.js" "output/motors.js"
        "output/panel.js" "output/renderer.js" "output/response.js" "output/shift.js" "output/tones.js"
        "plots/axes.js" "plots/controls.js" "plots/csv.js" "plots/fft.js" "plots/field.js"
        "plots/figure.js" "plots/force.js" "plots/friction.js" "plots/models.js" "plots/plane-pointer.js"
        "plots/plane.js" "plots/plots.js" "plots/ring.js" "plots/scale.js" "plots/scope.js"
        "plots/spectrum.js" "plots/stage.js" "plots/strip.js" "plots/texts.js" "plots/waveform.js"
        "steer/axis.js" "steer/choice.js" "steer/compare.js" "steer/feel.js" "steer/live.js" "steer/mix.js"
        "steer/session.js" "steer/slots.js" "steer/steer.js" "steer/timeline.js" "steer/words.js"
        "texts/files.js" "texts/gallery.js" "texts/number.js" "texts/sound.js" "texts/steer.js";
    "application/wasm": "asperity.wasm";
    "image/svg+xml": "icon.svg";
};

/// Every file of a study's page, below `study/`.
const STUDY_FILES: &[File] = files! {
    "study/"
    "text/html; charset=utf-8": "index.html";
    "text/css; charset=utf-8": "study.css";
    "text/javascript; charset=utf-8":
        "exploration.js" "fields.js" "log.js" "page.js" "prompt.js" "server.js" "steps.js" "study.js" "texts.js" "touch.js"
        "trial.js" "withdrawal.js";
};

/// The page itself.
pub(crate) const INDEX: &str = "index.html";

/// The file of this name; the empty name is the page itself.
pub(crate) fn file(name: &str) -> Option<&'static File> {
    let name = if name.is_empty() { INDEX } else { name };
    FILES.iter().find(|file| file.name == name)
}

/// The file of a study's page: its own below `study/`, those of the studio below `page/` and, for worklets, as in the studio.
pub(crate) fn study_file(name: &str) -> Option<&'static File> {
    let own = |name: &str| STUDY_FILES.iter().find(|file| file.name == name);
    if name.is_empty() {
        return own(INDEX);
    }
    if let Some(name) = name.strip_prefix("study/") {
        return own(name);
    }
    let name = name.strip_prefix("page/").unwrap_or(name);
    file(name).filter(|file| file.name != INDEX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// Every file below a folder, named from there.
    fn files_below(folder: &Path, name: &str, found: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let entry = entry.unwrap();
            let name = format!("{name}{}", entry.file_name().to_str().unwrap());
            if entry.file_type().unwrap().is_dir() {
                files_below(&entry.path(), &format!("{name}/"), found);
            } else {
                found.push(name);
            }
        }
    }

    #[test]
    fn the_table_holds_every_file_of_the_folder() {
        let mut found = Vec::new();
        let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("page");
        files_below(&page, "", &mut found);
        found.sort();
        let mut listed: Vec<&str> = FILES.iter().map(|file| file.name).collect();
        listed.sort_unstable();
        assert_eq!(found, listed, "FILES in src/page.rs must list page/");
    }
}
