//! Written files read back equal, and the same graph gives the same bytes.

use asperity_nn::{
    Bytes, Dim, ElementType, Portable, Session, Tensor,
    build::{Attribute, GraphBuilder},
    proto::ModelProto,
};
use prost::Message as _;

fn graph() -> GraphBuilder {
    let mut graph = GraphBuilder::new("decoder");
    let z = graph.input("z", ElementType::F32, &[Dim::named("B"), Dim::Fixed(4)]);
    let w = graph.constant(
        "w",
        Tensor::f32(&[4, 6], (0..24).map(|i| (i as f32).sin()).collect()),
    );
    let b = graph.constant(
        "b",
        Tensor::f32(&[6], vec![0.1, -0.2, 0.3, -0.0, f32::MIN_POSITIVE, 1e30]),
    );
    let h = graph.gemm(&z, &w, &b);
    let h = graph.relu(&h);
    let shares = graph.reshape(&h, &[0, 2, 3]);
    let shares = graph.softmax(&shares, 2);
    let first = graph.slice(&shares, 2, 0, 2);
    graph.output(
        "first",
        &first,
        ElementType::F32,
        &[Dim::named("B"), Dim::Fixed(2), Dim::Fixed(2)],
    );
    let mean = graph.node(
        "ReduceMean",
        &[Some(&h)],
        &[("axes", Attribute::Ints(vec![1]))],
    );
    graph.output(
        "mean",
        &mean,
        ElementType::F32,
        &[Dim::named("B"), Dim::Any],
    );
    graph
}

#[test]
fn a_graph_reads_back_equal() {
    let (model, bytes) = (graph().to_model(), graph().finish().unwrap());
    let read = ModelProto::decode(&bytes[..]).unwrap();
    assert_eq!(read, model);
    assert_eq!(read.encode_to_vec(), bytes);
    assert_eq!(
        (read.ir_version, read.opset_import[0].version),
        (Some(8), Some(17))
    );
}

#[test]
fn ports_read_back() {
    let network = Portable::from_bytes(&graph().finish().unwrap()).unwrap();
    let text: Vec<_> = network
        .inputs()
        .iter()
        .chain(network.outputs())
        .map(ToString::to_string)
        .collect();
    assert_eq!(
        text,
        ["float32 [B, 4]", "float32 [B, 2, 2]", "float32 [B, ?]"]
    );
    assert_eq!(network.outputs()[0].name, "first");
}

#[test]
fn constants_of_every_type_read_back() {
    let constants = [
        Tensor::f32(&[2], vec![-0.0, f32::MAX]),
        Tensor::i64(&[1, 2], vec![i64::MIN, -1]),
        Tensor::I32 {
            shape: vec![],
            data: vec![i32::MIN],
        },
        Tensor::I8 {
            shape: vec![2],
            data: Bytes::from_static(&[0x80, 0x7f]),
        },
        Tensor::U8 {
            shape: vec![2],
            data: Bytes::from_static(&[0, 255]),
        },
        Tensor::Bool {
            shape: vec![2],
            data: vec![true, false],
        },
        Tensor::f32(&[0, 3], vec![]),
    ];
    let mut graph = GraphBuilder::new("constants");
    for (index, constant) in constants.iter().enumerate() {
        let value = graph.constant(&format!("c{index}"), constant.clone());
        let dims: Vec<_> = constant
            .shape()
            .iter()
            .map(|&size| Dim::Fixed(size))
            .collect();
        graph.output(&format!("y{index}"), &value, constant.element_type(), &dims);
    }
    let network = Portable::from_bytes(&graph.finish().unwrap()).unwrap();
    let results = network.run(&[]).unwrap();
    for ((_, result), constant) in results.iter().zip(&constants) {
        assert_eq!(result, constant);
    }
}

#[test]
fn a_graph_that_would_not_load_is_not_written() {
    let mut graph = GraphBuilder::new("wrong");
    let x = graph.input("x", ElementType::I64, &[Dim::Any]);
    let y = graph.relu(&x);
    graph.output("y", &y, ElementType::F32, &[Dim::Any]);
    let error = graph.finish().unwrap_err().to_string();
    assert_eq!(
        error,
        "node `Relu_1` (Relu): input 0 is int64, expected float32"
    );
}

/// Eight-bit weights stay in the buffer that the model was read from.
#[test]
fn weights_are_shared_with_the_file() {
    let weights: Vec<u8> = (0..=255).collect();
    let mut graph = GraphBuilder::new("table");
    let ids = graph.input("ids", ElementType::I64, &[Dim::Any]);
    let table = graph.constant(
        "table",
        Tensor::I8 {
            shape: vec![64, 4],
            data: weights.into(),
        },
    );
    let rows = graph.node("Gather", &[Some(&table), Some(&ids)], &[]);
    graph.output("rows", &rows, ElementType::I8, &[Dim::Any, Dim::Fixed(4)]);
    graph.output(
        "table_itself",
        &table,
        ElementType::I8,
        &[Dim::Fixed(64), Dim::Fixed(4)],
    );
    let file = Bytes::from(graph.finish().unwrap());
    let network = Portable::from_shared(file.clone()).unwrap();
    let results = network
        .run(&[("ids", &Tensor::i64(&[1], vec![2]))])
        .unwrap();
    let row = Tensor::I8 {
        shape: vec![1, 4],
        data: Bytes::from_static(&[8, 9, 10, 11]),
    };
    assert_eq!(results[0].1, row);
    let Tensor::I8 { data, .. } = &results[1].1 else {
        panic!("not int8")
    };
    let file = file.as_ptr_range();
    assert!(file.contains(&data.as_ptr()), "copied");
}
