//! Pieces of graphs that several networks share.

use super::halves::Halves;
use crate::parameters::{Linear, Parameters, Slot};
use asperity_nn::{
    Dim, ElementType, Tensor,
    build::{Attribute, GraphBuilder, Value},
};

/// A graph and the parameters it is made of.
pub(super) struct Writer<'a> {
    pub(super) graph: GraphBuilder,
    parameters: &'a Parameters,
}

impl<'a> Writer<'a> {
    pub(super) fn new(name: &str, parameters: &'a Parameters) -> Self {
        Self {
            graph: GraphBuilder::new(name),
            parameters,
        }
    }

    /// An input of f32, one row an item of the batch.
    pub(super) fn input(&mut self, name: &str, row: &[usize]) -> Value {
        self.graph.input(name, ElementType::F32, &dims(row))
    }

    /// An output of f32, one row an item of the batch.
    pub(super) fn output(&mut self, name: &str, value: &Value, row: &[usize]) {
        self.graph.output(name, value, ElementType::F32, &dims(row));
    }

    /// A constant of one row.
    pub(super) fn row(&mut self, name: &str, values: &[f32]) -> Value {
        self.table(name, &[1, values.len()], values.to_vec())
    }

    /// A constant of any shape.
    pub(super) fn table(&mut self, name: &str, shape: &[usize], values: Vec<f32>) -> Value {
        self.graph.constant(name, Tensor::f32(shape, values))
    }

    /// A learned row.
    pub(super) fn parameter(&mut self, slot: Slot) -> Value {
        let parameter = self.parameters.get(slot);
        let shape = [parameter.rows, parameter.columns];
        self.graph.constant(
            &parameter.name,
            Tensor::f32(&shape, parameter.values.clone()),
        )
    }

    /// `x·W + b`, W in 16 bits.
    pub(super) fn linear(&mut self, layer: Linear, x: &Value) -> Value {
        let weight = self.parameters.get(layer.weight);
        let bias = self.parameters.get(layer.bias);
        let values = Tensor::f32(&[bias.columns], bias.values.clone());
        let bias = self.graph.constant(&bias.name, values);
        let (high, low) = self.halves(&weight.name, &weight.values, weight.columns);
        let product = self.graph.gemm(x, &high, &bias);
        let rest = self.graph.node("MatMul", &[Some(x), Some(&low)], &[]);
        self.graph.add(&product, &rest)
    }

    /// `x·W` for a matrix of so many columns, W in 16 bits.
    pub(super) fn product(
        &mut self,
        name: &str,
        x: &Value,
        values: &[f32],
        columns: usize,
    ) -> Value {
        let (high, low) = self.halves(name, values, columns);
        let product = self.graph.node("MatMul", &[Some(x), Some(&high)], &[]);
        let rest = self.graph.node("MatMul", &[Some(x), Some(&low)], &[]);
        self.graph.add(&product, &rest)
    }

    /// A matrix as the sum of two of 8 bits: half the bytes of f32, and an error below 1/60,000 of
    /// the largest weight of each column. A back end may keep both as they are.
    fn halves(&mut self, name: &str, values: &[f32], columns: usize) -> (Value, Value) {
        let (high, low) = Halves::of(values, columns).constants(columns);
        let mut matrix = |name: String, (codes, scales): (Tensor, Tensor)| {
            let codes = self.graph.constant(&name, codes);
            let scales = self.graph.constant(&format!("{name}.scales"), scales);
            let axis = ("axis", Attribute::Int(1));
            let inputs = [Some(&codes), Some(&scales)];
            self.graph.node("DequantizeLinear", &inputs, &[axis])
        };
        let high = matrix(format!("{name}.high"), high);
        (high, matrix(format!("{name}.low"), low))
    }

    /// Layers with ReLU between them.
    pub(super) fn chain(&mut self, layers: &[Linear], x: &Value) -> Value {
        let mut x = x.clone();
        for (index, layer) in layers.iter().enumerate() {
            if index > 0 {
                x = self.graph.relu(&x);
            }
            x = self.linear(*layer, &x);
        }
        x
    }

    /// `(x − mean) / deviation`.
    pub(super) fn normalise(
        &mut self,
        name: &str,
        x: &Value,
        mean: &[f32],
        deviation: &[f32],
    ) -> Value {
        let mean = self.row(&format!("{name}.mean"), mean);
        let deviation = self.row(&format!("{name}.deviation"), deviation);
        let centred = self.graph.sub(x, &mean);
        self.graph.div(&centred, &deviation)
    }

    /// `x · deviation + mean`.
    pub(super) fn restore(
        &mut self,
        name: &str,
        x: &Value,
        mean: &[f32],
        deviation: &[f32],
    ) -> Value {
        let mean = self.row(&format!("{name}.mean"), mean);
        let deviation = self.row(&format!("{name}.deviation"), deviation);
        let scaled = self.graph.mul(x, &deviation);
        self.graph.add(&scaled, &mean)
    }

    /// `x + number`.
    pub(super) fn plus(&mut self, x: &Value, number: f32) -> Value {
        let number = self.graph.scalar(number);
        self.graph.add(x, &number)
    }

    /// `x · number`.
    pub(super) fn times(&mut self, x: &Value, number: f32) -> Value {
        let number = self.graph.scalar(number);
        self.graph.mul(x, &number)
    }

    /// Elements along an axis, by index.
    pub(super) fn gather(&mut self, x: &Value, axis: i64, indices: &[i64]) -> Value {
        let indices = self.graph.integers(indices);
        let axis = ("axis", Attribute::Int(axis));
        self.graph
            .node("Gather", &[Some(x), Some(&indices)], &[axis])
    }
}

fn dims(row: &[usize]) -> Vec<Dim> {
    let row = row.iter().map(|&size| Dim::Fixed(size));
    [Dim::named("B")].into_iter().chain(row).collect()
}
