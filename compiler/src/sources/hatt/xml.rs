//! Reads numbers and lists from an untrusted XML document, and names the line of what is wrong.

use asperity_io::{diagnostic::Fault, input};
use roxmltree::{Document, Node, ParsingOptions};
use std::{fmt::Display, path::Path};

/// Most XML nodes accepted; HaTT materials have below 20,000.
const MAX_NODES: u32 = 1_000_000;

/// Remedy for a file of another kind.
pub(super) const WRONG_FILE: &str =
    "give a model file of the Penn Haptic Texture Toolkit, `Models_<name>.xml`";
/// Remedy for a value that cannot be right.
pub(super) const WRONG_VALUE: &str = "correct the value, or fetch the file again from HaTT";

/// Parses a document: UTF-8, no document type, bounded.
pub(super) fn parse<'a>(file: &Path, bytes: &'a [u8]) -> Result<Document<'a>, Fault> {
    let text = input::text(bytes).map_err(|problem| Fault::from(problem).at(file))?;
    input::check_nesting(text).map_err(|error| {
        let fault = Fault::new(error.problem, WRONG_FILE).at(file);
        fault.line(u64::from(error.line))
    })?;
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: MAX_NODES,
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options).map_err(|e| match e {
        roxmltree::Error::DtdDetected => {
            let line = text
                .lines()
                .position(|line| line.contains("<!DOCTYPE"))
                .map(|index| index as u64 + 1);
            let what = "declares a document type or entities, which is refused";
            let remedy = "remove the <!DOCTYPE …> declaration; HaTT files have none";
            Fault::new(what, remedy).at(file).line(line)
        }
        other => {
            let what = format!("not well-formed XML: {other}");
            let remedy = "the file is damaged or incomplete: fetch it again from HaTT";
            Fault::new(what, remedy)
                .at(file)
                .line(u64::from(other.pos().row))
        }
    })
}

/// An element of a document, with what an error needs to name it.
#[derive(Clone, Copy)]
pub(super) struct Element<'a, 'i> {
    file: &'a Path,
    node: Node<'a, 'i>,
}

impl<'a, 'i> Element<'a, 'i> {
    pub(super) fn root(file: &'a Path, document: &'a Document<'i>) -> Self {
        Self {
            file,
            node: document.root_element(),
        }
    }

    pub(super) fn name(&self) -> &'a str {
        self.node.tag_name().name()
    }

    /// A fault at this element.
    pub(super) fn fault(&self, what: impl Display, remedy: impl Into<Box<str>>) -> Fault {
        let start = self.node.range().start;
        let line = u64::from(self.node.document().text_pos_at(start).row);
        Fault::new(what, remedy).at(self.file).line(line)
    }

    /// The fault of a number outside its range; NaN and infinities always are.
    pub(super) fn out_of_range(&self, field: impl Display, value: f64, rule: &str) -> Fault {
        self.fault(format!("{field} = {value}, must be {rule}"), WRONG_VALUE)
    }

    /// Refuses a list that has another length than the file states elsewhere.
    pub(super) fn check_count(
        &self,
        field: &str,
        found: usize,
        (expected, stated_by): (usize, &str),
    ) -> Result<(), Fault> {
        if found == expected {
            return Ok(());
        }
        let what = format!("{field}: {found} found, {expected} expected from {stated_by}");
        let remedy =
            format!("make the list and {stated_by} agree, or fetch the file again from HaTT");
        Err(self.fault(what, remedy))
    }

    /// Child elements of a name, in document order.
    pub(super) fn children(&self, name: &str) -> Vec<Self> {
        self.node
            .children()
            .filter(|child| child.is_element() && child.tag_name().name() == name)
            .map(|node| Self {
                file: self.file,
                node,
            })
            .collect()
    }

    /// The one child element of a name; `place` says where, for an error.
    pub(super) fn child(&self, place: &str, name: &str) -> Result<Self, Fault> {
        let found = self.children(name);
        match found.as_slice() {
            [one] => Ok(*one),
            [] => Err(self.fault(
                format!("<{place}{name}> is missing"),
                format!("add <{place}{name}>, or fetch the file again from HaTT"),
            )),
            [_, second, ..] => Err(second.fault(
                format!("<{place}{name}> appears twice"),
                format!("keep one <{place}{name}>"),
            )),
        }
    }

    /// The element's own text without surrounding space.
    pub(super) fn text(&self) -> &'a str {
        self.node.text().unwrap_or_default().trim()
    }

    /// The element's text as a finite number for which `accept` holds.
    pub(super) fn number(
        &self,
        field: impl Display,
        rule: &str,
        accept: impl Fn(f64) -> bool,
    ) -> Result<f64, Fault> {
        let value: f64 = self.text().parse().map_err(|_| {
            let text: String = self.text().chars().take(40).collect();
            self.fault(format!("{field} = {text:?} is not a number"), WRONG_VALUE)
        })?;
        if value.is_finite() && accept(value) {
            Ok(value)
        } else {
            Err(self.out_of_range(field, value, rule))
        }
    }

    /// The element's text as a count from `min` to `max`.
    pub(super) fn count(
        &self,
        field: impl Display,
        min: usize,
        max: usize,
    ) -> Result<usize, Fault> {
        let rule = format!("a whole number from {min} to {max}");
        let value = self.number(field, &rule, |v| {
            v.fract() == 0.0 && v >= min as f64 && v <= max as f64
        })?;
        Ok(value as usize)
    }

    /// The numbers of the `<value>` children, as many as `count` states.
    pub(super) fn list(
        &self,
        field: &str,
        count: (usize, &str),
        rule: &str,
        accept: impl Fn(f64) -> bool,
    ) -> Result<Vec<f64>, Fault> {
        let values = self.children("value");
        self.check_count(field, values.len(), count)?;
        values
            .iter()
            .enumerate()
            .map(|(index, value)| value.number(format_args!("{field}[{index}]"), rule, &accept))
            .collect()
    }
}
