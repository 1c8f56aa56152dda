//! Texts of other tools: percentile distributions, as HdrHistogram and wrk2 print them, and the
//! histograms of cyclictest and rtla.

use super::{Counted, ForeignError, Latency, Unit};

/// Lines before a percentile distribution, at most.
const MOST_BEFORE: usize = 200;
/// Title of wrk2's distribution, whose values are in ms.
const OF_WRK2: &str = "Detailed Percentile spectrum";

/// Cells between blanks, commas and quotes.
fn cells(line: &str) -> Vec<&str> {
    let between = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '"');
    line.split(between)
        .filter(|cell| !cell.is_empty())
        .collect()
}

/// The line, from 0, of the heads of a percentile distribution.
pub(super) fn spectrum_at(text: &str) -> Option<usize> {
    let is_head = |line: &str| cells(line).iter().take(2).eq(&["Value", "Percentile"]);
    text.lines().take(MOST_BEFORE).position(is_head)
}

/// The counts between the lines of a percentile distribution behind its heads in line `at`, each at
/// its upper end.
pub(super) fn of_spectrum(
    text: &str,
    at: usize,
    unit: Option<Unit>,
) -> Result<Counted, ForeignError> {
    let is_wrk2 = text.lines().take(at).any(|line| line.contains(OF_WRK2));
    let unit = if is_wrk2 {
        Unit::Ms
    } else {
        unit.unwrap_or(Unit::Us)
    };
    let mut counted = Counted::default();
    let (mut before, mut before_ns) = (0_u64, 0);
    for (index, line) in text.lines().enumerate().skip(at + 1) {
        let line = line.trim();
        if line.starts_with(['#', '[', '-']) && is_wrk2 {
            // A second distribution is that of latencies without the correction.
            break;
        }
        if line.is_empty() || line.starts_with(['#', '[']) {
            continue;
        }
        let cells = cells(line);
        let value = cells
            .first()
            .and_then(|cell| Latency::of(cell.parse().ok()?, unit));
        let total = cells.get(2).and_then(|cell| cell.parse::<u64>().ok());
        let (Some(value), Some(total)) = (value, total) else {
            return Err(ForeignError::Line(index + 1));
        };
        let ns = value.ns(index + 1)?;
        if total < before || ns < before_ns {
            return Err(ForeignError::Line(index + 1));
        }
        counted.add(ns, total - before)?;
        (before, before_ns) = (total, ns);
    }
    Ok(counted)
}

/// The histogram that `cyclictest -h` prints: a line for each latency with a column a thread.
pub(super) fn of_cyclictest(text: &str, unit: Option<Unit>) -> Result<Counted, ForeignError> {
    let unit = unit.unwrap_or(Unit::Us);
    let mut rows: Vec<(usize, Vec<u64>)> = Vec::new();
    let (mut beyond, mut largest) = (Vec::new(), Vec::new());
    for (index, line) in text.lines().enumerate() {
        let after = |name: &str| line.strip_prefix(name).map(numbers);
        if let Some(cells) = after("# Histogram Overflows:") {
            beyond = cells.ok_or(ForeignError::Line(index + 1))?;
        } else if let Some(cells) = after("# Max Latencies:") {
            largest = cells.ok_or(ForeignError::Line(index + 1))?;
        } else if line.starts_with(|c: char| c.is_ascii_digit()) {
            let cells = numbers(line).filter(|cells| cells.len() > 1);
            rows.push((index + 1, cells.ok_or(ForeignError::Line(index + 1))?));
        }
    }
    // `cyclictest -H` appends the sum of all threads.
    let is_sum = |(_, cells): &(usize, Vec<u64>)| match &cells[1..] {
        [threads @ .., sum] => {
            threads.len() > 1
                && threads.iter().map(|&n| u128::from(n)).sum::<u128>() == u128::from(*sum)
        }
        [] => false,
    };
    let threads = if rows.iter().all(is_sum) { 1 } else { 0 };
    let mut counted = Counted::default();
    for (line, cells) in &rows {
        for count in &cells[1..cells.len() - threads] {
            counted.add(Latency(cells[0] as f64 * unit.ns()).ns(*line)?, *count)?;
        }
    }
    beyond.truncate(beyond.len().saturating_sub(threads));
    let largest = largest
        .into_iter()
        .max()
        .map(|value| Latency(value as f64 * unit.ns()).ns(0));
    counted.beyond(&beyond, largest.transpose()?)?;
    Ok(counted)
}

fn numbers(cells: &str) -> Option<Vec<u64>> {
    cells
        .split_whitespace()
        .map(|cell| cell.parse().ok())
        .collect()
}

/// The histogram of `rtla timerlat hist`: of its columns, the latencies of the threads.
pub(super) fn of_rtla(text: &str) -> Result<Counted, ForeignError> {
    let mut unit = Unit::Us;
    let mut threads: Vec<usize> = Vec::new();
    let mut counted = Counted::default();
    let mut beyond = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line_number = index + 1;
        if let Some(stated) = line.strip_prefix("# Time unit is ") {
            let word = stated.split_whitespace().next().unwrap_or_default();
            unit = word.parse().map_err(|_| ForeignError::Line(line_number))?;
        }
        let cells: Vec<&str> = line.split_whitespace().collect();
        let Some((&first, _)) = cells.split_first().filter(|_| !line.starts_with('#')) else {
            continue;
        };
        let of_threads = || -> Result<Vec<u64>, ForeignError> {
            let cells = threads.iter().map(|&at| match cells.get(at) {
                // A processor without a sample.
                Some(&"-") => Some(0),
                cell => cell?.parse().ok(),
            });
            cells
                .collect::<Option<_>>()
                .ok_or(ForeignError::Line(line_number))
        };
        match first {
            "Index" => {
                threads = (0..cells.len())
                    .filter(|&at| cells[at].starts_with("Thr-"))
                    .collect();
                if threads.is_empty() {
                    return Err(ForeignError::NotRead {
                        what: "a histogram of rtla without latencies of threads (Thr-000)",
                        remedy: "measure again with `rtla timerlat hist`, without --no-thread",
                    });
                }
            }
            "over:" => beyond = of_threads()?,
            "max:" => {
                let largest = of_threads()?.into_iter().max().unwrap_or(0);
                counted.beyond(
                    &beyond,
                    Some(Latency(largest as f64 * unit.ns()).ns(line_number)?),
                )?;
                // What follows sums all processors up.
                break;
            }
            _ => {
                let Ok(value) = first.parse::<u64>() else {
                    continue;
                };
                for count in of_threads()? {
                    counted.add(Latency(value as f64 * unit.ns()).ns(line_number)?, count)?;
                }
            }
        }
    }
    Ok(counted)
}
