//! A page whose figures stand between markers.
//!
//! `<!--=pairs.rough-->136<!--/-->` quotes figure `rough` of `pairs.toml`. Markdown shows no markers. A figure
//! of several lines, such as a table, stands on lines of its own. `<!--=edits.table|rough|edits-->363<!--/-->` quotes
//! one [cell](super::cell) of a table.

use super::{Set, cell::cell};
use std::collections::BTreeMap;

const OPENS: &str = "<!--=";
const ENDS_NAME: &str = "-->";
const CLOSES: &str = "<!--/-->";

/// A figure that a page quotes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Quoted {
    /// Line of the page, from 1.
    pub line: usize,
    /// `set.figure`.
    pub name: String,
    /// The page's text.
    pub said: String,
    /// The set's text.
    pub right: String,
}

/// The page with each figure as its set has it, and what it quotes.
///
/// # Errors
/// The line and the fault, for markers that are not closed or name no figure.
pub fn fill(
    text: &str,
    sets: &BTreeMap<String, Set>,
) -> Result<(String, Vec<Quoted>), (usize, String)> {
    let (mut filled, mut quoted, mut rest) = (String::new(), Vec::new(), text);
    while let Some((before, after)) = rest.split_once(OPENS) {
        filled += before;
        let line = filled.matches('\n').count() + 1;
        let fault = |what: &str| (line, what.to_owned());
        let (name, after) = after
            .split_once(ENDS_NAME)
            .ok_or_else(|| fault("a marker without its `-->`"))?;
        let (said, after) = after
            .split_once(CLOSES)
            .ok_or_else(|| fault("a figure without its `<!--/-->`"))?;
        let (whole, of_cell) = match name.split_once('|') {
            Some((whole, path)) => (whole, Some(path)),
            None => (name, None),
        };
        let figure = whole
            .split_once('.')
            .and_then(|(set, figure)| sets.get(set)?.figures.get(figure))
            .ok_or_else(|| fault(&format!("docs/figures has no figure {whole}")))?;
        let right = match of_cell {
            Some(path) => cell(figure, path).map_err(|what| fault(&format!("{whole}: {what}")))?,
            None if figure.contains('\n') => format!("\n{}\n", figure.trim_end()),
            None => figure.clone(),
        };
        filled += &format!("{OPENS}{name}{ENDS_NAME}{right}{CLOSES}");
        quoted.push(Quoted {
            line,
            name: name.to_owned(),
            said: said.to_owned(),
            right,
        });
        rest = after;
    }
    Ok((filled + rest, quoted))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sets() -> BTreeMap<String, Set> {
        let table = "| a |\n|---|\n| 1 |".to_owned();
        let set = Set::new("x", [("rough", "136".to_owned()), ("table", table)]);
        [("pairs".to_owned(), set)].into()
    }

    #[test]
    fn a_figure_that_was_changed_by_hand_is_put_right() {
        let page = "a\nof <!--=pairs.rough-->137<!--/--> pairs";
        let (filled, quoted) = fill(page, &sets()).unwrap();
        assert_eq!(filled, "a\nof <!--=pairs.rough-->136<!--/--> pairs");
        assert_eq!((quoted[0].line, quoted[0].said.as_str()), (2, "137"));
        assert_eq!(fill(&filled, &sets()).unwrap().0, filled);
    }

    #[test]
    fn a_table_stands_on_its_own_lines() {
        let (filled, _) = fill("<!--=pairs.table--><!--/-->", &sets()).unwrap();
        assert_eq!(filled, "<!--=pairs.table-->\n| a |\n|---|\n| 1 |\n<!--/-->");
    }

    #[test]
    fn a_cell_of_a_table_is_quoted_by_row_and_column() {
        let table = "| kind | a / b |\n|---|---:|\n| x | 1 / 2 |".to_owned();
        let sets = [("s".to_owned(), Set::new("x", [("t", table)]))].into();
        let (filled, _) = fill("<!--=s.t|x|a / b|2-->?<!--/-->", &sets).unwrap();
        assert_eq!(filled, "<!--=s.t|x|a / b|2-->2<!--/-->");
        let (line, what) = fill("\n<!--=s.t|y|a / b-->?<!--/-->", &sets).unwrap_err();
        assert_eq!((line, what.as_str()), (2, "s.t: no row y"));
    }

    #[test]
    fn a_marker_that_names_no_figure_is_refused_by_line() {
        for page in [
            "\n<!--=pairs.soft-->1<!--/-->",
            "\n<!--=pairs.rough-->1",
            "\n<!--=p",
        ] {
            assert_eq!(fill(page, &sets()).unwrap_err().0, 2, "{page}");
        }
    }
}
