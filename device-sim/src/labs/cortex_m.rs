//! Instructions that a firmware bench counted.

use std::collections::HashMap;

/// Counts of a firmware bench: instructions a tick by factor and name of the design.
pub type CortexM = HashMap<(String, String), f64>;

/// Reads `factor,name,instructions`.
///
/// # Errors
/// The parser's for a file that is no such table.
pub fn read(bytes: &[u8]) -> Result<CortexM, csv::Error> {
    let mut reader = csv::Reader::from_reader(bytes);
    reader
        .deserialize::<(String, String, f64)>()
        .map(|row| row.map(|(factor, name, count)| ((factor, name), count)))
        .collect()
}
