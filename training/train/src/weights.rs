//! Named matrices as safetensors.

use crate::{
    attribute_regression::AttributeRegression, kernel_ridge::KernelRidge, parameters::Parameter,
    trained::Trained,
};
use asperity::learned::description::LATENT;
use safetensors::{Dtype, SafeTensors, View};
use std::{borrow::Cow, collections::HashMap};

/// Key of the one entry of a file's metadata.
const NOTE: &str = "asperity";

/// A matrix on its way into a file.
pub(crate) struct Table {
    dtype: Dtype,
    shape: [usize; 2],
    bytes: Vec<u8>,
}

impl Table {
    /// Rows of `columns` numbers.
    pub(crate) fn new(values: &[f32], columns: usize) -> Self {
        Self {
            dtype: Dtype::F32,
            shape: [values.len() / columns.max(1), columns],
            bytes: values.iter().flat_map(|x| x.to_le_bytes()).collect(),
        }
    }

    /// Rows of `columns` codes.
    fn codes(codes: &[i8], columns: usize) -> Self {
        Self {
            dtype: Dtype::I8,
            shape: [codes.len() / columns.max(1), columns],
            bytes: codes.iter().map(|&code| code as u8).collect(),
        }
    }
}

impl View for &Table {
    fn dtype(&self) -> Dtype {
        self.dtype
    }
    fn shape(&self) -> &[usize] {
        &self.shape
    }
    fn data(&self) -> Cow<'_, [u8]> {
        Cow::Borrowed(&self.bytes)
    }
    fn data_len(&self) -> usize {
        self.bytes.len()
    }
}

/// The bytes of a file of named tables with a note.
pub(crate) fn write(tables: &[(String, Table)], note: &str) -> Result<Vec<u8>, String> {
    let views = tables.iter().map(|(name, table)| (name.as_str(), table));
    let metadata = HashMap::from([(NOTE.to_owned(), note.to_owned())]);
    safetensors::serialize(views, Some(metadata)).map_err(|e| e.to_string())
}

/// The note of a file of named tables.
pub(crate) fn note(bytes: &[u8]) -> Result<String, String> {
    let (_, metadata) = SafeTensors::read_metadata(bytes).map_err(|e| e.to_string())?;
    let note = metadata.metadata().as_ref().and_then(|m| m.get(NOTE));
    note.cloned()
        .ok_or_else(|| "not written by asperity-train".into())
}

/// A table of a file, which must have this many numbers.
pub(crate) fn table(bytes: &[u8], name: &str, count: usize) -> Result<Vec<f32>, String> {
    let file = SafeTensors::deserialize(bytes).map_err(|e| e.to_string())?;
    let view = file.tensor(name).map_err(|e| e.to_string())?;
    let (numbers, _) = view.data().as_chunks::<4>();
    if view.dtype() != Dtype::F32 || numbers.len() != count {
        return Err(format!("{name}: not {count} numbers in 32 bits"));
    }
    Ok(numbers.iter().map(|x| f32::from_le_bytes(*x)).collect())
}

/// `weights.safetensors` of a model: parameters as the optimiser left them, the examples of its
/// memory, and the statistics of the normaliser.
pub(crate) fn model(trained: &Trained) -> Result<Vec<u8>, String> {
    let table = |p: &Parameter| (p.name.clone(), Table::new(&p.values, p.columns));
    let own = trained.parameters.iter().map(table);
    let normaliser = &trained.normaliser;
    let statistics = [
        ("ar_mean", &normaliser.ar_mean),
        ("ar_deviation", &normaliser.ar_deviation),
        ("tap_mean", &normaliser.tap_mean),
        ("tap_deviation", &normaliser.tap_deviation),
        ("tap_bound", &normaliser.tap_bound),
    ]
    .map(|(name, values)| {
        (
            format!("normaliser.{name}"),
            Table::new(values, values.len()),
        )
    });
    let (low, high) = normaliser.excitation_bounds;
    let bounds = (
        "normaliser.excitation_bounds".to_owned(),
        Table::new(&[low, high], 2),
    );
    let memory = trained.memory.iter().flat_map(memory);
    let feel = trained.feel.iter().flat_map(feel);
    let all = own.chain(memory).chain(feel).chain(statistics);
    let tables: Vec<_> = all.chain([bounds]).collect();
    write(&tables, "weights; matrices are inputs × outputs")
}

fn memory(memory: &KernelRidge) -> [(String, Table); 7] {
    let column = |values: &[f32]| Table::new(values, 1);
    [
        ("basis", Table::new(&memory.basis, memory.kept)),
        ("codes", Table::codes(&memory.codes, memory.kept)),
        ("scales", column(&memory.scales)),
        ("coefficients", Table::codes(&memory.coefficients, LATENT)),
        (
            "coefficient_scales",
            Table::new(&memory.coefficient_scales, LATENT),
        ),
        ("mean", Table::new(&memory.mean, LATENT)),
        ("concentration", column(&[memory.concentration])),
    ]
    .map(|(name, table)| (format!("memory.{name}"), table))
}

fn feel(feel: &AttributeRegression) -> [(String, Table); 4] {
    [
        ("coefficients", feel.coefficients.as_flattened()),
        ("materials", feel.materials.as_flattened()),
        ("mean", feel.mean.as_slice()),
        ("concentration", &[feel.concentration]),
    ]
    .map(|(name, values)| {
        let columns = values.len().min(feel.mean.len());
        (format!("feel.{name}"), Table::new(values, columns))
    })
}
