//! Inputs and outputs of the networks.

use crate::error::Problem;
use asperity_nn::{Dim, ElementType, Port, Session, Tensor};

/// The input of this name, of one of these types and this many dimensions.
pub(crate) fn input<'s>(
    session: &'s dyn Session,
    name: &'static str,
    types: &[ElementType],
    ranks: &[usize],
) -> Result<&'s Port, Problem> {
    let found = session.inputs().iter().find(|port| port.name == name);
    let port = found.ok_or_else(|| missing("input", name, session.inputs()))?;
    checked("input", port, types, ranks)
}

/// The output of this name, or the only one, in float32 of this many dimensions.
pub(crate) fn output<'s>(
    session: &'s dyn Session,
    name: &'static str,
    rank: usize,
) -> Result<&'s Port, Problem> {
    let outputs = session.outputs();
    let named = outputs.iter().find(|port| port.name == name);
    let port = match (named, outputs) {
        (Some(port), _) | (None, [port]) => port,
        _ => return Err(missing("output", name, outputs)),
    };
    checked("output", port, &[ElementType::F32], &[rank])
}

/// Refuses inputs besides these.
pub(crate) fn no_others(
    session: &dyn Session,
    known: &[&str],
    expected: &'static str,
) -> Result<(), Problem> {
    let other = session
        .inputs()
        .iter()
        .find(|port| !known.contains(&port.name.as_str()));
    match other {
        Some(port) => Err(Problem::ExtraInput {
            name: port.name.clone(),
            expected,
        }),
        None => Ok(()),
    }
}

/// A dimension of a port, if the file states it as a number.
pub(crate) fn fixed(port: &Port, axis: usize) -> Option<usize> {
    match port.dims.as_ref()?.get(axis)? {
        Dim::Fixed(size) => Some(*size),
        _ => None,
    }
}

/// Integers in the type of a port.
pub(crate) fn integers(port: &Port, shape: &[usize], values: &[i64]) -> Tensor {
    let shape = shape.to_vec();
    match port.element_type {
        ElementType::I32 => Tensor::I32 {
            shape,
            data: values.iter().map(|&value| value as i32).collect(),
        },
        ElementType::F32 => Tensor::F32 {
            shape,
            data: values.iter().map(|&value| value as f32).collect(),
        },
        _ => Tensor::I64 {
            shape,
            data: values.to_vec(),
        },
    }
}

/// Runs a network and takes one output in float32: its shape and elements, all of them finite.
/// `when` says when, for the error.
pub(crate) fn run(
    session: &dyn Session,
    inputs: &[(&str, &Tensor)],
    output: &str,
    when: impl Fn() -> String,
) -> Result<(Vec<usize>, Vec<f32>), Problem> {
    let outputs = session
        .run(inputs)
        .map_err(|error| Problem::Run(error.to_string()))?;
    let found = outputs.into_iter().find(|(name, _)| name == output);
    let Some((_, Tensor::F32 { shape, data })) = found else {
        return Err(Problem::Run(format!("gave no `{output}` in float32")));
    };
    match data.iter().find(|x| !x.is_finite()) {
        Some(value) => Err(Problem::NotFinite {
            name: output.to_owned(),
            value: value.to_string(),
            when: when(),
        }),
        None => Ok((shape, data)),
    }
}

/// An output of another shape than it should have.
pub(crate) fn wrong_shape(name: &str, found: &[usize], expected: &[usize]) -> Problem {
    Problem::Port {
        direction: "output",
        name: name.to_owned(),
        found: format!("float32 {found:?}"),
        expected: format!("float32 {expected:?}"),
    }
}

fn checked<'s>(
    direction: &'static str,
    port: &'s Port,
    types: &[ElementType],
    ranks: &[usize],
) -> Result<&'s Port, Problem> {
    let rank = port.dims.as_ref().map(Vec::len);
    if types.contains(&port.element_type) && rank.is_none_or(|rank| ranks.contains(&rank)) {
        return Ok(port);
    }
    let types: Vec<String> = types.iter().map(ToString::to_string).collect();
    let ranks: Vec<String> = ranks.iter().map(ToString::to_string).collect();
    Err(Problem::Port {
        direction,
        name: port.name.clone(),
        found: port.to_string(),
        expected: format!(
            "{} of {} dimensions",
            types.join(" or "),
            ranks.join(" or ")
        ),
    })
}

fn missing(direction: &'static str, name: &'static str, ports: &[Port]) -> Problem {
    let names: Vec<String> = ports
        .iter()
        .map(|port| format!("`{}`", port.name))
        .collect();
    Problem::MissingPort {
        direction,
        name,
        found: if names.is_empty() {
            "none".into()
        } else {
            names.join(", ")
        },
    }
}
