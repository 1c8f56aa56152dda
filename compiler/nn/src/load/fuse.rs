//! Products with quantised weights: `DequantizeLinear` and `MatMul` become one step.

use super::{Slot, Step};
use crate::{
    Tensor,
    op::{QuantizedMatMul, numbers},
};

/// Replaces each `MatMul` whose right-hand side is `DequantizeLinear` of constants, so that
/// weights stay int8 in memory. `prune` drops the `DequantizeLinear` if nothing else reads it.
pub(crate) fn quantized_products(steps: &mut [Step], constants: &[Option<Tensor>]) {
    for index in 0..steps.len() {
        let (before, rest) = steps.split_at_mut(index);
        let step = &mut rest[0];
        if step.operator.as_matmul().is_none() {
            continue;
        }
        let [Some(left), Some(right)] = step.inputs[..] else {
            continue;
        };
        let Some(source) = before.iter().find(|step| step.output == right) else {
            continue;
        };
        if let Some(fused) = fuse(source, constants) {
            step.operator = Box::new(fused);
            step.inputs = vec![Some(left)];
        }
    }
}

/// The product with the weights that a step expands, if they are int8 with one scale in all or
/// one for each column.
fn fuse(source: &Step, constants: &[Option<Tensor>]) -> Option<QuantizedMatMul> {
    let axis = source.operator.as_dequantize()?.axis;
    let constant = |index: usize| -> Option<&Tensor> {
        let slot: Slot = source.inputs.get(index).copied().flatten()?;
        constants[slot].as_ref()
    };
    let Tensor::I8 { shape, data } = constant(0)? else {
        return None;
    };
    let &[k, n] = &shape[..] else { return None };
    let scale = constant(1)?.as_f32()?;
    let zero = match source.inputs.get(2).copied().flatten() {
        Some(_) => numbers(constant(2)?),
        None => vec![0.0; scale.len()],
    };
    let (scale, zero) = match (scale, &zero[..]) {
        ([scale], [zero]) => (vec![*scale; n], vec![*zero; n]),
        _ if matches!(axis, 1 | -1) && scale.len() == n && zero.len() == n => {
            (scale.to_vec(), zero)
        }
        _ => return None,
    };
    Some(QuantizedMatMul {
        k,
        n,
        weights: data.clone(),
        scale,
        zero,
    })
}
