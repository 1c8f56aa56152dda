//! From a description to a library: makes every texture in full, tries its fidelities, and packs
//! the ones that the budget allows.

use super::{
    budget::{self, Budget, Excess, Limits},
    cost::Surfaces,
    description::{Description, Origin, TextureEntry},
    error::{SceneError, SceneProblem},
    fidelity::{self, Candidate},
    report::Report,
    target::Target,
};
use crate::{
    driver,
    emit::{
        raise::raise,
        source::{Source, SourceError, SourceProblem},
        verify,
    },
    library,
    model::TextureModel,
    pipeline::{Pass, Pipeline, PipelineError, Request, Timings},
    sources::{Tools, hatt::Hatt},
};
use asperity_formats::{Asset, SceneSurface};
use asperity_io::diagnostic::{Diagnostic, Failure};
use rayon::prelude::*;
use std::path::Path;

/// A library with its scene, and how the budget was spent.
#[derive(Debug, Clone)]
pub struct Built {
    /// The library.
    pub bytes: Vec<u8>,
    /// How the budget was spent.
    pub report: Report,
    /// The time of every pass, without those of the prompter.
    pub timings: Timings,
}

/// Makes a texture of a prompt and a seed.
pub type Prompter<'a> = dyn FnMut(&str, u64) -> Result<TextureModel, Failure> + 'a;

/// Builds a scene. The same files give the same bytes, whatever the thread count. `prompter` is
/// asked once for every prompt.
///
/// # Errors
/// [`SceneError`] for a texture that cannot be made or a budget that cannot hold.
pub fn build(
    scene: &Description,
    budget: &Budget,
    prompter: &mut Prompter<'_>,
) -> Result<Built, SceneError> {
    let target = budget.target.unwrap_or_else(Target::unlimited);
    let mut order: Vec<&TextureEntry> = scene.textures.iter().collect();
    order.sort_by(|a, b| a.name.cmp(&b.name));
    let mut pipeline = Pipeline::default();
    let wholes = order
        .iter()
        .map(|entry| whole(scene, entry, prompter, &mut pipeline))
        .collect::<Result<Vec<_>, _>>()?;
    let surfaces = Surfaces::of(scene.surfaces.iter().map(|surface| surface.solid));
    let tried: Vec<_> = wholes
        .par_iter()
        .map(|texture| {
            let mut pipeline = Pipeline::default();
            let tried = fidelity::candidates(texture, &target, surfaces, &mut pipeline);
            (tried, pipeline)
        })
        .collect();
    let mut all = Vec::with_capacity(tried.len());
    for (entry, (tried, own)) in order.iter().zip(tried) {
        pipeline.merge(own.timings());
        all.push(tried.map_err(|e| failed(scene, entry, e))?);
    }
    let chosen = pipeline.run(Pass::Pack, || chosen(scene, &order, &all, budget, &target))?;
    let verified: Vec<_> = chosen
        .par_iter()
        .map(|candidate| {
            let mut pipeline = Pipeline::default();
            let verified = pipeline.verify(&candidate.texture, &candidate.bytes);
            (verified, pipeline)
        })
        .collect();
    for (entry, (verified, own)) in order.iter().zip(verified) {
        pipeline.merge(own.timings());
        verified.map_err(|e| failed(scene, entry, e))?;
    }
    let bytes = pipeline.run(Pass::Pack, || encode(scene, &order, &chosen))?;
    let report = Report::new(scene, budget, &target, &order, &chosen, bytes.len());
    Ok(Built {
        bytes,
        report,
        timings: pipeline.timings().clone(),
    })
}

fn failed(
    scene: &Description,
    entry: &TextureEntry,
    cause: impl Diagnostic + Send + Sync + 'static,
) -> SceneError {
    at(scene, entry, SceneProblem::Texture(Box::new(cause)))
}

fn at(scene: &Description, entry: &TextureEntry, problem: SceneProblem) -> SceneError {
    let key = match &entry.origin {
        Origin::Prompt(..) => "prompt",
        Origin::Import(_) => "import",
        Origin::Asset(_) => "asset",
    };
    SceneError {
        file: scene.file.clone(),
        field: format!("texture[{}].{key}", entry.index),
        problem,
    }
}

/// Whether models at `model_hz` keep their own rate in a servo loop at `servo_hz`.
fn is_multiple(servo_hz: f64, model_hz: f64) -> bool {
    asperity_runtime::ticks_per_sample(model_hz as f32, servo_hz as f32).is_some()
}

/// A texture in full and under its name in the scene. It keeps its own rate where the scene's servo
/// loop runs at a multiple of it, and is converted to the loop's rate elsewhere.
fn whole(
    scene: &Description,
    entry: &TextureEntry,
    prompter: &mut Prompter<'_>,
    pipeline: &mut Pipeline,
) -> Result<TextureModel, SceneError> {
    let made = match &entry.origin {
        Origin::Prompt(prompt, seed) => prompter(prompt, *seed).map_err(SceneProblem::Texture),
        Origin::Import(file) => imported(file, pipeline).map_err(SceneProblem::Texture),
        Origin::Asset(file) => pipeline.run(Pass::Read, || asset(file)),
    };
    let mut texture = made.map_err(|problem| at(scene, entry, problem))?;
    let (from_hz, to_hz) = (texture.grid.sample_rate_hz, scene.servo_rate_hz);
    if !is_multiple(to_hz, from_hz) {
        let problem = |_: PipelineError| SceneProblem::Rate { from_hz, to_hz };
        texture = pipeline
            .rerate(texture, to_hz)
            .map_err(|e| at(scene, entry, problem(e)))?;
    }
    texture.name.clone_from(&entry.name);
    Ok(texture)
}

fn imported(file: &Path, pipeline: &mut Pipeline) -> Result<TextureModel, Failure> {
    let imported = driver::compile(&Hatt::new(file), &Request::default(), &Tools::default())?;
    pipeline.merge(&imported.timings);
    // The import verified the bytes, so they parse.
    let asset = Asset::parse(&imported.lowered.bytes).map_err(verify::VerifyError::from)?;
    Ok(raise(&asset))
}

fn asset(file: &Path) -> Result<TextureModel, SceneProblem> {
    let fail = |error: SourceError| match error.problem {
        SourceProblem::NoneChosen { count } => SceneProblem::ManyTextures {
            file: error.path,
            count,
        },
        _ => SceneProblem::Texture(Box::new(error)),
    };
    let mut source = Source::open(file).map_err(fail)?;
    let bytes = source.choose(None).map_err(fail)?;
    let asset = Asset::parse(&bytes).map_err(|e| fail(source.error(None, e.into())))?;
    Ok(raise(&asset))
}

/// The candidate that the budget allows for every texture.
fn chosen<'a>(
    scene: &Description,
    order: &[&TextureEntry],
    all: &'a [Vec<Candidate>],
    budget: &Budget,
    target: &Target,
) -> Result<Vec<&'a Candidate>, SceneError> {
    let names: Vec<&str> = order.iter().map(|entry| entry.name.as_str()).collect();
    let fixed = library::scene_len(&names, scene.surfaces.len()) as u64;
    let limits = Limits {
        instructions: target.budget(scene.servo_rate_hz, budget.share),
        bytes: budget
            .bytes
            .map_or(u64::MAX, |bytes| bytes.saturating_sub(fixed)),
    };
    let chosen = budget::choose(all, limits).map_err(|excess| match excess {
        Excess::Instructions { texture, least } => {
            let entry = order[texture];
            let problem = SceneProblem::Instructions {
                name: entry.name.clone(),
                least,
                budget: limits.instructions,
                target: *target,
            };
            SceneError {
                file: scene.file.clone(),
                field: format!("texture[{}]", entry.index),
                problem,
            }
        }
        Excess::Bytes { least } => SceneError {
            file: scene.file.clone(),
            field: String::new(),
            problem: SceneProblem::Bytes {
                least: least + fixed,
                budget: budget.bytes.unwrap_or(u64::MAX),
                textures: order.len(),
            },
        },
    })?;
    Ok(all.iter().zip(chosen).map(|(of, at)| &of[at]).collect())
}

fn encode(
    scene: &Description,
    order: &[&TextureEntry],
    chosen: &[&Candidate],
) -> Result<Vec<u8>, SceneError> {
    let named: Vec<library::NamedAsset<'_>> = order
        .iter()
        .zip(chosen)
        .map(|(entry, candidate)| library::NamedAsset {
            name: &entry.name,
            bytes: &candidate.bytes,
        })
        .collect();
    let index = |name: &str| order.iter().position(|entry| entry.name == name);
    let surfaces: Vec<SceneSurface> = scene
        .surfaces
        .iter()
        .map(|surface| SceneSurface {
            solid: surface.solid,
            from_m: surface.from_m,
            to_m: surface.to_m,
            // The name was checked on reading, and there are at most as many textures as surfaces.
            texture: index(&surface.texture).unwrap_or(0) as u16,
        })
        .collect();
    library::encode_scene(&named, &surfaces).map_err(|e| SceneError {
        file: scene.file.clone(),
        field: String::new(),
        problem: e.into(),
    })
}
