//! Several surfaces, one library: a desk of two materials, and a stroke across the border.
//!
//! `asperity build` does the first half on the command line. The scene packs every texture
//! once, as faithfully as a budget allows; the runtime renders the surface that is touched.

use asperity::{
    diagnostic::{Failures, one, report},
    learned::inference::Backend,
    library::Request,
    scene::{Budget, Description, build},
    sources::prompt::PromptCompiler,
};
use asperity_formats::Library;
use asperity_runtime::{Config, HostScene, HostTexture, Renderer, Sample, SceneState};
use std::{error::Error, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let bytes = library()?;
    let library = Library::parse(&bytes)?;

    // One slot a texture, in memory of the caller's, and a scene over them.
    let config = Config::default();
    let renderer = Renderer::new(&config)?;
    let mut slots = vec![HostTexture::new(); library.index().len()];
    let scene = HostScene::load(&library, &config, &mut slots)?;
    let surfaces = library.scene().ok_or("the library holds no scene")?;
    let names: Vec<&str> = surfaces
        .surfaces()
        .filter_map(|surface| library.index().entries().nth(surface.texture.into()))
        .map(|entry| entry.name)
        .collect();

    // A surface in contact keeps it 0.12 mm beyond its border, so that noise there changes
    // nothing. Wall and friction then follow in 5 ms, the vibration in a few ticks.
    let mut state = SceneState::new(1);
    let mut before = None;
    println!("\n{:>5} {:>8}  touches", "ms", "x mm");
    for (tick, sample) in stroke().iter().enumerate() {
        renderer.tick_scene(&scene, &mut state, sample);
        let touched = state.touched();
        if touched != before {
            let what = touched.and_then(|index| names.get(index)).unwrap_or(&"-");
            println!("{tick:>5} {:>8.2}  {what}", 1e3 * sample.position_m[0]);
            before = touched;
        }
    }
    Ok(())
}

/// Builds `desk.toml` within 7 kB and 6 % of a Cortex-M4F at 48 MHz.
fn library() -> Result<Vec<u8>, Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("desk.toml");
    let budget = Budget {
        target: Some("cortex-m4f@48MHz".parse()?),
        share: 0.06,
        bytes: Some(7000),
    };
    let told = |failures: Failures| {
        let told = failures.iter().map(|failure| report(&**failure));
        told.collect::<Vec<_>>().join("\n")
    };
    let scene = Description::read(&file).map_err(told)?;
    // Without a cache, and loaded only if a texture needs it.
    let prompt_compiler = || PromptCompiler::embedded(&Backend::Portable).map_err(one);
    let built = build(
        &scene,
        &budget,
        &Request::default(),
        &prompt_compiler,
        &|| (),
    )
    .map_err(told)?;
    print!("{}", built.report);
    Ok(built.bytes)
}

/// Down at x = −20 mm, across to +20 mm at 100 mm/s, up again.
fn stroke() -> Vec<Sample> {
    let height = |n: i32| 2.0e-3 - 4.0e-5 * n as f32;
    let down = (0..100).map(|n| [-0.02, 0.0, height(n)]);
    let across = (0..400).map(|n| [-0.02 + 1.0e-4 * n as f32, 0.0, height(99)]);
    let up = (0..100).map(|n| [0.02, 0.0, height(99 - n)]);
    down.chain(across).chain(up).map(Sample::at).collect()
}
