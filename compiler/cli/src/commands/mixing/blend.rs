//! `asperity blend`.

use super::{input::Input, output::Mixing};
use crate::cli::Blend;
use asperity::{edit::LatentEditor, sources::latents::FromLatents};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};
use serde_json::json;

pub(crate) fn run(args: &Blend, console: Console) -> Result<(), Failures> {
    let (first, second) = (Input::of(&args.a), Input::of(&args.b));
    let mixing = Mixing::open(&args.mixed, &[&first, &second], console)?;
    let (a, b) = (first.read()?, second.read()?);
    let (a, b) = (a.asset()?, b.asset()?);
    let prompt_compiler = mixing.prompt_compiler()?;
    let editor = LatentEditor::new(&prompt_compiler);
    let (from, to) = (
        editor.remembered(&a).map_err(one)?,
        editor.remembered(&b).map_err(one)?,
    );
    let mut source = FromLatents::between(
        &from,
        &to,
        args.t,
        prompt_compiler.model().provenance("blend"),
    );
    source.name = mixing.name(&format!("{} – {}", from.name, to.name));
    let compiled = mixing.compile(&editor, &source, &mixing.request(&editor, &a))?;
    let line = format!("{:?} and {:?} at t = {}", from.name, to.name, args.t);
    let more = json!({ "blend": { "a": from.name, "b": to.name, "t": args.t } });
    mixing.finish(&editor, &compiled, more, &[("between", line)])
}
