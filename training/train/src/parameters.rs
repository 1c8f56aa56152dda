//! The numbers that are learned: named matrices, and their gradients' way back.

use crate::rng::Stream;
use burn_tensor::{Device, Gradients, Tensor, TensorData};

/// Where a parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Slot(usize);

/// A matrix; a vector is one row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Parameter {
    /// Name, unique.
    pub(crate) name: String,
    /// Rows: inputs of a layer.
    pub(crate) rows: usize,
    /// Columns: outputs of a layer.
    pub(crate) columns: usize,
    /// Row by row.
    pub(crate) values: Vec<f32>,
}

/// Every parameter of a network, in the order of their making.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Parameters {
    list: Vec<Parameter>,
}

impl Parameters {
    /// Adds a matrix, values row by row.
    pub(crate) fn add(&mut self, name: String, rows: usize, values: Vec<f32>) -> Slot {
        self.list.push(Parameter {
            name,
            rows,
            columns: values.len() / rows,
            values,
        });
        Slot(self.list.len() - 1)
    }

    /// All of them.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Parameter> {
        self.list.iter()
    }

    /// All of them, to change.
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Parameter> {
        self.list.iter_mut()
    }

    /// Returns the parameter in a slot.
    pub(crate) fn get(&self, slot: Slot) -> &Parameter {
        &self.list[slot.0]
    }

    /// Returns the parameter in a slot, to change.
    pub(crate) fn get_mut(&mut self, slot: Slot) -> &mut Parameter {
        &mut self.list[slot.0]
    }

    /// Returns the number of values in all parameters.
    pub(crate) fn count(&self) -> usize {
        self.list.iter().map(|p| p.values.len()).sum()
    }

    /// Copies onto a device; with autodiff on it, gradients are kept for them.
    pub(crate) fn bind(&self, device: &Device) -> Bound {
        let tensors = self.list.iter().map(|parameter| {
            let data = TensorData::new(
                parameter.values.clone(),
                [parameter.rows, parameter.columns],
            );
            let tensor = Tensor::from_data(data, device);
            if device.is_autodiff() {
                tensor.require_grad()
            } else {
                tensor
            }
        });
        Bound(tensors.collect())
    }
}

/// Parameters on a device.
pub(crate) struct Bound(Vec<Tensor<2>>);

impl Bound {
    /// Returns the tensor in a slot.
    pub(crate) fn get(&self, slot: Slot) -> Tensor<2> {
        self.0[slot.0].clone()
    }

    /// The gradients in the order of the parameters; `None` where the loss does not
    /// depend on one.
    pub(crate) fn gradients(self, mut gradients: Gradients) -> Vec<Option<Vec<f32>>> {
        let tensors = self.0.iter();
        tensors
            .map(|tensor| read(tensor.grad_remove(&mut gradients)?))
            .collect()
    }
}

/// The numbers of a tensor of f32, row by row; `None` for another type.
pub(crate) fn read<const D: usize>(tensor: Tensor<D>) -> Option<Vec<f32>> {
    tensor.into_data().try_into_vec::<f32>().ok()
}

/// Numbers of a tensor that was made of f32.
pub(crate) fn numbers(tensor: Tensor<2>) -> Vec<f32> {
    read(tensor).unwrap_or_default()
}

/// An affine layer `x·W + b`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Linear {
    /// Inputs × outputs.
    pub(crate) weight: Slot,
    /// A single row.
    pub(crate) bias: Slot,
}

impl Linear {
    /// A layer drawn uniformly from ±1/√inputs.
    pub(crate) fn new(
        parameters: &mut Parameters,
        name: &str,
        inputs: usize,
        outputs: usize,
        stream: &mut Stream,
    ) -> Self {
        let bound = 1.0 / libm::sqrtf(inputs as f32);
        let mut draw = |count| -> Vec<f32> {
            (0..count)
                .map(|_| bound * (2.0 * stream.uniform() - 1.0))
                .collect()
        };
        let weight = draw(inputs * outputs);
        let bias = draw(outputs);
        Self {
            weight: parameters.add(format!("{name}.weight"), inputs, weight),
            bias: parameters.add(format!("{name}.bias"), 1, bias),
        }
    }

    /// `x·W + b`.
    pub(crate) fn forward(self, bound: &Bound, x: Tensor<2>) -> Tensor<2> {
        x.matmul(bound.get(self.weight)) + bound.get(self.bias)
    }
}

/// A chain of layers of given widths.
pub(crate) fn chain(
    parameters: &mut Parameters,
    name: &str,
    widths: &[usize],
    stream: &mut Stream,
) -> Vec<Linear> {
    widths
        .windows(2)
        .enumerate()
        .map(|(index, pair)| {
            Linear::new(
                parameters,
                &format!("{name}.{index}"),
                pair[0],
                pair[1],
                stream,
            )
        })
        .collect()
}
