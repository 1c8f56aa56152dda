//! Time from a prompt to verified bytes with everything loaded: text, decoding, reduction,
//! lowering and verification, without a preview.
//!
//! `cargo bench -p asperity-benches --bench prompt`. The texture is checked before it is
//! timed.

use asperity::{
    learned::inference::{Backend, BackendName},
    sources::prompt::{Options, PromptCompiler},
};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

const PROMPT: &str = "rough abrasive sheet with gritty particles";

fn warm(c: &mut Criterion) {
    let backend = Backend::open(BackendName::Portable).expect("the embedded engine");
    let prompt_compiler = PromptCompiler::embedded(&backend).expect("the embedded model");
    let options = Options::default().without_preview();
    let compiled = prompt_compiler
        .compile(PROMPT, &options)
        .expect("a texture");
    assert!(compiled.attributes().rough_db.is_some_and(|db| db > 0.0));
    assert!(compiled.lowered.bytes.len() < 4096 + 1024);
    let mut group = c.benchmark_group("warm prompt");
    group.sample_size(30);
    group.bench_function("text to verified bytes", |b| {
        b.iter(|| prompt_compiler.compile(black_box(PROMPT), &options));
    });
    group.bench_function("text to latent", |b| {
        b.iter(|| prompt_compiler.project(black_box(PROMPT)));
    });
    group.finish();
}

criterion_group!(prompt, warm);
criterion_main!(prompt);
