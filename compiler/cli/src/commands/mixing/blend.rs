//! `asperity blend`.

use super::{
    input::{Input, parsed},
    output::{Mixing, failed},
};
use crate::cli::Blend;
use asperity::{
    edit::{History, Latents, Origin, Studio},
    model::FrictionLaw,
    pipeline::Request,
    preview::SIZE,
    sources::latents::FromLatents,
};
use asperity_console::Console;
use asperity_io::diagnostic::Failures;
use serde_json::json;

pub(crate) fn run(args: &Blend, console: Console) -> Result<(), Failures> {
    let (first, second) = (Input::of(&args.a), Input::of(&args.b));
    let mixing = Mixing::open(&args.mixed, &[&first, &second], console)?;
    let (a, b) = (first.read()?, second.read()?);
    let (a, b) = (parsed(&a)?, parsed(&b)?);
    let author = mixing.author()?;
    let studio = Studio::new(&author);
    let (from, at_a) = studio.source(&a).map_err(failed)?;
    let (to, at_b) = studio.source(&b).map_err(failed)?;
    let own = studio.how(&a);
    let other = studio.how(&b);
    let request = Request {
        preview_px: mixing.preview_px(own.request.preview_px.or(Some(SIZE))),
        ..own.request
    };
    let name = mixing.name(&format!("{} – {}", a.name(), b.name()));
    let history = History::of(Origin::Blend {
        a: from,
        b: to,
        t: args.t,
    });
    let latents = Latents::between(&at_a, &at_b, args.t);
    let provenance = author.model().provenance("blend");
    let source = FromLatents {
        law: FrictionLaw::between(own.law.as_ref(), other.law.as_ref(), args.t),
        ..FromLatents::new(latents, name, provenance, history)
    };
    let compiled = mixing.compile(&studio, &source, &request)?;
    let line = format!("{:?} and {:?} at t = {}", a.name(), b.name(), args.t);
    let more = json!({ "blend": { "a": a.name(), "b": b.name(), "t": args.t } });
    mixing.finish(&studio, &compiled, more, &[("between", line)])
}
