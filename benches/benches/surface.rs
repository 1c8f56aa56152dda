//! Materials a second from maps of 1024 × 1024 heights to verified bytes, previews included, on every core.
//!
//! `cargo bench -p asperity-benches --bench surface`. The textures are checked before they are timed.

use asperity::{
    driver,
    learned::inference::{Backend, BackendName},
    passes::reduce::Fidelity,
    pipeline::Request,
    sources::{
        Tools,
        prompt::PromptCompiler,
        surface::{Options, Size, Surface, Tip},
    },
    views::preview,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::{fs, path::Path};

const MATERIALS: u64 = 16;
const SIDE: usize = 1024;

/// A grey PNG of 16 bits: waves of many lengths and directions, which a seed turns.
fn map(file: &Path, seed: u64) {
    let part = |n: usize| {
        let (x, y) = ((n % SIDE) as f64, (n / SIDE) as f64);
        let waves = (1..12).map(|wave| {
            let k = 0.02 * f64::from(wave).powf(1.7);
            let angle = seed as f64 + 2.4 * f64::from(wave);
            ((x * angle.cos() + y * angle.sin()) * k).sin() / f64::from(wave)
        });
        ((0.5 + 0.15 * waves.sum::<f64>()).clamp(0.0, 1.0) * 65535.0) as u16
    };
    let heights: Vec<u8> = (0..SIDE * SIDE)
        .flat_map(|n| part(n).to_be_bytes())
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIDE as u32, SIDE as u32);
    encoder.set_depth(png::BitDepth::Sixteen);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&heights).expect("pixels");
    writer.finish().expect("an end");
    fs::write(file, bytes).expect("a file");
}

fn materials(c: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a folder");
    let surfaces: Vec<Surface> = (0..MATERIALS)
        .map(|seed| {
            let path = folder.path().join(format!("{seed}.png"));
            map(&path, seed);
            Surface {
                path,
                options: Options {
                    size: Size {
                        width_mm: Some(100.0),
                        depth_mm: Some(0.1),
                    },
                    like: None,
                    tip: Tip::STYLUS,
                    convention: None,
                },
            }
        })
        .collect();
    let backend = Backend::open(BackendName::Portable).expect("the embedded engine");
    let prompt_compiler = PromptCompiler::embedded(&backend).expect("the embedded model");
    let tools = Tools::of(&prompt_compiler);
    let request = Request {
        fidelity: Fidelity::Auto,
        preview_px: Some(preview::SIZE),
        ..Request::default()
    };
    let compile = || driver::compile_all(&surfaces, &request, &tools, || ());
    for compiled in compile() {
        let compiled = compiled.expect("a texture");
        assert!(compiled.attributes().rough_db.is_some_and(|db| db > -40.0));
    }
    let mut group = c.benchmark_group("surfaces");
    group.sample_size(10);
    group.throughput(Throughput::Elements(MATERIALS));
    group.bench_function("16 maps of 1024 × 1024", |b| b.iter(compile));
    group.finish();
}

criterion_group!(surface, materials);
criterion_main!(surface);
