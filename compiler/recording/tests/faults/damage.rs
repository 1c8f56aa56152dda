//! Ways to damage a recording.

use super::{
    kinds::{Expected, of_channels, of_file},
    take::{Column, Format, Random, Take},
};
use std::fs;

/// Writes a clock in another unit than its description states.
pub(super) fn clock(
    random: &mut Random,
    take: &mut Take,
    unit: &'static str,
    written: f64,
) -> Expected {
    let file = random.below(take.files.len());
    let file = &mut take.files[file];
    (file.clock_unit, file.clock_written) = (unit, written);
    of_file(file.name, &["the clock", "by a factor of 1000"])
}

/// Rows that never arrive.
pub(super) fn lose(random: &mut Random, take: &mut Take, file: usize, length_s: f64) {
    let file = &mut take.files[file];
    let rows = (length_s * file.rate_hz) as usize;
    let start = 50 + random.below(file.stamps.len() - rows - 100);
    file.stamps.drain(start..start + rows);
    for column in &mut file.columns {
        column.values.drain(start..start + rows);
    }
}

/// Cuts a signal off at a part of its reach around its mean, above or on both sides.
pub(super) fn clip(values: &mut [f64], part: f64, both: bool) {
    let middle = values.iter().sum::<f64>() / values.len() as f64;
    let reach = values
        .iter()
        .map(|x| (x - middle).abs())
        .fold(0.0, f64::max);
    let low = if both {
        middle - part * reach
    } else {
        f64::NEG_INFINITY
    };
    values
        .iter_mut()
        .for_each(|x| *x = x.clamp(low, middle + part * reach));
}

pub(super) fn spike(random: &mut Random, column: &mut Column, least: f64, most: f64) {
    for _ in 0..1 + random.below(4) {
        let at = 10 + random.below(column.values.len() - 20);
        column.values[at] += random.within(least, most) * random.pick(&[-1.0, 1.0]);
    }
}

/// A quantity is written otherwise than its description says.
pub(super) fn unit(
    take: &mut Take,
    quantity: &'static str,
    unit: &'static str,
    written: f64,
    word: &str,
) -> Expected {
    let file = take.file(quantity);
    let columns = file
        .columns
        .iter_mut()
        .filter(|column| column.quantity == quantity);
    for column in columns {
        (column.unit, column.written) = (unit, written);
    }
    if let Format::Wav(bits, _) = &mut file.format {
        *bits = (*bits).max(24);
    }
    of_channels(file.name, &[quantity], &["wrong unit", word])
}

/// Edits the lines of a CSV; gives a word that must be said, and the line that it must be said of, or 0.
pub(super) fn edit(
    random: &mut Random,
    take: &mut Take,
    change: fn(&mut Random, &mut Vec<String>) -> (String, usize),
) -> Expected {
    let name = take.files[random.below(take.files.len())].name;
    let seed = (random.unit() * 1e9) as u64;
    // The rows are known before they are written.
    let folder = tempfile::tempdir().expect("a folder");
    let files = take.files.clone();
    let layout = take.layout;
    Take {
        layout,
        files,
        after: Vec::new(),
    }
    .write(folder.path());
    let text = fs::read_to_string(folder.path().join(name)).expect("written");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let (word, line) = change(&mut Random(seed), &mut lines);
    let has_end = !word.contains("cut");
    take.after.push(Box::new(move |folder| {
        let text = lines.join("\n") + if has_end { "\n" } else { "" };
        let parts: Vec<&[u8]> = text.split('\u{fffd}').map(str::as_bytes).collect();
        fs::write(folder.join(name), parts.join(&0xff)).expect("written");
    }));
    let mut expected = of_file(name, &[&word]);
    expected
        .words
        .extend((line > 0).then(|| format!("line {line},")));
    expected
}

/// Writes something else in place of a file.
pub(super) fn instead(
    random: &mut Random,
    take: &mut Take,
    text: String,
    words: &[&str],
) -> Expected {
    let name = take.files[random.below(take.files.len())].name;
    take.after.push(Box::new(move |folder| {
        fs::write(folder.join(name), text).expect("written")
    }));
    of_file(name, words)
}
