//! Figures that stand in a page without markers.
//!
//! A number with a unit that results of measurements have, in prose or a table. Code and what stands between
//! markers is no prose.

use regex_lite::Regex;
use std::sync::LazyLock;

/// A number with a unit of results.
static FIGURE: LazyLock<Regex> = LazyLock::new(|| {
    let units = "dB|%|ns|µs|instructions|times as|textures a second|words a second";
    compiled(&format!("[0-9][\\s\u{a0}]?(?:{units})"))
});
/// A cell of a table that holds nothing but numbers.
static CELL: LazyLock<Regex> =
    LazyLock::new(|| compiled("^[-–±0-9.,/·×eE \u{a0}−]*[0-9][-–±0-9.,/·×eE \u{a0}−]*$"));
/// Quoted text, and code within a line.
static APART: LazyLock<Regex> = LazyLock::new(|| compiled("(?s)<!--=.*?<!--/-->|`[^`\n]+`"));

fn compiled(pattern: &str) -> Regex {
    Regex::new(pattern).unwrap_or_else(|error| panic!("{error}"))
}

/// Lines of the page, from 1, with figures that no marker holds, as often as there are such figures.
#[must_use]
pub fn unmarked(text: &str) -> Vec<usize> {
    // Lines keep their numbers.
    let blank = |found: &regex_lite::Captures<'_>| "\n".repeat(found[0].matches('\n').count());
    let prose = APART.replace_all(text, blank);
    let mut code = false;
    let mut lines = Vec::new();
    for (number, line) in prose.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            code = !code;
        } else if !code {
            let table = line.starts_with('|');
            let cells = line.split('|').filter(|cell| table && CELL.is_match(cell));
            let found = cells.count() + FIGURE.find_iter(line).count();
            lines.extend(std::iter::repeat_n(number + 1, found));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_outside_markers_and_code_are_found() {
        let page = "within 0.7 dB\n<!--=a.b-->\n3 %\n<!--/--> 4 %, 5 dB\n`6 dB`\n```text\n7 dB\n```\n8 ns\n| a | 1.5 | −2 / 3 |";
        assert_eq!(unmarked(page), [1, 4, 4, 9, 10, 10]);
        assert!(unmarked("version 3, of 350 materials, in 2 pages").is_empty());
    }
}
