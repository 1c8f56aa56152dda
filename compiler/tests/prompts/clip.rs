//! A text tower of CLIP's signature, tiny and made up, with a projection of its width.

use asperity::{
    learned::{
        Files, LearnedModel,
        description::ModelDescription,
        embedded,
        inference::Backend,
        text::{TextEncoder as _, clip::Clip},
    },
    sources::prompt::{Options, PromptCompiler},
};
use asperity_nn::{
    Dim, ElementType, Tensor,
    build::{Attribute, GraphBuilder},
};

const WIDTH: usize = 32;
const VOCABULARY: usize = 49_408;

/// ids [1, 77] → mean of a table's rows.
fn tower(ids: ElementType) -> Vec<u8> {
    let mut graph = GraphBuilder::new("tower");
    let input = graph.input("input_ids", ids, &[Dim::Fixed(1), Dim::Fixed(77)]);
    let values = (0..VOCABULARY * WIDTH).map(|n| ((n % 9973) as f32 * 0.37).sin());
    let table = graph.constant("table", Tensor::f32(&[VOCABULARY, WIDTH], values.collect()));
    let rows = graph.node(
        "Gather",
        &[Some(&table), Some(&input)],
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
    graph.output(
        "text_embeds",
        &mean,
        ElementType::F32,
        &[Dim::Fixed(1), Dim::Fixed(WIDTH)],
    );
    graph.finish().unwrap()
}

/// A model folder's files with a projection of the tower's width.
fn files() -> Files {
    let shipped = embedded::model();
    let mut description: ModelDescription = serde_json::from_str(&shipped.description).unwrap();
    description.text_encoder.name = "clip".into();
    description.text_encoder.width = WIDTH;
    let anchors = description.anchors.len();
    let mut graph = GraphBuilder::new("projection");
    let batch = || Dim::named("B");
    let x = graph.input("embedding", ElementType::F32, &[batch(), Dim::Fixed(WIDTH)]);
    for (name, columns) in [("z", 64), ("similarity", anchors), ("familiarity", 1)] {
        let values = (0..WIDTH * columns)
            .map(|n| (n as f32 * 0.71).cos() * 0.2)
            .collect();
        let weights = graph.constant(
            &format!("{name}.weight"),
            Tensor::f32(&[WIDTH, columns], values),
        );
        let y = graph.node("MatMul", &[Some(&x), Some(&weights)], &[]);
        graph.output(name, &y, ElementType::F32, &[batch(), Dim::Fixed(columns)]);
    }
    Files {
        description: serde_json::to_string(&description).unwrap().into(),
        text_projection: graph.finish().unwrap().into(),
        known_crc32: None,
        ..shipped
    }
}

#[test]
fn a_tower_of_this_signature_is_read_and_its_width_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    for ids in [ElementType::I64, ElementType::I32] {
        std::fs::write(folder.path().join("text_model.onnx"), tower(ids)).unwrap();
        let clip = Clip::open(folder.path(), &Backend::Portable).unwrap();
        assert_eq!(clip.width(), WIDTH);
        let encoded = clip.encode("rough bark").unwrap();
        let norm: f32 = encoded.vector.iter().map(|x| x * x).sum();
        assert!((norm - 1.0).abs() < 1e-5);
        assert_eq!(clip.encode(&"word ".repeat(100)).unwrap().cut, 25);
    }
}

#[test]
fn a_prompt_goes_through_a_tower_with_a_projection_of_its_width() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.onnx"), tower(ElementType::I64)).unwrap();
    let backend = Backend::Portable;
    let clip = || Box::new(Clip::open(folder.path(), &backend).unwrap());
    let model = LearnedModel::load(files(), &backend).unwrap();
    let prompt_compiler = PromptCompiler::new(clip(), model).unwrap();
    assert!(
        prompt_compiler
            .compile("rough bark", &Options::default())
            .is_ok()
    );
    // The shipped projection takes vectors of another width, and says so.
    let shipped = LearnedModel::load(embedded::model(), &backend).unwrap();
    let refused = PromptCompiler::new(clip(), shipped)
        .err()
        .unwrap()
        .to_string();
    assert!(
        refused.contains("480") && refused.contains("32"),
        "{refused}"
    );
}

#[test]
fn a_folder_without_a_tower_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let error = Clip::open(folder.path(), &Backend::Portable)
        .err()
        .unwrap()
        .to_string();
    assert!(error.contains("text_model.onnx"), "{error}");
}
