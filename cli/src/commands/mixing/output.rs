//! Writing and reporting a mixed texture.

use crate::{
    cli::Mixed,
    commands::{
        input::Input,
        one_texture::{Job, RequestedOutputs},
    },
};
use asperity::sources::{
    Tools,
    latents::{LatentEditor, Mix, MixOptions, MixPreview},
    prompt::PromptCompiler,
};
use asperity_console::Console;
use asperity_io::{diagnostic::Failures, output::display, shown::size};

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
        let mut files: Vec<_> = inputs.iter().map(|input| input.file.clone()).collect();
        files.extend(args.inference.setup().files());
        let requested = RequestedOutputs::of(&args.output, args.reporting);
        let job = Job::open(requested, &files, console)?;
        Ok(Self { args, job })
    }

    /// The prompt compiler.
    pub(super) fn prompt_compiler(&self) -> Result<PromptCompiler, Failures> {
        self.args.inference.setup().prompt_compiler()
    }

    /// Returns the requested mix options.
    pub(super) fn options(&self) -> MixOptions {
        let preview = &self.args.preview;
        MixOptions {
            name: self.args.name.clone(),
            preview: match preview.preview_size {
                _ if preview.no_preview => MixPreview::None,
                Some(px) => MixPreview::Size(px),
                None => MixPreview::Kept,
            },
        }
    }

    /// Compiles what was mixed, writes the asset, and prints what it is.
    pub(super) fn finish(self, editor: &LatentEditor<'_>, mix: Mix) -> Result<(), Failures> {
        let tools = Tools::of(editor.prompt_compiler());
        let mut compiled = self.job.compile(&mix.source, &mix.request, &tools)?;
        let report = mix.report(editor, &compiled);
        compiled.warnings.extend(report.warnings);
        let (haptic, total) = (compiled.lowered.haptic_bytes, compiled.lowered.bytes.len());
        let sizes = format!(
            "{} haptic, {} in total",
            size(haptic as u64),
            size(total as u64)
        );
        let mut text = format!("{}\n", display(&self.args.output));
        for (what, value) in report.lines.iter().chain(&[("size", sizes)]) {
            text += &format!("  {what:<12} {value}\n");
        }
        self.job.finish(&compiled, report.json, &text, "")
    }
}
