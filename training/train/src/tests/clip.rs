//! From a text tower of CLIP's signature, tiny and made up, to a texture of a prompt.

use super::{folder::exported_of, training::small};
use crate::{
    Captions, fit_on,
    synthetic::{self, Silent},
};
use asperity::{
    learned::{
        Files, LearnedModel,
        inference::Backend,
        text::{TextEncoder as _, clip::Clip},
    },
    sources::prompt::{Options, PromptCompiler},
};
use asperity_nn::{
    Dim, ElementType, Tensor,
    build::{Attribute, GraphBuilder},
};
use std::{fs, path::Path};

const WIDTH: usize = 24;
const VOCABULARY: usize = 49_408;

/// ids [1, 77] → mean of a table's rows.
fn write_tower(folder: &Path) {
    let mut graph = GraphBuilder::new("tower");
    let ids = graph.input(
        "input_ids",
        ElementType::I64,
        &[Dim::Fixed(1), Dim::Fixed(77)],
    );
    let values = (0..VOCABULARY * WIDTH).map(|n| ((n % 9973) as f32 * 0.37).sin());
    let table = graph.constant("table", Tensor::f32(&[VOCABULARY, WIDTH], values.collect()));
    let rows = graph.node(
        "Gather",
        &[Some(&table), Some(&ids)],
        &[("axis", Attribute::Int(0))],
    );
    let mean = graph.node(
        "ReduceMean",
        &[Some(&rows)],
        &[
            ("axes", Attribute::Ints(vec![1])),
            ("keepdims", Attribute::Int(0)),
        ],
    );
    let shape = [Dim::Fixed(1), Dim::Fixed(WIDTH)];
    graph.output("text_embeds", &mean, ElementType::F32, &shape);
    fs::write(folder.join("text_model.onnx"), graph.finish().unwrap()).unwrap();
}

#[test]
fn a_tower_trains_a_projection_of_its_width_and_prompts_go_through_both() {
    let folder = tempfile::tempdir().unwrap();
    write_tower(folder.path());
    let backend = Backend::Portable;
    let clip = Clip::open(folder.path(), &backend).unwrap();
    let corpus = synthetic::corpus(6, 6);
    let captions = Captions::encode(&corpus, &synthetic::lexicon(), &clip).unwrap();
    let mut config = small();
    config.optimiser.epochs = 4;
    let all: Vec<usize> = (0..6).collect();
    let trained = fit_on(&corpus, &all, &captions, &config, &mut Silent).unwrap();
    let target = folder.path().join("model");
    exported_of(&trained, &corpus, &captions)
        .write(&target)
        .unwrap();

    let model = LearnedModel::load(Files::read(&target).unwrap(), &backend).unwrap();
    assert_eq!(model.description().text_encoder.width, WIDTH);
    assert!(model.description().text_encoder.name.starts_with("clip"));
    let vector = clip.encode("rough bark").unwrap().vector;
    let (found, expected) = (
        model.project(&vector).unwrap().z,
        trained.project(&[&vector])[0],
    );
    for (x, y) in found.iter().zip(expected) {
        assert!((x - y).abs() < 1e-3, "{x} {y}");
    }
    let prompt_compiler = PromptCompiler::new(Box::new(clip), model).unwrap();
    let authored = prompt_compiler
        .compile("rough bark", &Options::default())
        .unwrap();
    assert!(!authored.lowered.bytes.is_empty());
}
