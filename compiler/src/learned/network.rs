//! Running a network, and distrusting what comes out.

use super::error::ModelError;
use asperity_nn::{Session, Tensor};

/// Runs a network on inputs, each with a name, a shape and its numbers.
///
/// # Errors
/// [`ModelError::Network`] with its file.
pub(super) fn run(
    file: &str,
    session: &dyn Session,
    inputs: &[(&str, &[usize], &[f32])],
) -> Result<Vec<(String, Tensor)>, ModelError> {
    let tensors: Vec<(&str, Tensor)> = inputs
        .iter()
        .map(|(name, shape, data)| {
            let tensor = Tensor::F32 {
                shape: shape.to_vec(),
                data: data.to_vec(),
            };
            (*name, tensor)
        })
        .collect();
    let inputs: Vec<(&str, &Tensor)> = tensors.iter().map(|(name, t)| (*name, t)).collect();
    session.run(&inputs).map_err(|error| ModelError::Network {
        file: file.into(),
        message: error.to_string(),
    })
}

/// Whether there is an output of this name.
pub(super) fn has(outputs: &[(String, Tensor)], name: &str) -> bool {
    outputs.iter().any(|(output, _)| output == name)
}

/// The output of this name, which must be finite and of this length.
///
/// # Errors
/// [`ModelError::Network`] with its file.
pub(super) fn take(
    file: &str,
    outputs: &[(String, Tensor)],
    name: &str,
    length: usize,
) -> Result<Vec<f32>, ModelError> {
    let fault = |message: String| ModelError::Network {
        file: file.into(),
        message,
    };
    match outputs.iter().find(|(output, _)| output == name) {
        Some((_, Tensor::F32 { data, .. })) if data.len() == length => {
            if data.iter().all(|x| x.is_finite()) {
                Ok(data.clone())
            } else {
                Err(fault(format!("output {name} is not finite")))
            }
        }
        Some((_, other)) => Err(fault(format!(
            "output {name} has shape {:?}, {length} numbers wanted",
            other.shape()
        ))),
        None => Err(fault(format!("no output {name}"))),
    }
}
