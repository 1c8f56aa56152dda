//! A column of a table: one latency a line.

use super::unit::{Head, Stated};
use super::{Counted, ForeignError, Latency, Unit};
use asperity_host::servo::Stage;

/// Reads a column. Empty cells are no latencies.
pub(super) fn of_column(
    text: &str,
    stage: Stage,
    column: Option<&str>,
    unit: Option<Unit>,
) -> Result<Counted, ForeignError> {
    let separator = separator(text);
    // Between the columns, a comma is no decimal one.
    let number = |cell: &str| number(cell, separator != b',');
    let mut rows = rows(text, separator);
    let (line, first) = rows.next().ok_or(ForeignError::Empty)??;
    let headless = first.iter().all(|cell| number(cell).is_some());
    let names: Vec<&str> = first.iter().map(String::as_str).collect();
    let heads: Vec<Head> = names.iter().map(|name| Head::of(name)).collect();
    let percentiles = ForeignError::NotRead {
        what: "a table of percentiles, which are no samples",
        remedy: "give the latencies themselves, or for a percentiles.csv the run.hlog beside it",
    };
    let is_table = |head: &Head| head.words == ["percentile"] || head.words == ["quantile"];
    if heads.iter().any(is_table) {
        return Err(percentiles);
    }
    let at = chosen(&names, &heads, stage, column)
        .ok_or_else(|| ForeignError::Column(names.join(", ")))?;
    if heads[at].is_percentile() {
        return Err(percentiles);
    }
    let stated = match &heads[at].unit {
        Stated::Time(stated) => Some(*stated),
        Stated::Nothing => unit,
        Stated::Other(unit) => {
            return Err(ForeignError::OtherUnit {
                head: names[at].to_owned(),
                unit: unit.clone(),
            });
        }
    };
    let mut counted = Counted::default();
    if stated.is_none() {
        counted.notes.push(
            "no unit is stated, so its latencies are read as µs; --unit states another".into(),
        );
    }
    let unit = stated.unwrap_or(Unit::Us);
    let counts_at = heads
        .iter()
        .position(Head::is_count)
        .filter(|counts| *counts != at);
    let (mut latencies, mut times) = (Vec::new(), Vec::new());
    let again = headless.then(|| Ok((line, first.clone())));
    for row in again.into_iter().chain(rows) {
        let (line, row) = row?;
        if row.len() > names.len() && row[names.len()..].iter().any(|cell| !cell.is_empty()) {
            let what = format!(
                "{} cells, but {} in the first line; write decimal points, or `;` between columns",
                row.len(),
                names.len()
            );
            return Err(ForeignError::Table { line, what });
        }
        let Some(cell) = row.get(at).filter(|cell| !cell.is_empty()) else {
            continue;
        };
        let latency = number(cell).and_then(|text| Latency::of(&text, unit));
        let latency = latency.ok_or_else(|| ForeignError::Cell {
            line,
            cell: cell.clone(),
        })?;
        latencies.push((line, latency.0, latency.ns(line)?));
        times.push(counts_at.and_then(|at| row.get(at)?.parse::<u64>().ok()));
    }
    let times = histogram(&latencies, &times);
    for (n, (_, _, ns)) in latencies.iter().enumerate() {
        counted.add(*ns, times.as_ref().map_or(1, |times| times[n]))?;
    }
    let vanished = latencies
        .iter()
        .filter(|(_, exact, ns)| *ns == 0 && *exact > 0.0)
        .count();
    if 2 * vanished > latencies.len() {
        return Err(ForeignError::TooShort(unit.symbol()));
    }
    Ok(counted)
}

/// How often each latency occurred, where the table is a histogram: its latencies ascend, and whole
/// numbers beside them count them, not the lines.
fn histogram(latencies: &[(usize, f64, u64)], times: &[Option<u64>]) -> Option<Vec<u64>> {
    let times: Vec<u64> = times.iter().copied().collect::<Option<_>>()?;
    let ascend = latencies.windows(2).all(|pair| pair[0].1 < pair[1].1);
    let are_lines = times
        .windows(2)
        .all(|pair| pair[0].checked_add(1) == Some(pair[1]));
    (ascend && !are_lines).then_some(times)
}

/// The column of latencies: by its whole name, by its words without the unit, by its first word.
fn chosen(names: &[&str], heads: &[Head], stage: Stage, column: Option<&str>) -> Option<usize> {
    if column.is_none() && names.len() == 1 {
        return Some(0);
    }
    let wanted = column.unwrap_or(stage.name());
    let only = |is: &dyn Fn(usize) -> bool| {
        let mut found = (0..names.len()).filter(|&at| is(at));
        found.next().filter(|_| found.next().is_none())
    };
    let words = Head::of(wanted).words;
    only(&|at| names[at] == wanted)
        .or_else(|| only(&|at| names[at].eq_ignore_ascii_case(wanted)))
        .or_else(|| only(&|at| !words.is_empty() && heads[at].words == words))
        .or_else(|| {
            only(&|at| {
                heads[at]
                    .words
                    .first()
                    .is_some_and(|first| words == [first.as_str()])
            })
        })
}

/// A number, with a point in the place of a decimal comma.
fn number(cell: &str, takes_comma: bool) -> Option<String> {
    let text = if takes_comma && cell.matches(',').count() == 1 {
        cell.replace(',', ".")
    } else {
        cell.to_owned()
    };
    text.parse::<f64>().is_ok().then_some(text)
}

/// What stands between the columns: a semicolon or a tab, if the first line of the table has one.
fn separator(text: &str) -> u8 {
    let is_comment = |line: &&str| line.trim().is_empty() || line.starts_with('#');
    let first = text
        .lines()
        .find(|line| !is_comment(line))
        .unwrap_or_default();
    let mut others = [b';', b'\t'].into_iter();
    others
        .find(|&one| first.contains(char::from(one)))
        .unwrap_or(b',')
}

/// The rows of a table with their lines, from 1.
fn rows(
    text: &str,
    separator: u8,
) -> impl Iterator<Item = Result<(usize, Vec<String>), ForeignError>> + '_ {
    let reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .delimiter(separator)
        .from_reader(text.as_bytes());
    reader.into_records().map(|record| match record {
        Ok(record) => {
            let line = record.position().map_or(0, csv::Position::line);
            Ok((line as usize, record.iter().map(str::to_owned).collect()))
        }
        Err(error) => {
            let line = error.position().map_or(0, csv::Position::line) as usize;
            Err(ForeignError::Table {
                line,
                what: error.to_string(),
            })
        }
    })
}
