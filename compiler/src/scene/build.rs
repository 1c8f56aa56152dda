//! From a description to a library: its textures as any library has them, or, within a budget,
//! each at the fidelity that the budget allows.

use super::{
    budget::{self, Budget, Excess, Limits},
    cost::Surfaces,
    description::Description,
    fidelity::{self, Candidate},
    report::Report,
    target::Target,
};
use crate::{
    emit::pack,
    library::{self, manifest::Entry, no_room},
    passes::reduce::Fidelity,
    pipeline::{Pass, Pipeline, Timings},
    sources::prompt::PromptCompiler,
};
use asperity_formats::SceneSurface;
use asperity_io::diagnostic::{Diagnostic, Failures, Fault, one};
use rayon::prelude::*;

/// A library with its scene, and how the budget was spent.
#[derive(Debug, Clone)]
pub struct Built {
    /// The library.
    pub bytes: Vec<u8>,
    /// Use of the budget.
    pub report: Report,
    /// The time of every pass, on all threads together.
    pub timings: Timings,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// Builds a scene. The same files give the same bytes, whatever the thread count and the cache.
/// `open` gives a prompt compiler; `done` is called once a texture, from any thread.
///
/// Without a budget, the textures are those that [`library::Build`] gives. Within one, each is made
/// whole, tried at its fidelities and chosen; one whose fidelity the manifest states keeps it.
///
/// # Errors
/// What [`library::Build`] says, and [`Fault`] for a budget that cannot hold.
pub fn build(
    scene: &Description,
    budget: &Budget,
    request: &library::Request<'_>,
    open: &dyn Fn() -> Result<PromptCompiler, Failures>,
    done: &(dyn Fn() + Sync),
) -> Result<Built, Failures> {
    let target = budget.target.unwrap_or_else(Target::unlimited);
    let surfaces = Surfaces::of(scene.surfaces.iter().map(|surface| surface.solid));
    let worn = scene.worn();
    let mut manifest = scene.manifest.clone();
    if !budget.is_unlimited() {
        manifest.entries.iter_mut().for_each(whole);
    }
    let order: Vec<&Entry> = worn.iter().map(|&index| &manifest.entries[index]).collect();
    let made = library::Build::new(&manifest, request)?.only(&worn);
    let made = made.run(open, done)?;
    let mut pipeline = Pipeline::timed(request.clock);
    pipeline.merge(&made.timings);
    let assets = made.library.assets().map_err(|error| one(no_room(error)))?;
    let rows = &made.report.textures;
    let kept = assets.into_iter().zip(rows).map(|(bytes, row)| {
        let error_db = row.facts.reduced_db.unwrap_or(0.0);
        Candidate::of(bytes, error_db, &target, surfaces)
    });
    let kept: Vec<Candidate> = kept.collect::<Result<_, _>>().map_err(one)?;
    let chosen = if budget.is_unlimited() {
        kept
    } else {
        let tried: Vec<_> = (order.par_iter().zip(kept))
            .map(|(entry, kept)| {
                let mut pipeline = Pipeline::timed(request.clock);
                let tried = if entry.options.keeps_fidelity {
                    Ok(vec![kept])
                } else {
                    fidelity::candidates(&kept.texture, &target, surfaces, &mut pipeline)
                };
                (tried, pipeline)
            })
            .collect();
        let all = gathered(&order, tried, &mut pipeline)?;
        let chosen = pipeline.run(Pass::Pack, || chosen(scene, &order, &all, budget, &target));
        let chosen = chosen.map_err(one)?;
        let verified: Vec<_> = chosen
            .par_iter()
            .map(|candidate| {
                let mut pipeline = Pipeline::timed(request.clock);
                let verified = pipeline.verify(&candidate.texture, &candidate.bytes);
                (verified, pipeline)
            })
            .collect();
        gathered(&order, verified, &mut pipeline)?;
        chosen.into_iter().cloned().collect()
    };
    let bytes = pipeline
        .run(Pass::Pack, || encode(scene, &worn, &order, &chosen))
        .map_err(one)?;
    let report = Report::new(scene, budget, &target, &order, &chosen, bytes.len());
    let mut warnings = made.warnings;
    let unused = report.unused.iter();
    warnings.extend(unused.map(|name| format!("no surface wears {name:?}; it was left out")));
    Ok(Built {
        bytes,
        report,
        timings: pipeline.timings().clone(),
        warnings,
    })
}

/// Resets an entry to the start of the fidelity search: full fidelity, unless stated, and no preview.
fn whole(entry: &mut Entry) {
    let options = &mut entry.options;
    options.request.preview_px = None;
    if !options.keeps_fidelity {
        options.request.fidelity = Fidelity::Full;
    }
}

/// Collects the results of all textures, or the first error.
fn gathered<T, E: Diagnostic>(
    order: &[&Entry],
    made: Vec<(Result<T, E>, Pipeline)>,
    pipeline: &mut Pipeline,
) -> Result<Vec<T>, Failures> {
    let mut all = Vec::with_capacity(made.len());
    for (entry, (made, own)) in order.iter().zip(made) {
        pipeline.merge(own.timings());
        all.push(made.map_err(|cause| one(entry.fault(&cause)))?);
    }
    Ok(all)
}

/// The candidate that the budget allows for every texture.
fn chosen<'a>(
    scene: &Description,
    order: &[&Entry],
    all: &'a [Vec<Candidate>],
    budget: &Budget,
    target: &Target,
) -> Result<Vec<&'a Candidate>, Fault> {
    let names: Vec<&str> = order.iter().map(|entry| entry.name.as_str()).collect();
    let fixed = pack::scene_len(&names, scene.surfaces.len()) as u64;
    let limits = Limits {
        instructions: target.budget(scene.servo_rate_hz, budget.share),
        bytes: budget
            .bytes
            .map_or(u64::MAX, |bytes| bytes.saturating_sub(fixed)),
    };
    let chosen = budget::choose(all, limits).map_err(|excess| {
        let fault = match excess {
            Excess::Instructions { texture, least } => {
                let (name, most) = (&order[texture].name, limits.instructions);
                let what = format!(
                    "{name:?} takes {least} instructions per tick at its lowest fidelity, {} more than the budget of {most} ({target})",
                    least - most
                );
                let remedy = "give a faster clock, a larger --share or a lower servo_rate_hz, or remove surfaces";
                Fault::new(what, remedy)
            }
            Excess::Bytes { least } => {
                let (least, most) = (least + fixed, budget.bytes.unwrap_or(u64::MAX));
                let what = format!(
                    "the library takes {least} bytes at the lowest fidelities, {} more than the budget of {most} bytes",
                    least - most
                );
                let remedy = match order.len() {
                    1 => "raise --budget-bytes".into(),
                    textures => format!(
                        "raise --budget-bytes, or use fewer than {textures} textures: surfaces can share one"
                    ),
                };
                Fault::new(what, remedy)
            }
        };
        fault.at(&scene.manifest.file)
    })?;
    Ok(all.iter().zip(chosen).map(|(of, at)| &of[at]).collect())
}

fn encode(
    scene: &Description,
    worn: &[usize],
    order: &[&Entry],
    chosen: &[Candidate],
) -> Result<Vec<u8>, Fault> {
    let named: Vec<pack::NamedAsset<'_>> = order
        .iter()
        .zip(chosen)
        .map(|(entry, candidate)| pack::NamedAsset {
            name: &entry.name,
            bytes: &candidate.bytes,
        })
        .collect();
    let place = |texture: usize| worn.iter().position(|&index| index == texture);
    let surfaces: Vec<SceneSurface> = scene
        .surfaces
        .iter()
        .map(|surface| SceneSurface {
            solid: surface.solid,
            from_m: surface.from_m,
            to_m: surface.to_m,
            // Every surface wears one of them, and there are at most as many as surfaces.
            texture: place(surface.texture).unwrap_or(0) as u16,
        })
        .collect();
    pack::encode_scene(&named, &surfaces).map_err(|fault| fault.at(&scene.manifest.file))
}
