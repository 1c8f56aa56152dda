//! The interface of a loaded network, whichever back end runs it.

use std::fmt;

use thiserror::Error;

use crate::{ElementType, OpError, Tensor};

/// Size of one dimension of a port.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Dim {
    /// A fixed size.
    Fixed(usize),
    /// Any size, but the same for every dimension of this name.
    Named(String),
    /// Any size.
    Any,
}

impl Dim {
    /// A dimension with a name.
    #[must_use]
    pub fn named(name: &str) -> Self {
        Self::Named(name.to_owned())
    }
}

impl fmt::Display for Dim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(size) => write!(f, "{size}"),
            Self::Named(name) => f.write_str(name),
            Self::Any => f.write_str("?"),
        }
    }
}

/// An input or output of a network.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Port {
    /// Name.
    pub name: String,
    /// Type of its elements.
    pub element_type: ElementType,
    /// Its dimensions; `None` if the file does not state their number.
    pub dims: Option<Vec<Dim>>,
}

/// `float32 [B, 64]`.
impl fmt::Display for Port {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ", self.element_type)?;
        match &self.dims {
            None => f.write_str("[…]"),
            Some(dims) => {
                let dims: Vec<_> = dims.iter().map(Dim::to_string).collect();
                write!(f, "[{}]", dims.join(", "))
            }
        }
    }
}

/// A loaded network.
pub trait Session: Send + Sync {
    /// The inputs that a run must be given.
    fn inputs(&self) -> &[Port];

    /// The outputs, in the order in which a run returns them.
    fn outputs(&self) -> &[Port];

    /// Runs the network once.
    ///
    /// # Errors
    /// [`RunError`] if the inputs are not those of [`inputs`](Self::inputs), or if an operator
    /// gets shapes that it cannot work on.
    fn run(&self, inputs: &[(&str, &Tensor)]) -> Result<Vec<(String, Tensor)>, RunError>;
}

impl<S: Session + ?Sized> Session for &S {
    fn inputs(&self) -> &[Port] {
        (**self).inputs()
    }

    fn outputs(&self) -> &[Port] {
        (**self).outputs()
    }

    fn run(&self, inputs: &[(&str, &Tensor)]) -> Result<Vec<(String, Tensor)>, RunError> {
        (**self).run(inputs)
    }
}

/// Why a run failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunError {
    /// An input was not given.
    #[error("input `{name}` ({port}) is missing")]
    MissingInput {
        /// Its name.
        name: String,
        /// The expected port.
        port: String,
    },
    /// A name that is not an input, or that was given twice.
    #[error("`{name}` is no input of this network, or was given twice; inputs: {inputs}")]
    UnknownInput {
        /// The name.
        name: String,
        /// The inputs that exist.
        inputs: String,
    },
    /// An input of another type or shape.
    #[error("input `{name}` is {found}, expected {expected}")]
    WrongInput {
        /// Its name.
        name: String,
        /// Type and shape given.
        found: String,
        /// Type and shape expected.
        expected: String,
    },
    /// An operator failed.
    #[error("node `{node}` ({op_type}): {source}")]
    Node {
        /// Name of the node, or of its output when it has none.
        node: String,
        /// Its operator.
        op_type: String,
        /// Why.
        source: OpError,
    },
    /// A value that the graph does not compute under this name.
    #[error("no step of the network computes a value `{name}`")]
    UnknownValue {
        /// The name.
        name: String,
    },
    /// An external back end failed.
    #[error("{backend}: {message}")]
    Backend {
        /// Which.
        backend: &'static str,
        /// Its message.
        message: String,
    },
}

/// Checks the inputs that a caller gives against the ports of a network.
///
/// # Errors
/// [`RunError`] names the first input that is missing, unknown, given twice, of another type or
/// of another shape. Sizes under the same name must agree.
pub fn check_inputs(ports: &[Port], given: &[(&str, &Tensor)]) -> Result<(), RunError> {
    for (position, (name, _)) in given.iter().enumerate() {
        let twice = given[..position].iter().any(|(other, _)| other == name);
        if twice || !ports.iter().any(|port| port.name == *name) {
            return Err(RunError::UnknownInput {
                name: (*name).to_owned(),
                inputs: names(ports),
            });
        }
    }
    let mut bound: Vec<(&str, usize)> = Vec::new();
    for port in ports {
        let Some((_, tensor)) = given.iter().find(|(name, _)| *name == port.name) else {
            return Err(RunError::MissingInput {
                name: port.name.clone(),
                port: port.to_string(),
            });
        };
        if !fits(port, tensor, &mut bound) {
            let sizes: Vec<_> = bound
                .iter()
                .map(|(name, size)| format!("{name} = {size}"))
                .collect();
            let known = if sizes.is_empty() {
                String::new()
            } else {
                format!(" with {}", sizes.join(", "))
            };
            return Err(RunError::WrongInput {
                name: port.name.clone(),
                found: format!(
                    "{} {:?} of {} elements",
                    tensor.element_type(),
                    tensor.shape(),
                    tensor.len()
                ),
                expected: format!("{port}{known}"),
            });
        }
    }
    Ok(())
}

fn names(ports: &[Port]) -> String {
    let names: Vec<_> = ports
        .iter()
        .map(|port| format!("`{}`", port.name))
        .collect();
    names.join(", ")
}

/// Returns true if a tensor fits a port. `bound` holds the sizes bound to names so far.
fn fits<'p>(port: &'p Port, tensor: &Tensor, bound: &mut Vec<(&'p str, usize)>) -> bool {
    if tensor.element_type() != port.element_type || !tensor.is_consistent() {
        return false;
    }
    let Some(dims) = &port.dims else { return true };
    dims.len() == tensor.shape().len()
        && dims
            .iter()
            .zip(tensor.shape())
            .all(|(dim, &size)| match dim {
                Dim::Any => true,
                Dim::Fixed(fixed) => *fixed == size,
                Dim::Named(name) => match bound.iter().find(|(other, _)| other == name) {
                    Some((_, known)) => *known == size,
                    None => {
                        bound.push((name, size));
                        true
                    }
                },
            })
}
