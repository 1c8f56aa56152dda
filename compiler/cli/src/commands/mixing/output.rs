//! Writing and reporting a mixed texture.

use super::input::Input;
use crate::{
    cli::Mixed,
    commands::{inference, outputs::TextureOutputs, timings},
};
use asperity::{
    edit::{AXES, Axis, EditError, Made, Scale, Studio, attributes_line},
    library,
    pipeline::Pipeline,
    prompt::Author,
};
use asperity_console::Console;
use asperity_formats::limits::MAX_NAME_BYTES;
use asperity_io::{diagnostic::Failures, diagnostic::one, output::display};
use serde_json::{Map, Value, json};

/// The output of a mixing command, opened before its work.
pub(super) struct Mixing<'a> {
    args: &'a Mixed,
    outputs: TextureOutputs,
    console: Console,
}

impl<'a> Mixing<'a> {
    /// Opens the output of a command that reads these textures.
    pub(super) fn open(
        args: &'a Mixed,
        inputs: &[&Input],
        console: Console,
    ) -> Result<Self, Failures> {
        if let Some(name) = &args.name
            && (name.is_empty()
                || name.len() > MAX_NAME_BYTES
                || name.chars().any(char::is_control))
        {
            return Err(one(library::LibraryFault::Name(name.clone())));
        }
        let mut files: Vec<_> = inputs.iter().map(|input| input.path()).collect();
        files.extend(inference::files(&args.inference));
        let outputs = TextureOutputs::open(&files, &args.output, None)?;
        let console = outputs.console(console);
        Ok(Self {
            args,
            outputs,
            console,
        })
    }

    /// The author, and the CRC-32 of its model.
    pub(super) fn author(&self) -> Result<(Author, u32), Failures> {
        let author = inference::author(&self.args.inference)?;
        let crc32 = author.model().crc32();
        Ok((author, crc32))
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
        let size = self.args.preview_size.or(own);
        size.filter(|_| !self.args.no_preview)
    }

    /// Writes the asset, and prints what it is. `more` goes into the JSON, `lines` into the text.
    pub(super) fn finish(
        self,
        studio: &Studio<'_>,
        made: &Made,
        more: Value,
        lines: &[(&str, String)],
        warnings: &[String],
    ) -> Result<(), Failures> {
        let mut pipeline = Pipeline::default();
        pipeline.merge(&made.timings);
        self.outputs.write(&made.bytes, &mut pipeline)?;
        self.console.warnings(warnings, self.args.json);
        let printed = if self.args.json {
            let mut json = json!({
                "name": made.texture.name,
                "attributes": made.attributes,
                "sliders": sliders(studio.scale(), made),
                "gains": made.texture.gains,
                "bytes": { "haptic": made.haptic_bytes, "total": made.bytes.len() },
                "stages_ms": pipeline.timings().json(),
                "warnings": warnings,
            });
            if let (Value::Object(json), Value::Object(more)) = (&mut json, more) {
                json.extend(more);
            }
            self.console.json(&json)
        } else {
            let mut text = format!("{}\n", display(&self.args.output));
            let attributes = attributes_line(&made.attributes, studio.scale());
            let bytes = format!("{} haptic, {} in all", made.haptic_bytes, made.bytes.len());
            let own = [("attributes", attributes), ("bytes", bytes)];
            for (what, value) in lines.iter().chain(&own) {
                text += &format!("  {what:<12} {value}\n");
            }
            self.console.report(&text)
        };
        printed.map_err(one)?;
        timings::print(self.args.timings, &pipeline, self.console);
        Ok(())
    }
}

/// Where a texture lies on the sliders.
fn sliders(scale: &Scale, made: &Made) -> Map<String, Value> {
    let place = |axis: Axis| {
        let place = scale.place(axis, &made.attributes);
        (axis.name().to_owned(), json!(place))
    };
    AXES.into_iter().map(place).collect()
}

/// For `map_err`: a failed edit.
pub(super) fn failed(error: EditError) -> Failures {
    one(error)
}
