//! A column of a table: one latency a line.

use super::unit::{Head, StatedUnit};
use super::{Counted, ForeignError, Latency, Unit};
use asperity_host::servo::Stage;
use asperity_io::table::{Layout, Table, number, seconds};

const PERCENTILES: ForeignError = ForeignError::NotRead {
    what: "a table of percentiles, which are no samples",
    remedy: "give the latencies themselves, or for a percentiles.csv the run.hlog beside it",
};

/// Entries of a row of units for columns that are not times.
const OF_OTHERS: [&str; 12] = [
    "-", "#", "1", "%", "N", "V", "A", "g", "m", "mm", "Hz", "m/s^2",
];

/// Reads a column. Missing values are no latencies.
pub(super) fn of_column(
    text: &str,
    stage: Stage,
    column: Option<&str>,
    unit: Option<Unit>,
) -> Result<Counted, ForeignError> {
    if let Some(numbers) = without_head(text) {
        return of_numbers(numbers, unit);
    }
    let is_unit = |field: &str| unit_below(field).is_some() || OF_OTHERS.contains(&field);
    let mut table = Table::open(text.as_bytes(), &is_unit)?;
    let layout = table.layout().clone();
    let heads: Vec<Head> = layout.columns.iter().map(|name| Head::of(name)).collect();
    if heads.iter().any(Head::is_list_of_percentiles) {
        return Err(PERCENTILES);
    }
    let at = chosen(&layout.columns, &heads, stage, column)
        .ok_or_else(|| ForeignError::Column(layout.columns.join(", ")))?;
    if heads[at].is_percentile() {
        return Err(PERCENTILES);
    }
    let stated = stated(&layout, &heads[at], at)?.or(unit);
    let unit = stated.unwrap_or(Unit::Us);
    let counts_at = heads
        .iter()
        .position(Head::is_count)
        .filter(|counts| *counts != at);
    let (mut latencies, mut times) = (Vec::new(), Vec::new());
    while let Some(row) = table.next_row()? {
        let (line, cell) = (row.line as usize, row.text(at));
        let latency = match number(&cell, layout.decimal_comma) {
            Some(missing) if missing.is_nan() => continue,
            Some(value) => Latency::of(value, unit),
            // A time of day is no latency.
            None => seconds(&cell)
                .filter(|_| !cell.contains(':'))
                .and_then(|value| Latency::of(value, Unit::S)),
        };
        let cell = || ForeignError::Cell {
            line,
            cell: cell.clone().into_owned(),
        };
        let latency = latency.ok_or_else(cell)?;
        latencies.push((line, latency));
        times.push(counts_at.and_then(|at| row.text(at).parse::<u64>().ok()));
    }
    let mut counted = counted(&latencies, histogram(&latencies, &times), unit)?;
    counted.note_unit(stated);
    if let Some((line, _)) = table.cut() {
        counted.notes.push(format!(
            "its last line, {line}, is not whole and was left out"
        ));
    }
    Ok(counted)
}

/// Lines of one number each, where the first is one.
fn without_head(text: &str) -> Option<impl Iterator<Item = (usize, &str)>> {
    let lines = (1..).zip(text.lines().map(str::trim));
    let mut lines = lines
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
        .peekable();
    lines.peek()?.1.parse::<f64>().ok()?;
    Some(lines)
}

fn of_numbers<'t>(
    numbers: impl Iterator<Item = (usize, &'t str)>,
    unit: Option<Unit>,
) -> Result<Counted, ForeignError> {
    let in_unit = unit.unwrap_or(Unit::Us);
    let latencies = numbers.map(|(line, cell)| {
        let latency = cell
            .parse()
            .ok()
            .and_then(|value| Latency::of(value, in_unit));
        let cell = || ForeignError::Cell {
            line,
            cell: cell.to_owned(),
        };
        Ok((line, latency.ok_or_else(cell)?))
    });
    let latencies: Vec<_> = latencies.collect::<Result<_, ForeignError>>()?;
    let mut counted = counted(&latencies, None, in_unit)?;
    counted.note_unit(unit);
    Ok(counted)
}

fn counted(
    latencies: &[(usize, Latency)],
    times: Option<Vec<u64>>,
    unit: Unit,
) -> Result<Counted, ForeignError> {
    let mut counted = Counted::default();
    let mut vanished = 0;
    for (n, (line, latency)) in latencies.iter().enumerate() {
        let ns = latency.ns(*line)?;
        vanished += usize::from(ns == 0 && latency.0 > 0.0);
        counted.add(ns, times.as_ref().map_or(1, |times| times[n]))?;
    }
    if 2 * vanished > latencies.len() {
        return Err(ForeignError::TooShort(unit.symbol()));
    }
    Ok(counted)
}

/// The unit that a column states in its head, or in the row below the heads.
fn stated(layout: &Layout, head: &Head, at: usize) -> Result<Option<Unit>, ForeignError> {
    let below = layout.units.get(at).map(String::as_str).unwrap_or_default();
    match &head.unit {
        StatedUnit::Time(unit) => Ok(Some(*unit)),
        StatedUnit::Nothing => Ok(unit_below(below)),
        StatedUnit::Other(unit) => Err(ForeignError::OtherUnit {
            head: layout.columns[at].clone(),
            unit: unit.clone(),
        }),
    }
}

/// A unit of time in a row of units, as `us` or `(us)`.
fn unit_below(field: &str) -> Option<Unit> {
    let is_bracket = |c: char| matches!(c, '(' | ')' | '[' | ']') || c.is_whitespace();
    field.trim_matches(is_bracket).parse().ok()
}

/// Returns the count of each latency if the table is a histogram: ascending latencies, with whole numbers beside them
/// that are not line numbers.
fn histogram(latencies: &[(usize, Latency)], times: &[Option<u64>]) -> Option<Vec<u64>> {
    let times: Vec<u64> = times.iter().copied().collect::<Option<_>>()?;
    let ascend = latencies.windows(2).all(|pair| pair[0].1.0 < pair[1].1.0);
    let are_lines = times
        .windows(2)
        .all(|pair| pair[0].checked_add(1) == Some(pair[1]));
    (ascend && !are_lines).then_some(times)
}

/// The column of latencies: by its whole name, by its words without the unit, by its first word.
fn chosen(names: &[String], heads: &[Head], stage: Stage, column: Option<&str>) -> Option<usize> {
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
