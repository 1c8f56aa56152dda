//! Products with constant weights: the product reads them where they lie in the file.

use super::{Constant, Slot, Step};
use crate::{
    ElementType,
    op::{ConstantProduct, DequantizeLinear, Weights, numbers},
};

/// Replaces each `MatMul` and each `Gemm` whose right-hand side is a constant matrix, or
/// `DequantizeLinear` of one, so that weights are not copied and stay int8 in memory. `prune` drops
/// the constant and the `DequantizeLinear` if nothing else reads them.
pub(crate) fn constant_products(steps: &mut [Step], constants: &[Option<Constant>]) {
    for index in 0..steps.len() {
        let (before, rest) = steps.split_at_mut(index);
        let step = &mut rest[0];
        let Some(product) = step.operator.as_product() else {
            continue;
        };
        let [left, Some(right), ref others @ ..] = step.inputs[..] else {
            continue;
        };
        let found = match &constants[right] {
            Some(constant) => stored(constant),
            None => {
                let source = before.iter().find(|step| step.output == right);
                source.and_then(|source| quantized(source, constants))
            }
        };
        if let Some((k, n, weights)) = found {
            let others = others.iter().copied();
            step.inputs = [left].into_iter().chain(others).collect();
            step.operator = Box::new(ConstantProduct {
                product,
                k,
                n,
                weights,
            });
        }
    }
}

type WeightMatrix = (usize, usize, Weights);

/// A matrix of float32 that lies in the file.
fn stored(constant: &Constant) -> Option<WeightMatrix> {
    let &[k, n] = constant.shape() else {
        return None;
    };
    let bytes = constant.stored(ElementType::F32)?;
    Some((k, n, Weights::F32(bytes.clone())))
}

/// The weights that a step expands, if they are int8 with one scale in all or one for each column.
fn quantized(source: &Step, constants: &[Option<Constant>]) -> Option<WeightMatrix> {
    let &DequantizeLinear { axis } = source.operator.as_dequantize()?;
    let constant = |index: usize| -> Option<&Constant> {
        let slot: Slot = source.inputs.get(index).copied().flatten()?;
        constants[slot].as_ref()
    };
    let &[k, n] = constant(0)?.shape() else {
        return None;
    };
    let weights = constant(0)?.stored(ElementType::I8)?.clone();
    let scale = constant(1)?.tensor().as_f32()?;
    let zero = match source.inputs.get(2).copied().flatten() {
        Some(_) => numbers(constant(2)?.tensor()),
        None => vec![0.0; scale.len()],
    };
    let (scale, zero) = match (scale, &zero[..]) {
        ([scale], [zero]) => (vec![*scale; n], vec![*zero; n]),
        _ if matches!(axis, 1 | -1) && scale.len() == n && zero.len() == n => {
            (scale.to_vec(), zero)
        }
        _ => return None,
    };
    Some((
        k,
        n,
        Weights::Quantized {
            weights,
            scale,
            zero,
        },
    ))
}

#[cfg(test)]
mod tests {
    use bytes::Bytes;

    use crate::{
        Dim, ElementType, Tensor,
        build::{Attribute, GraphBuilder, Value},
        load::load,
    };

    /// x [B, 2] times constant weights; whether a float32 copy of them exists after load.
    fn steps(product: impl FnOnce(&mut GraphBuilder, &Value) -> Value) -> String {
        let dims = |size| [Dim::named("B"), Dim::Fixed(size)];
        let mut graph = GraphBuilder::new("product");
        let x = graph.input("x", ElementType::F32, &dims(2));
        let y = product(&mut graph, &x);
        graph.output("y", &y, ElementType::F32, &dims(3));
        let plan = load(Bytes::from(graph.finish().unwrap())).unwrap();
        let matrices = plan.constants.iter().flatten();
        assert_eq!(matrices.filter(|c| c.shape().len() == 2).count(), 0);
        format!("{:?}", plan.steps[0])
    }

    fn weights(graph: &mut GraphBuilder) -> Value {
        graph.constant("w", Tensor::f32(&[2, 3], vec![1.0; 6]))
    }

    #[test]
    fn products_read_constant_weights_from_the_file() {
        let found = steps(|graph, x| {
            let w = weights(graph);
            graph.node("MatMul", &[Some(x), Some(&w)], &[])
        });
        assert!(found.contains("weights: F32(b\""), "{found}");
        let found = steps(|graph, x| {
            let w = weights(graph);
            let bias = graph.constant("b", Tensor::f32(&[3], vec![0.5; 3]));
            graph.gemm(x, &w, &bias)
        });
        assert!(found.contains("weights: F32(b\""), "{found}");
        let found = steps(|graph, x| {
            let (shape, data) = (vec![2, 3], Bytes::from_static(&[1; 6]));
            let q = graph.constant("q", Tensor::I8 { shape, data });
            let scale = graph.constant("s", Tensor::f32(&[3], vec![0.5; 3]));
            let axis = ("axis", Attribute::Int(1));
            let w = graph.node("DequantizeLinear", &[Some(&q), Some(&scale)], &[axis]);
            graph.node("MatMul", &[Some(x), Some(&w)], &[])
        });
        assert!(found.contains("weights: Quantized"), "{found}");
    }

    #[test]
    fn nothing_of_static_bytes_is_copied_at_load() {
        let mut graph = GraphBuilder::new("table");
        let x = graph.input("x", ElementType::I64, &[Dim::named("B")]);
        let table = graph.constant("table", Tensor::f32(&[4, 1], vec![0.5; 4]));
        let y = graph.node("Gather", &[Some(&table), Some(&x)], &[]);
        graph.output("y", &y, ElementType::F32, &[Dim::named("B"), Dim::Fixed(1)]);
        let file: &'static [u8] = graph.finish().unwrap().leak();
        let plan = load(Bytes::from_static(file)).unwrap();
        let constant = plan.constants.iter().flatten().next().unwrap();
        let stored = constant.stored(ElementType::F32).unwrap();
        assert!(file.as_ptr_range().contains(&stored.as_ptr()));
        assert!(constant.is_untouched());
        assert_eq!(constant.tensor().as_f32(), Some(&[0.5; 4][..]));
    }
}
