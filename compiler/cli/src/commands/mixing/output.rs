//! Writing and reporting a mixed texture.

use super::input::Input;
use crate::{
    cli::Mixed,
    commands::{
        inference,
        one_texture::{Job, Wanted},
    },
};
use asperity::{
    attributes::Attributes,
    driver::Compiled,
    edit::{AXES, Axis, LatentEditor, Scale, attributes_line},
    pipeline::Request,
    preview::SIZE,
    prompt::PromptCompiler,
    sources::{Tools, latents::FromLatents},
};
use asperity_console::Console;
use asperity_formats::{Asset, limits::MAX_NAME_BYTES};
use asperity_io::{diagnostic::Failures, output::display, shown::size};
use serde_json::{Map, Value, json};

/// The output of a mixing command, opened before its work.
pub(super) struct Mixing<'a> {
    args: &'a Mixed,
    job: Job<'a>,
}

impl<'a> Mixing<'a> {
    /// Opens the output of a command that reads these textures.
    pub(super) fn open(
        args: &'a Mixed,
        inputs: &[&Input],
        console: Console,
    ) -> Result<Self, Failures> {
        let mut files: Vec<_> = inputs.iter().map(|input| input.path()).collect();
        files.extend(inference::files(&args.inference));
        let wanted = Wanted {
            json: args.reporting.json,
            timings: args.reporting.timings,
            ..Wanted::of(&args.output)
        };
        let job = Job::open(wanted, &files, console)?;
        Ok(Self { args, job })
    }

    /// The prompt compiler.
    pub(super) fn prompt_compiler(&self) -> Result<PromptCompiler, Failures> {
        inference::prompt_compiler(&self.args.inference)
    }

    /// The name that a user gave, or else this one, shortened to what an asset can hold.
    pub(super) fn name(&self, otherwise: &str) -> String {
        let name = self.args.name.as_deref().unwrap_or(otherwise);
        let mut end = name.len().min(MAX_NAME_BYTES);
        while !name.is_char_boundary(end) {
            end -= 1;
        }
        name[..end].trim_end().to_owned()
    }

    /// The size of the preview, where the texture that is kept has this one; none if it is unwanted.
    pub(super) fn preview_px(&self, own: Option<u32>) -> Option<u32> {
        self.args.preview.px(own)
    }

    /// As the texture was compiled that is kept, with a preview unless it is unwanted.
    pub(super) fn request(&self, editor: &LatentEditor<'_>, kept: &Asset<'_>) -> Request {
        let request = editor.request(kept);
        Request {
            preview_px: self.preview_px(request.preview_px.or(Some(SIZE))),
            ..request
        }
    }

    /// Compiles what was mixed.
    pub(super) fn compile(
        &self,
        editor: &LatentEditor<'_>,
        source: &FromLatents,
        request: &Request,
    ) -> Result<Compiled, Failures> {
        self.job
            .compile(source, request, &Tools::of(editor.prompt_compiler()))
    }

    /// Writes the asset, and prints what it is. `more` goes into the JSON, `lines` into the text.
    pub(super) fn finish(
        self,
        editor: &LatentEditor<'_>,
        compiled: &Compiled,
        more: Value,
        lines: &[(&str, String)],
    ) -> Result<(), Failures> {
        let (haptic, total) = (compiled.lowered.haptic_bytes, compiled.lowered.bytes.len());
        let attributes = compiled.attributes();
        let mut json = json!({
            "name": compiled.texture.name,
            "attributes": attributes,
            "sliders": sliders(editor.scale(), &attributes),
            "gains": compiled.texture.gains,
            "bytes": { "haptic": haptic, "total": total },
            "stages_ms": compiled.timings.json(),
            "warnings": compiled.warnings,
        });
        if let (Value::Object(json), Value::Object(more)) = (&mut json, more) {
            json.extend(more);
        }
        let mut text = format!("{}\n", display(&self.args.output));
        let own = [
            ("sliders", attributes_line(&attributes, editor.scale())),
            (
                "size",
                format!(
                    "{} haptic, {} in total",
                    size(haptic as u64),
                    size(total as u64)
                ),
            ),
        ];
        for (what, value) in lines.iter().chain(&own) {
            text += &format!("  {what:<12} {value}\n");
        }
        self.job.finish(compiled, json, &text, "")
    }
}

/// Where a texture lies on the sliders.
fn sliders(scale: &Scale, attributes: &Attributes) -> Map<String, Value> {
    let place = |axis: Axis| {
        let place = scale.place(axis, attributes);
        (axis.name().to_owned(), json!(place))
    };
    AXES.into_iter().map(place).collect()
}
