//! Running a network of the model, and distrusting what comes out.

use super::{files::wrong_file, inference::Backend};
use asperity_io::diagnostic::Fault;
use asperity_nn::{Session, Tensor};
use std::borrow::Cow;

/// Name, shape and numbers.
pub(super) type Input<'a> = (&'a str, &'a [usize], &'a [f32]);

/// A network, by the name of its file.
pub(super) struct Network {
    file: &'static str,
    session: Box<dyn Session>,
}

impl Network {
    /// Loads a network.
    ///
    /// # Errors
    /// [`Fault`] with its file.
    pub(super) fn load(
        file: &'static str,
        bytes: Cow<'static, [u8]>,
        backend: &Backend,
    ) -> Result<Self, Fault> {
        let session = backend.session(bytes);
        let session = session.map_err(|message| wrong_file(file, message))?;
        Ok(Self { file, session })
    }

    /// Runs the network on these inputs.
    ///
    /// # Errors
    /// [`Fault`] with its file.
    pub(super) fn run(&self, inputs: &[Input<'_>]) -> Result<Outputs, Fault> {
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
        let all = self.session.run(&inputs);
        Ok(Outputs {
            file: self.file,
            all: all.map_err(|error| wrong_file(self.file, error))?,
        })
    }
}

/// Outputs of a network.
pub(super) struct Outputs {
    file: &'static str,
    all: Vec<(String, Tensor)>,
}

impl Outputs {
    /// Returns true if there is an output of this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }

    /// The output of this name, which must be finite and of this length.
    ///
    /// # Errors
    /// [`Fault`] with its file.
    pub(super) fn take(&self, name: &str, length: usize) -> Result<Vec<f32>, Fault> {
        let fault = |what: String| wrong_file(self.file, what);
        match self.find(name) {
            Some(Tensor::F32 { data, .. }) if data.len() == length => {
                if data.iter().all(|x| x.is_finite()) {
                    Ok(data.clone())
                } else {
                    Err(fault(format!("output {name} is not finite")))
                }
            }
            Some(other) => Err(fault(format!(
                "output {name} has shape {:?}, {length} numbers wanted",
                other.shape()
            ))),
            None => Err(fault(format!("no output {name}"))),
        }
    }

    fn find(&self, name: &str) -> Option<&Tensor> {
        let mut all = self.all.iter();
        all.find(|(output, _)| output == name).map(|(_, t)| t)
    }
}
