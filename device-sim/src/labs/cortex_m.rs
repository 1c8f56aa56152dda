//! Instructions that a firmware bench counted.

use std::collections::HashMap;

/// Instructions a tick, by factor and name of the design.
pub type CortexM = HashMap<(String, String), f64>;

/// Reads a CSV table with the columns `factor,name,instructions`.
///
/// # Errors
/// The CSV parser's error for a file that is not such a table.
pub fn read(bytes: &[u8]) -> Result<CortexM, csv::Error> {
    let mut reader = csv::Reader::from_reader(bytes);
    reader
        .deserialize::<(String, String, f64)>()
        .map(|row| row.map(|(factor, name, count)| ((factor, name), count)))
        .collect()
}
