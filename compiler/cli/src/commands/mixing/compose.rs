//! `asperity compose`.

use super::{
    input::{Input, parsed},
    output::{Mixing, failed},
};
use crate::cli::Compose;
use asperity::{
    edit::{History, Latents, Origin, Studio},
    pipeline::Request,
    preview::SIZE,
    raise::law,
    sources::latents::FromLatents,
};
use asperity_console::Console;
use asperity_io::diagnostic::Failures;
use serde_json::json;

pub(crate) fn run(args: &Compose, console: Console) -> Result<(), Failures> {
    let friction = args.friction.as_ref().unwrap_or(&args.slide);
    let files = [&args.tap, &args.slide, friction].map(|file| Input::of(file));
    let [tap, slide, friction] = &files;
    let mixing = Mixing::open(&args.mixed, &[tap, slide, friction], console)?;
    let (tap, slide, friction) = (tap.read()?, slide.read()?, friction.read()?);
    let (tap, slide, friction) = (parsed(&tap)?, parsed(&slide)?, parsed(&friction)?);
    let author = mixing.author()?;
    let studio = Studio::new(&author);
    let (of_tap, at_tap) = studio.source(&tap).map_err(failed)?;
    let (of_slide, at_slide) = studio.source(&slide).map_err(failed)?;
    let (of_friction, at_friction) = studio.source(&friction).map_err(failed)?;
    let own = studio.how(&slide);
    let request = Request {
        preview_px: mixing.preview_px(own.request.preview_px.or(Some(SIZE))),
        ..own.request
    };
    let name = mixing.name(&format!("{} tapped, {} slid", tap.name(), slide.name()));
    let latents = Latents::composed(&at_tap, &at_slide, &at_friction);
    let history = History::of(Origin::Compose {
        tap: of_tap,
        slide: of_slide,
        friction: of_friction,
    });
    let provenance = author.model().provenance("compose");
    let source = FromLatents {
        law: law(&friction),
        ..FromLatents::new(latents, name, provenance, history)
    };
    let compiled = mixing.compile(&studio, &source, &request)?;
    let names = [tap.name(), slide.name(), friction.name()];
    let line = format!(
        "taps of {:?}, slides of {:?}, friction of {:?}",
        names[0], names[1], names[2]
    );
    let more = json!({ "compose": { "tap": names[0], "slide": names[1], "friction": names[2] } });
    mixing.finish(&studio, &compiled, more, &[("parts", line)])
}
