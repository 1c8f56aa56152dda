//! Instructions that a firmware bench counted.

use std::{collections::HashMap, io};

/// Instructions a tick, by factor and name of the design.
pub type CortexM = HashMap<(String, String), f64>;

/// Columns of the table.
const COLUMNS: [&str; 3] = ["factor", "name", "instructions"];

/// Reads a CSV table with the columns `factor,name,instructions`.
///
/// # Errors
/// The CSV parser's error for a file that is not such a table.
pub fn read(bytes: &[u8]) -> Result<CortexM, csv::Error> {
    let mut reader = csv::Reader::from_reader(bytes);
    if reader.headers()? != COLUMNS.as_slice() {
        let missing = format!("its columns are not {}", COLUMNS.join(","));
        return Err(io::Error::new(io::ErrorKind::InvalidData, missing).into());
    }
    reader
        .deserialize::<(String, String, f64)>()
        .map(|row| row.map(|(factor, name, count)| ((factor, name), count)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_its_three_columns_and_no_others() {
        let good = read(b"factor,name,instructions\norder,ar 20,2100\n").expect("a table");
        assert_eq!(good[&("order".into(), "ar 20".into())], 2100.0);
        for bad in [
            "",
            "factor,name\n",
            "order,ar 20,2100\n",
            "factor,name,instructions\na,b\n",
        ] {
            assert!(read(bad.as_bytes()).is_err(), "{bad:?}");
        }
    }
}
