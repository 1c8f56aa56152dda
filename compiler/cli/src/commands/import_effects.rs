//! `asperity import haptic`, `ahap` and `hjif`.

use super::{outputs::TextureOutputs, timings};
use crate::cli::ImportEffects;
use asperity::{
    effects::{self, Kind, Options},
    pipeline::{Pipeline, Request},
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &ImportEffects, kind: Kind, console: Console) -> Result<(), Failures> {
    let outputs = TextureOutputs::open(std::slice::from_ref(&args.input), &args.output, None)?;
    let console = outputs.console(console);
    let options = Options {
        name: args.name.clone(),
        speed_mm_s: f64::from(args.speed),
        force_n: f64::from(args.force),
        full_scale_m_s2: f64::from(args.full_scale),
        tap_full_scale_m_s2: f64::from(args.tap_full_scale),
        tap_speed_m_s: f64::from(args.tap_speed),
        mu: f64::from(args.mu),
        request: Request {
            fidelity: args.fidelity,
            rate_hz: args.rate,
            preview_px: (!args.no_preview).then_some(args.preview_size),
        },
    };
    let (imported, warnings) = effects::import(&args.input, kind, &options).map_err(one)?;
    let mut pipeline = Pipeline::default();
    pipeline.merge(&imported.timings);
    outputs.write(&imported.bytes, &mut pipeline)?;
    console.warnings(&warnings, args.json);
    let printed = if args.json {
        let mut json = imported.json();
        json["warnings"] = warnings.into();
        console.json(&json)
    } else {
        console.report(&format!("{}\n", imported.report))
    };
    printed.map_err(one)?;
    timings::print(args.timings, &pipeline, console);
    Ok(())
}
