//! Hashes of two machines side by side.

use asperity_session::Phase;

/// A line for each case whose hashes differ, which names the first phase that does.
pub(crate) fn differences(expected: &str, found: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let mut lines = found.lines();
    for expected in expected.lines() {
        let found = lines.next().unwrap_or("nothing");
        if found != expected {
            faults.push(difference(expected, found));
        }
    }
    faults.extend(lines.map(|line| format!("a line too many, `{line}`")));
    faults
}

fn difference(expected: &str, found: &str) -> String {
    let (expected, found) = (words(expected), words(found));
    let case = expected.get(..2).unwrap_or_default();
    if found.get(..2) != Some(case) || found.len() != expected.len() {
        return format!(
            "`{}`, not the hashes of {}",
            found.join(" "),
            case.join(" ")
        );
    }
    let pairs = expected.iter().zip(&found).skip(2);
    let mut phases = Phase::ALL.iter().zip(pairs);
    phases.find(|(_, (a, b))| a != b).map_or_else(
        || format!("{}: another spelling", case.join(" ")),
        |(phase, (a, b))| {
            let case = case.join(" ");
            format!("{case}, phase {}: {b}, this machine has {a}", phase.name())
        },
    )
}

/// Arithmetic and case of each line, and the hash after the last phase.
pub(crate) fn last_hashes(hashes: &str) -> impl Iterator<Item = String> {
    hashes.lines().map(|line| {
        let words = words(line);
        let case = words.get(..2).unwrap_or_default().join(" ");
        format!("{case:<16} {}", words.last().copied().unwrap_or_default())
    })
}

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn session() -> String {
        let mut hashes = String::new();
        asperity_machines::write_hashes(&mut hashes).expect("a string takes everything");
        hashes
    }

    #[test]
    fn a_session_equals_itself_and_has_a_hash_a_phase() {
        let hashes = session();
        assert_eq!(differences(&hashes, &session()), Vec::<String>::new());
        for line in hashes.lines() {
            assert_eq!(words(line).len(), 2 + Phase::ALL.len(), "{line}");
        }
    }

    #[test]
    fn every_digit_a_lost_line_and_a_line_too_many_are_differences() {
        let hashes = "float arma20 0 1 2 3 4 5 6 7 8 9 a b\nfixed arma20 c d e f 0 1 2 3 4 5 6 7\n";
        for (at, phase) in Phase::ALL.iter().enumerate() {
            let mut changed = words(hashes.lines().next().unwrap());
            changed[2 + at] = "x";
            let changed = format!(
                "{}\n{}\n",
                changed.join(" "),
                hashes.lines().last().unwrap()
            );
            let found = differences(hashes, &changed);
            assert_eq!(found.len(), 1, "{found:?}");
            assert!(found[0].contains(phase.name()), "{found:?}");
        }
        let first = hashes.lines().next().unwrap();
        assert_eq!(differences(hashes, first).len(), 1);
        assert_eq!(differences(hashes, "").len(), 2);
        assert_eq!(differences(hashes, &format!("{hashes}more")).len(), 1);
    }
}
