//! The portable engine.

use bytes::Bytes;

use crate::{
    OnnxError, OpError, Port, RunError, Session, Tensor,
    load::{self, Constant, Plan, Step},
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

impl Session for Portable {
    fn inputs(&self) -> &[Port] {
        &self.plan.inputs
    }

    fn outputs(&self) -> &[Port] {
        &self.plan.outputs
    }

    fn run(&self, inputs: &[(&str, &Tensor)]) -> Result<Vec<(String, Tensor)>, RunError> {
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
        for step in &plan.steps {
            let result = self
                .step(step, &values, live)
                .map_err(|source| RunError::Node {
                    node: step.name.clone(),
                    op_type: step.op_type.clone(),
                    source,
                })?;
            live += result.len();
            values[step.output] = Value::Owned(result);
            for &slot in &step.last_uses {
                live -= values[slot].owned();
                values[slot] = Value::None;
            }
        }
        let results = plan
            .outputs
            .iter()
            .zip(&plan.output_slots)
            .map(|(port, &slot)| {
                let value = values[slot].get().cloned().ok_or(RunError::Node {
                    node: port.name.clone(),
                    op_type: "output".to_owned(),
                    source: OpError::Input(0),
                })?;
                Ok((port.name.clone(), canonical(value)))
            });
        results.collect()
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
