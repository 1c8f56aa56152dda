//! The checked graph: names become slots, nodes become steps.

use std::collections::HashMap;

use bytes::Bytes;
use prost::Message as _;

use super::{
    constant::{self, Constant},
    fuse, ports,
    refusal::refusal,
    scan,
};
use crate::{
    ElementType, NodeRefusal, OnnxError, Port, Tensor,
    op::{self, Inputs, Operator, Types},
    proto::{GraphProto, ModelProto, NodeProto},
};

/// Oldest operator set that is read.
pub const MIN_OPSET: i64 = 13;
/// Newest operator set that is read.
pub const MAX_OPSET: i64 = 22;

/// Index of a value of the graph.
pub(crate) type Slot = usize;

/// A node, ready to run.
#[derive(Debug)]
pub(crate) struct Step {
    /// Name of the node, or of its output when it has none.
    pub(crate) name: String,
    pub(crate) op_type: String,
    pub(crate) operator: Box<dyn Operator>,
    pub(crate) inputs: Vec<Option<Slot>>,
    pub(crate) output: Slot,
    /// Values that no later step reads.
    pub(crate) last_uses: Vec<Slot>,
}

/// A checked graph.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) inputs: Vec<Port>,
    pub(crate) outputs: Vec<Port>,
    pub(crate) input_slots: Vec<Slot>,
    pub(crate) output_slots: Vec<Slot>,
    /// The value of each slot, if it does not depend on the inputs.
    pub(crate) constants: Vec<Option<Constant>>,
    pub(crate) steps: Vec<Step>,
    /// The slots of names.
    pub(crate) slots: HashMap<String, Slot>,
}

/// Reads and checks a model.
pub(crate) fn load(bytes: Bytes) -> Result<Plan, OnnxError> {
    scan::check(&bytes)?;
    let model = ModelProto::decode(bytes)?;
    let opset = opset(&model)?;
    let Some(graph) = model.graph else {
        return Err(refusal("graph", "missing".to_owned()));
    };
    if !graph.sparse_initializer.is_empty() {
        return Err(refusal(
            "graph.sparse_initializer",
            "not supported".to_owned(),
        ));
    }
    let mut builder = Builder::default();
    builder.add_initializers(&graph)?;
    builder.add_inputs(&graph)?;
    for node in &graph.node {
        builder.add_node(node, opset)?;
    }
    builder.finish(&graph)
}

fn opset(model: &ModelProto) -> Result<i64, OnnxError> {
    let standard = model
        .opset_import
        .iter()
        .find(|set| matches!(set.domain.as_str(), "" | "ai.onnx"))
        .and_then(|set| set.version);
    match standard {
        Some(version) if (MIN_OPSET..=MAX_OPSET).contains(&version) => Ok(version),
        Some(version) => Err(refusal(
            "opset_import",
            format!("operator set {version}, supported are {MIN_OPSET} to {MAX_OPSET}"),
        )),
        None => Err(refusal(
            "opset_import",
            "no standard operator set: not an ONNX model?".to_owned(),
        )),
    }
}

#[derive(Default)]
struct Builder {
    slots: HashMap<String, Slot>,
    types: Vec<ElementType>,
    constants: Vec<Option<Constant>>,
    inputs: Vec<Port>,
    input_slots: Vec<Slot>,
    steps: Vec<Step>,
}

impl Builder {
    /// A new slot, unless the name is taken or empty.
    fn slot(
        &mut self,
        name: &str,
        element_type: ElementType,
        value: Option<Constant>,
    ) -> Option<Slot> {
        if name.is_empty() || self.slots.contains_key(name) {
            return None;
        }
        let slot = self.types.len();
        self.slots.insert(name.to_owned(), slot);
        self.types.push(element_type);
        self.constants.push(value);
        Some(slot)
    }

    fn add_initializers(&mut self, graph: &GraphProto) -> Result<(), OnnxError> {
        for proto in &graph.initializer {
            let value = constant::read(proto).map_err(|error| error.of(&proto.name))?;
            if self
                .slot(&proto.name, value.element_type(), Some(value))
                .is_none()
            {
                return Err(OnnxError::Initializer {
                    name: proto.name.clone(),
                    field: "name",
                    reason: "empty, or given twice".to_owned(),
                });
            }
        }
        Ok(())
    }

    fn add_inputs(&mut self, graph: &GraphProto) -> Result<(), OnnxError> {
        for info in &graph.input {
            // Files before IR version 4 list their constants among the inputs.
            if graph
                .initializer
                .iter()
                .any(|proto| proto.name == info.name)
            {
                continue;
            }
            let port = ports::read("input", info)?;
            let Some(slot) = self.slot(&port.name, port.element_type, None) else {
                return Err(OnnxError::Port {
                    direction: "input",
                    name: port.name,
                    reason: "the name is empty, or given twice".to_owned(),
                });
            };
            self.inputs.push(port);
            self.input_slots.push(slot);
        }
        Ok(())
    }

    fn add_node(&mut self, node: &NodeProto, opset: i64) -> Result<(), OnnxError> {
        let step = self.step(node, opset).map_err(|reason| OnnxError::Node {
            node: node_name(node),
            op_type: node.op_type.clone(),
            reason,
        })?;
        self.steps.extend(step);
        Ok(())
    }

    /// The step of a node; `None` if its value is already known.
    fn step(&mut self, node: &NodeProto, opset: i64) -> Result<Option<Step>, NodeRefusal> {
        let operator = op::parse(node, opset)?;
        let wanted = node.output.iter().filter(|name| !name.is_empty()).count();
        let Some(output) = node.output.first().filter(|_| wanted == 1) else {
            return Err(NodeRefusal::Outputs(wanted));
        };
        let mut inputs = Vec::with_capacity(node.input.len());
        for (index, name) in node.input.iter().enumerate() {
            inputs.push(match self.slots.get(name) {
                Some(slot) => Some(*slot),
                None if name.is_empty() => None,
                None => {
                    return Err(NodeRefusal::UnknownInput {
                        index,
                        name: name.clone(),
                    });
                }
            });
        }
        let types: Vec<_> = inputs
            .iter()
            .map(|slot| slot.map(|slot| self.types[slot]))
            .collect();
        let element_type = operator.output_type(&Types(&types))?;
        let value = self.evaluate(&*operator, &inputs)?;
        let known = value.is_some();
        let Some(output) = self.slot(output, element_type, value.map(Constant::from)) else {
            return Err(NodeRefusal::DuplicateOutput(output.clone()));
        };
        let step = Step {
            name: node_name(node),
            op_type: node.op_type.clone(),
            operator,
            inputs,
            output,
            last_uses: Vec::new(),
        };
        Ok((!known).then_some(step))
    }

    /// The value of a node whose inputs are all known. Large values are not computed here, so that
    /// weights stay quantised.
    fn evaluate(
        &self,
        operator: &dyn Operator,
        inputs: &[Option<Slot>],
    ) -> Result<Option<Tensor>, NodeRefusal> {
        let known = |slot: &Option<Slot>| slot.is_none_or(|slot| self.constants[slot].is_some());
        if operator.as_dequantize().is_some() || !inputs.iter().all(known) {
            return Ok(None);
        }
        let values: Vec<_> = inputs
            .iter()
            .map(|slot| slot.and_then(|slot| self.constants[slot].as_ref()))
            .map(|constant| constant.map(Constant::tensor))
            .collect();
        let inputs = Inputs {
            values: &values,
            limit: op::LOAD_LIMIT,
        };
        match operator.run(&inputs) {
            Ok(value) => Ok(Some(value)),
            Err(crate::OpError::TooLarge { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    fn finish(mut self, graph: &GraphProto) -> Result<Plan, OnnxError> {
        let mut outputs = Vec::with_capacity(graph.output.len());
        let mut output_slots = Vec::with_capacity(graph.output.len());
        for info in &graph.output {
            let port = ports::read("output", info)?;
            let slot = self.slots.get(&port.name).copied();
            match slot {
                Some(slot) if self.types[slot] == port.element_type => output_slots.push(slot),
                _ => {
                    let reason = match slot {
                        None => "no node gives it".to_owned(),
                        Some(slot) => {
                            format!("is {}, declared {}", self.types[slot], port.element_type)
                        }
                    };
                    return Err(OnnxError::Port {
                        direction: "output",
                        name: port.name,
                        reason,
                    });
                }
            }
            outputs.push(port);
        }
        if outputs.is_empty() {
            return Err(refusal(
                "graph.output",
                "empty: nothing to compute".to_owned(),
            ));
        }
        fuse::constant_products(&mut self.steps, &self.constants);
        prune(&mut self.steps, &mut self.constants, &output_slots);
        Ok(Plan {
            inputs: self.inputs,
            outputs,
            input_slots: self.input_slots,
            output_slots,
            constants: self.constants,
            steps: self.steps,
            slots: self.slots,
        })
    }
}

fn node_name(node: &NodeProto) -> String {
    match (node.name.is_empty(), node.output.first()) {
        (true, Some(output)) => output.clone(),
        _ => node.name.clone(),
    }
}

/// Drops steps and constants that no output needs, and notes where each value is read last.
fn prune(steps: &mut Vec<Step>, constants: &mut [Option<Constant>], outputs: &[Slot]) {
    let mut needed = vec![false; constants.len()];
    for &slot in outputs {
        needed[slot] = true;
    }
    let mut used = needed.clone();
    for step in steps.iter_mut().rev() {
        if !used[step.output] {
            continue;
        }
        for &slot in step.inputs.iter().flatten() {
            used[slot] = true;
            // In reverse order, the first reader that is met is the last one.
            if !std::mem::replace(&mut needed[slot], true) {
                step.last_uses.push(slot);
            }
        }
    }
    steps.retain(|step| used[step.output]);
    for (value, used) in constants.iter_mut().zip(used) {
        if !used {
            *value = None;
        }
    }
}
