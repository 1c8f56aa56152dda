//! The portable engine.

use bytes::Bytes;

use crate::{
    OnnxError, OpError, Port, RunError, Session, Tensor,
    load::{self, Constant, Plan, Slot, Step},
    op::{Inputs, RUN_LIMIT, layout},
    session::check_inputs,
};

/// Most elements of all computed tensors that exist at one time.
const LIVE_LIMIT: usize = 1 << 27;

/// A network that runs on one thread, in plain f32, with the same bits on every processor.
///
/// Loading checks the whole model; the only errors left for a run concern shapes. NaNs in results
/// are replaced by one canonical NaN, since processors differ in their bits.
///
/// ```
/// use asperity_nn::{Dim, ElementType, Portable, Session, Tensor, build::GraphBuilder};
///
/// let mut graph = GraphBuilder::new("double");
/// let x = graph.input("x", ElementType::F32, &[Dim::named("B")]);
/// let two = graph.constant("two", Tensor::f32(&[], vec![2.0]));
/// let y = graph.mul(&x, &two);
/// graph.output("y", &y, ElementType::F32, &[Dim::named("B")]);
///
/// let network = Portable::from_bytes(&graph.finish()?)?;
/// let x = Tensor::f32(&[2], vec![1.0, 3.0]);
/// let results = network.run(&[("x", &x)])?;
/// assert_eq!(results[0].1.as_f32(), Some(&[2.0, 6.0][..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Portable {
    plan: Plan,
}

impl Portable {
    /// Loads a model from bytes, which it copies once.
    ///
    /// # Errors
    /// [`OnnxError`] names the node or constant and the field that cannot be used.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, OnnxError> {
        Self::from_shared(Bytes::copy_from_slice(bytes))
    }

    /// Loads a model from shared bytes, such as `Bytes::from_static(include_bytes!(…))`
    /// or `Bytes::from(vec)`:
    /// the weights of products and 8-bit tables stay where they are, and nothing is copied before
    /// a run needs it.
    ///
    /// # Errors
    /// As [`from_bytes`](Self::from_bytes).
    pub fn from_shared(bytes: Bytes) -> Result<Self, OnnxError> {
        Ok(Self {
            plan: load::load(bytes)?,
        })
    }

    fn step<'v>(
        &'v self,
        step: &Step,
        values: &[Value<'v>],
        live: usize,
    ) -> Result<Tensor, OpError> {
        let inputs: Vec<Option<&Tensor>> = step
            .inputs
            .iter()
            .map(|slot| slot.and_then(|slot| values[slot].get()))
            .collect();
        step.operator.run(&Inputs {
            values: &inputs,
            limit: RUN_LIMIT.min(LIVE_LIMIT.saturating_sub(live)),
        })
    }
}

/// The content of a slot in a run.
enum Value<'a> {
    /// Not computed yet, or not needed any more.
    None,
    /// A constant, which is decoded by the first step that reads it.
    Constant(&'a Constant),
    /// An input of the caller.
    Borrowed(&'a Tensor),
    /// Computed in this run.
    Owned(Tensor),
}

impl Value<'_> {
    fn get(&self) -> Option<&Tensor> {
        match self {
            Self::None => None,
            Self::Constant(constant) => Some(constant.tensor()),
            Self::Borrowed(tensor) => Some(tensor),
            Self::Owned(tensor) => Some(tensor),
        }
    }

    /// Elements that this run has allocated for it.
    fn owned(&self) -> usize {
        match self {
            Self::Owned(tensor) => tensor.len(),
            _ => 0,
        }
    }
}

impl Portable {
    /// Values that the graph names, in the order of the names. No step behind the last of them runs: the states of a layer
    /// cost the layers up to it.
    ///
    /// # Errors
    /// As [`Session::run`], and [`RunError::UnknownValue`] for a name that no step of the loaded graph computes: of an
    /// input, a constant, or a value that no output needs.
    pub fn values(
        &self,
        inputs: &[(&str, &Tensor)],
        names: &[&str],
    ) -> Result<Vec<Tensor>, RunError> {
        let steps = &self.plan.steps;
        let find = |name: &&str| {
            let slot = self.plan.slots.get(*name).copied();
            let step = slot.and_then(|slot| steps.iter().position(|step| step.output == slot));
            step.ok_or_else(|| RunError::UnknownValue {
                name: (*name).to_owned(),
            })
        };
        let found: Vec<usize> = names.iter().map(find).collect::<Result<_, _>>()?;
        let slots: Vec<Slot> = found.iter().map(|&step| steps[step].output).collect();
        let end = found.into_iter().max().map_or(0, |last| last + 1);
        self.compute(inputs, end, &slots)
    }

    /// Runs the first `end` steps, and returns the values of `slots`.
    fn compute(
        &self,
        inputs: &[(&str, &Tensor)],
        end: usize,
        slots: &[Slot],
    ) -> Result<Vec<Tensor>, RunError> {
        check_inputs(&self.plan.inputs, inputs)?;
        let plan = &self.plan;
        let mut values: Vec<Value<'_>> = plan
            .constants
            .iter()
            .map(|constant| constant.as_ref().map_or(Value::None, Value::Constant))
            .collect();
        for (port, &slot) in plan.inputs.iter().zip(&plan.input_slots) {
            for (name, tensor) in inputs {
                if *name == port.name {
                    check_size(port, tensor)?;
                    values[slot] = Value::Borrowed(tensor);
                }
            }
        }
        let mut live = 0;
        for step in &plan.steps[..end] {
            let result = self
                .step(step, &values, live)
                .map_err(|source| RunError::Node {
                    node: step.name.clone(),
                    op_type: step.op_type.clone(),
                    source,
                })?;
            live += result.len();
            values[step.output] = Value::Owned(result);
            for slot in step.last_uses.iter().filter(|slot| !slots.contains(slot)) {
                live -= values[*slot].owned();
                values[*slot] = Value::None;
            }
        }
        let value = |slot: &Slot| {
            let value = values[*slot].get().cloned();
            value.map(canonical).ok_or(RunError::Node {
                node: slot.to_string(),
                op_type: "output".to_owned(),
                source: OpError::Input(0),
            })
        };
        slots.iter().map(value).collect()
    }
}

impl Session for Portable {
    fn inputs(&self) -> &[Port] {
        &self.plan.inputs
    }

    fn outputs(&self) -> &[Port] {
        &self.plan.outputs
    }

    fn run(&self, inputs: &[(&str, &Tensor)]) -> Result<Vec<(String, Tensor)>, RunError> {
        let plan = &self.plan;
        let values = self.compute(inputs, plan.steps.len(), &plan.output_slots)?;
        let names = plan.outputs.iter().map(|port| port.name.clone());
        Ok(names.zip(values).collect())
    }
}

fn check_size(port: &Port, tensor: &Tensor) -> Result<(), RunError> {
    match layout::size(tensor.shape(), RUN_LIMIT) {
        Ok(_) => Ok(()),
        Err(error) => Err(RunError::WrongInput {
            name: port.name.clone(),
            found: error.to_string(),
            expected: port.to_string(),
        }),
    }
}

fn canonical(mut tensor: Tensor) -> Tensor {
    if let Tensor::F32 { data, .. } = &mut tensor {
        for x in data {
            if x.is_nan() {
                *x = f32::NAN;
            }
        }
    }
    tensor
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dim, ElementType, build::GraphBuilder};

    /// Claim: a named value is what the graph computes on its way, and costs nothing behind it.
    #[test]
    fn named_values_are_those_on_the_way() {
        let mut graph = GraphBuilder::new("powers");
        let x = graph.input("x", ElementType::F32, &[Dim::named("B")]);
        let two = graph.constant("two", Tensor::f32(&[], vec![2.0]));
        let double = graph.mul(&x, &two);
        let square = graph.mul(&double, &double);
        let bad = graph.constant("bad", Tensor::f32(&[3], vec![1.0; 3]));
        let last = graph.mul(&square, &bad);
        graph.output("y", &last, ElementType::F32, &[Dim::Any]);
        let network = Portable::from_bytes(&graph.finish().expect("a graph")).expect("a network");
        let x = Tensor::f32(&[2], vec![1.0, 3.0]);
        let inputs = [("x", &x)];
        // The last product does not fit two numbers.
        assert!(network.run(&inputs).is_err());
        let names = [square.name(), double.name()];
        let values = network.values(&inputs, &names).expect("both");
        let values: Vec<_> = values.iter().map(|value| value.as_f32()).collect();
        assert_eq!(values, [Some(&[4.0, 36.0][..]), Some(&[2.0, 6.0])]);
        for other in ["x", "two", "none"] {
            let error = network.values(&inputs, &[other]).expect_err(other);
            assert!(error.to_string().contains(other), "{error}");
        }
    }
}
