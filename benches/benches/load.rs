//! Nanoseconds of loading a texture, and of checking the index of a library.
//!
//! `cargo bench -p asperity-benches --bench load`. Results are checked before they are timed;
//! `instructions` counts the same work.

use asperity_benches::load::{Loading, Work};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn load(c: &mut Criterion) {
    let mut loading = Loading::new();
    loading.check();
    for (work, label) in Work::ALL {
        c.bench_function(label, |b| b.iter(|| loading.once(black_box(work))));
    }
}

criterion_group!(benches, load);
criterion_main!(benches);
