//! A network on ONNX Runtime.

use std::{
    path::Path,
    sync::{Mutex, OnceLock, PoisonError},
};

use crate::{
    discover::{Discovery, NotFound, find},
    error::LoadError,
};
use asperity_nn::{Bytes, Dim, ElementType, Port, RunError, Session, Tensor, check_inputs};
use ort::{
    session::{
        SessionInputValue,
        builder::{GraphOptimizationLevel, SessionBuilder},
    },
    value::{DynValue, Outlet, Tensor as OrtTensor, TensorElementType, TensorRef, ValueType},
};

const BACKEND: &str = "ONNX Runtime";

/// A network that ONNX Runtime runs.
#[derive(Debug)]
pub struct OnnxRuntime {
    // `ort` asks for exclusive access to run.
    session: Mutex<ort::session::Session>,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
}

impl OnnxRuntime {
    /// Loads a model that runs on one thread.
    ///
    /// # Errors
    /// [`LoadError`] if there is no library, or if it refuses the model.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, LoadError> {
        Self::with_threads(bytes, 1)
    }

    /// Loads a model that runs on `threads` threads.
    ///
    /// # Errors
    /// As [`from_bytes`](Self::from_bytes).
    pub fn with_threads(bytes: &[u8], threads: usize) -> Result<Self, LoadError> {
        library()?;
        // Level 1: higher ones fuse int8 weights into kernels that drift from the model.
        let session = builder(GraphOptimizationLevel::Level1, threads)
            .and_then(|mut builder| builder.commit_from_memory(bytes))
            .map_err(|error| LoadError::Model(error.to_string()))?;
        Self::new(session)
    }

    /// Loads a large model in floats from its file, which may have its weights in others beside
    /// it. It runs on `threads` threads with every optimisation.
    ///
    /// # Errors
    /// As [`from_bytes`](Self::from_bytes).
    pub fn from_file(file: &Path, threads: usize) -> Result<Self, LoadError> {
        library()?;
        let session = builder(GraphOptimizationLevel::Level3, threads)
            .and_then(|mut builder| builder.commit_from_file(file))
            .map_err(|error| LoadError::Model(error.to_string()))?;
        Self::new(session)
    }

    fn new(session: ort::session::Session) -> Result<Self, LoadError> {
        let inputs = ports("input", session.inputs())?;
        let outputs = ports("output", session.outputs())?;
        Ok(Self {
            session: Mutex::new(session),
            inputs,
            outputs,
        })
    }

    /// The library that this process uses. It is loaded at the first call.
    ///
    /// # Errors
    /// [`NotFound`] lists what was tried.
    pub fn library() -> Result<&'static Discovery, NotFound> {
        library()
    }
}

/// Finds the library once and passes it to `ort`. A search without success may be repeated.
fn library() -> Result<&'static Discovery, NotFound> {
    static LIBRARY: OnceLock<Discovery> = OnceLock::new();
    static SEARCH: Mutex<()> = Mutex::new(());
    let _searching = SEARCH.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(discovery) = LIBRARY.get() {
        return Ok(discovery);
    }
    let (discovery, opened) = find()?;
    opened.install();
    ort::init()
        .with_name("asperity")
        .with_telemetry(false)
        .commit();
    Ok(LIBRARY.get_or_init(|| discovery))
}

fn builder(level: GraphOptimizationLevel, threads: usize) -> Result<SessionBuilder, ort::Error> {
    let builder = ort::session::Session::builder()?;
    let builder = builder.with_optimization_level(level)?;
    let builder = builder.with_intra_threads(threads.max(1))?;
    Ok(builder.with_inter_threads(1)?)
}

impl Session for OnnxRuntime {
    fn inputs(&self) -> &[Port] {
        &self.inputs
    }

    fn outputs(&self) -> &[Port] {
        &self.outputs
    }

    fn run(&self, inputs: &[(&str, &Tensor)]) -> Result<Vec<(String, Tensor)>, RunError> {
        check_inputs(&self.inputs, inputs)?;
        let failed = |error: ort::Error| RunError::Backend {
            backend: BACKEND,
            message: error.to_string(),
        };
        let values = inputs
            .iter()
            .map(|(name, tensor)| Ok(((*name).to_owned(), value(tensor)?)))
            .collect::<Result<Vec<_>, ort::Error>>()
            .map_err(failed)?;
        let mut session = self.session.lock().unwrap_or_else(PoisonError::into_inner);
        let results = session.run(values).map_err(failed)?;
        let mut outputs = Vec::with_capacity(self.outputs.len());
        for port in &self.outputs {
            let result = results.get(&port.name).ok_or_else(|| RunError::Backend {
                backend: BACKEND,
                message: format!("gives no output `{}`", port.name),
            })?;
            outputs.push((port.name.clone(), tensor(port, result).map_err(failed)?));
        }
        Ok(outputs)
    }
}

/// A tensor as `ort` takes it, borrowed where the types allow.
fn value(tensor: &Tensor) -> Result<SessionInputValue<'_>, ort::Error> {
    let shape = tensor.shape().to_vec();
    Ok(match tensor {
        Tensor::F32 { data, .. } => TensorRef::from_array_view((shape, &data[..]))?.into(),
        Tensor::I64 { data, .. } => TensorRef::from_array_view((shape, &data[..]))?.into(),
        Tensor::I32 { data, .. } => TensorRef::from_array_view((shape, &data[..]))?.into(),
        Tensor::Bool { data, .. } => TensorRef::from_array_view((shape, &data[..]))?.into(),
        Tensor::U8 { data, .. } => TensorRef::from_array_view((shape, &data[..]))?.into(),
        Tensor::I8 { data, .. } => {
            let data: Vec<i8> = data.iter().map(|&byte| byte as i8).collect();
            OrtTensor::from_array((shape, data))?.into()
        }
        other => {
            let message = format!("no tensor of {} on this back end", other.element_type());
            return Err(ort::Error::new(message));
        }
    })
}

/// A result, copied out.
fn tensor(port: &Port, value: &DynValue) -> Result<Tensor, ort::Error> {
    fn elements<T: ort::value::PrimitiveTensorElementType + Clone>(
        value: &DynValue,
    ) -> Result<(Vec<usize>, Vec<T>), ort::Error> {
        let (shape, data) = value.try_extract_tensor::<T>()?;
        Ok((
            shape
                .iter()
                .map(|&size| size.unsigned_abs() as usize)
                .collect(),
            data.to_vec(),
        ))
    }
    Ok(match port.element_type {
        ElementType::F32 => elements(value).map(|(shape, data)| Tensor::F32 { shape, data })?,
        ElementType::I64 => elements(value).map(|(shape, data)| Tensor::I64 { shape, data })?,
        ElementType::I32 => elements(value).map(|(shape, data)| Tensor::I32 { shape, data })?,
        ElementType::Bool => elements(value).map(|(shape, data)| Tensor::Bool { shape, data })?,
        ElementType::U8 => {
            let (shape, data) = elements::<u8>(value)?;
            Tensor::U8 {
                shape,
                data: data.into(),
            }
        }
        ElementType::I8 => {
            let (shape, data) = elements::<i8>(value)?;
            let data: Bytes = data.into_iter().map(|x| x as u8).collect();
            Tensor::I8 { shape, data }
        }
        other => {
            return Err(ort::Error::new(format!(
                "no tensor of {other} on this back end"
            )));
        }
    })
}

fn ports(direction: &'static str, outlets: &[Outlet]) -> Result<Vec<Port>, LoadError> {
    outlets
        .iter()
        .map(|outlet| port(direction, outlet))
        .collect()
}

fn port(direction: &'static str, outlet: &Outlet) -> Result<Port, LoadError> {
    let refusal = || LoadError::Port {
        direction,
        name: outlet.name().to_owned(),
        found: outlet.dtype().to_string(),
    };
    let ValueType::Tensor {
        ty,
        shape,
        dimension_symbols,
    } = outlet.dtype()
    else {
        return Err(refusal());
    };
    let element_type = match ty {
        TensorElementType::Float32 => ElementType::F32,
        TensorElementType::Int64 => ElementType::I64,
        TensorElementType::Int32 => ElementType::I32,
        TensorElementType::Int8 => ElementType::I8,
        TensorElementType::Uint8 => ElementType::U8,
        TensorElementType::Bool => ElementType::Bool,
        _ => return Err(refusal()),
    };
    let dims = shape
        .iter()
        .enumerate()
        .map(|(axis, &size)| match usize::try_from(size) {
            Ok(size) => Dim::Fixed(size),
            Err(_) => match dimension_symbols.get(axis) {
                Some(name) if !name.is_empty() => Dim::Named(name.clone()),
                _ => Dim::Any,
            },
        });
    Ok(Port {
        name: outlet.name().to_owned(),
        element_type,
        dims: Some(dims.collect()),
    })
}
