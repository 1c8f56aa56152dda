//! Each operator against cases computed by hand (or, for functions, by their definition), as a node
//! that runs, as one that is folded at load, and as one whose first input alone is not constant: all
//! must give the same bits.

mod elements;
mod normalization;
mod picking;
mod products;
mod shapes;

use asperity_nn::{
    Port, Portable, Session, Tensor,
    build::{Attribute, GraphBuilder},
    proto::{GraphProto, ModelProto},
};
use prost::Message as _;

/// Runs a single node with these inputs; `None` is left out.
fn apply(op_type: &str, inputs: &[Option<Tensor>], attributes: &[(&str, Attribute)]) -> Tensor {
    match try_apply(op_type, inputs, attributes) {
        Ok(tensor) => tensor,
        Err(error) => panic!("{error}"),
    }
}

/// [`apply`] to inputs that are all given.
fn apply_to(op_type: &str, inputs: &[Tensor]) -> Tensor {
    let inputs: Vec<_> = inputs.iter().cloned().map(Some).collect();
    apply(op_type, &inputs, &[])
}

/// Returns the error of running a node.
fn refusal(op_type: &str, inputs: &[Tensor], attributes: &[(&str, Attribute)]) -> String {
    let inputs: Vec<_> = inputs.iter().cloned().map(Some).collect();
    match try_apply(op_type, &inputs, attributes) {
        Ok(tensor) => panic!("{op_type} gave {tensor:?}"),
        Err(error) => error,
    }
}

fn try_apply(
    op_type: &str,
    inputs: &[Option<Tensor>],
    attributes: &[(&str, Attribute)],
) -> Result<Tensor, String> {
    let run = evaluate(op_type, inputs, attributes, inputs.len());
    // Folded at load, and with the weights of a product where the file has them.
    for first_constant in [0, 1] {
        let other = evaluate(op_type, inputs, attributes, first_constant);
        match (&run, &other) {
            (Ok(run), Ok(other)) => assert_eq!(format!("{run:?}"), format!("{other:?}")),
            (run, other) => assert_eq!(run.is_ok(), other.is_ok(), "{run:?} {other:?}"),
        }
    }
    run
}

fn evaluate(
    op_type: &str,
    inputs: &[Option<Tensor>],
    attributes: &[(&str, Attribute)],
    first_constant: usize,
) -> Result<Tensor, String> {
    let mut graph = GraphBuilder::new("one node");
    let mut values = Vec::new();
    let mut given = Vec::new();
    for (index, tensor) in inputs.iter().enumerate() {
        let Some(tensor) = tensor else {
            values.push(None);
            continue;
        };
        let name = format!("input{index}");
        let dims = vec![asperity_nn::Dim::Any; tensor.shape().len()];
        if index >= first_constant {
            values.push(Some(graph.constant(&name, tensor.clone())));
        } else {
            values.push(Some(graph.input(&name, tensor.element_type(), &dims)));
            given.push((name, tensor));
        }
    }
    let values: Vec<_> = values.iter().map(Option::as_ref).collect();
    graph.node(op_type, &values, attributes);
    let mut model = graph.to_model();
    name_output(&mut model);
    // The type of the output is not known here, so all are tried.
    let mut error = String::new();
    for code in [1, 7, 6, 9, 3, 2] {
        if let Some(graph) = &mut model.graph {
            set_type(graph, code);
        }
        match Portable::from_bytes(&model.encode_to_vec()) {
            Ok(network) => {
                let given: Vec<_> = given
                    .iter()
                    .map(|(name, tensor)| (name.as_str(), *tensor))
                    .collect();
                let results = network.run(&given).map_err(|error| error.to_string())?;
                return Ok(results[0].1.clone());
            }
            Err(other) => {
                let text = other.to_string();
                if error.is_empty() || error.starts_with("output") {
                    error = text;
                }
            }
        }
    }
    Err(error)
}

/// Declares the value of the only node as output of the graph.
fn name_output(model: &mut ModelProto) {
    if let Some(graph) = &mut model.graph {
        let name = graph.node[0].output[0].clone();
        graph.output = vec![asperity_nn::proto::ValueInfoProto {
            name,
            r#type: Some(asperity_nn::proto::TypeProto {
                tensor_type: Some(asperity_nn::proto::TensorTypeProto::default()),
            }),
        }];
    }
}

fn set_type(graph: &mut GraphProto, code: i32) {
    for output in &mut graph.output {
        if let Some(tensor) = output
            .r#type
            .as_mut()
            .and_then(|info| info.tensor_type.as_mut())
        {
            tensor.elem_type = code;
        }
    }
}

fn f32s(shape: &[usize], data: &[f32]) -> Tensor {
    Tensor::f32(shape, data.to_vec())
}

fn i64s(shape: &[usize], data: &[i64]) -> Tensor {
    Tensor::i64(shape, data.to_vec())
}

/// 0, 1, 2, … in a shape.
fn counted(shape: &[usize]) -> Tensor {
    let size: usize = shape.iter().product();
    Tensor::f32(shape, (0..size).map(|i| i as f32).collect())
}

#[test]
fn ports_say_what_they_are() {
    let port = Port {
        name: "x".to_owned(),
        element_type: asperity_nn::ElementType::F32,
        dims: Some(vec![
            asperity_nn::Dim::named("B"),
            asperity_nn::Dim::Fixed(3),
            asperity_nn::Dim::Any,
        ]),
    };
    assert_eq!(port.to_string(), "float32 [B, 3, ?]");
}
