//! Tables in text, as [`asperity_io::table`] reads them.

use super::{EachRow, Header, Remark};
use crate::{
    description::is_unit,
    file,
    remedy::{self, unreadable},
};
use asperity_io::{
    diagnostic::Fault,
    table::{Table, TableError, TableProblem},
};
use std::{fs::File, path::Path};

fn open(path: &Path) -> Result<Table<File>, Fault> {
    Table::open(file::open(path)?, &is_unit).map_err(|error| fault(path, error))
}

fn fault(path: &Path, error: TableError) -> Fault {
    let fault = match error.problem {
        TableProblem::Unreadable(error) => unreadable(path)(error),
        TableProblem::Damaged { what, remedy } => Fault::new(what, remedy),
        other => Fault::new(other, remedy::FORMAT),
    };
    fault.at(path).line(error.line)
}

pub(super) fn header(path: &Path) -> Result<Header, Fault> {
    let mut table = open(path)?;
    let layout = table.layout().clone();
    // A fault of a row is for the reader of the rows to tell.
    let row = table.next_row().ok().flatten();
    let texts = (0..layout.columns.len()).map(|column| {
        let text = row.as_ref().filter(|_| layout.is_text(column));
        text.map_or_else(String::new, |row| row.text(column).into_owned())
    });
    Ok(Header {
        texts: texts.collect(),
        columns: layout.columns,
        line: layout.header,
        units: layout.units,
        groups: layout.groups,
        named: true,
        ..Header::default()
    })
}

/// Rows, with NaN for what is no number in a column that is not `wanted`. A last row that is not whole is
/// left out with a remark.
pub(super) fn rows(
    path: &Path,
    wanted: &[usize],
    each: &mut EachRow<'_>,
) -> Result<Option<Remark>, Fault> {
    let mut table = open(path)?;
    let columns = table.layout().columns.clone();
    let width = columns.len();
    let is_wanted: Vec<bool> = (0..width).map(|column| wanted.contains(&column)).collect();
    let mut values = vec![f64::NAN; width];
    while let Some(row) = table.next_row().map_err(|error| fault(path, error))? {
        for (column, value) in values.iter_mut().enumerate() {
            *value = match row.number(column) {
                Some(number) => number,
                None if !is_wanted[column] => f64::NAN,
                None => {
                    let value: String = row.text(column).chars().take(40).collect();
                    let what = format!(
                        "column {:?} holds {value:?}, which is no number",
                        columns[column]
                    );
                    let remedy =
                        "write numbers with a point; leave a missing value empty or write NaN";
                    return Err(Fault::new(what, remedy).at(path).line(row.line));
                }
            };
        }
        if !each(row.line, &values)? {
            return Ok(None);
        }
    }
    Ok(table.cut().map(|(line, values)| Remark {
        what: format!(
            "is cut: its last row, line {line}, has {values} values of {width}; the rows before are used"
        ),
        remedy: "stop the logger before the file is copied, or remove this row",
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(content: &str, wanted: &[usize]) -> Result<(Vec<Vec<f64>>, Option<Remark>), Fault> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.csv");
        std::fs::write(&path, content).expect("written");
        let mut all = Vec::new();
        let remark = rows(&path, wanted, &mut |_, row| {
            all.push(row.to_vec());
            Ok(true)
        })?;
        Ok((all, remark))
    }

    #[test]
    fn text_matters_in_the_columns_that_are_asked_for() {
        let table = "t,label\n0,stroke\n1,air\n";
        let (all, _) = read(table, &[0]).expect("read");
        assert_eq!((all.len(), all[1][0]), (2, 1.0));
        let error = read(table, &[0, 1]).expect_err("asked for");
        assert!(
            error
                .to_string()
                .contains("a.csv:2: column \"label\" holds \"stroke\""),
            "{error}"
        );
    }

    #[test]
    fn the_last_row_alone_may_be_cut() {
        let (all, remark) = read("# c\nt,x\n0,1,\n1,2\n2", &[0, 1]).expect("read");
        assert_eq!(all.len(), 2);
        assert!(remark.expect("told").what.contains("line 5"));
        let error = read("t,x\n0,1\n1\n2,3\n", &[0, 1]).expect_err("not the last");
        assert!(
            error
                .to_string()
                .contains("a.csv:3: has 1 values where the header has 2"),
            "{error}"
        );
    }
}
