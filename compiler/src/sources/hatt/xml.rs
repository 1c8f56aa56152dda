//! Reads numbers and lists from an untrusted XML document, and names the line of what is wrong.

use super::error::{HattError, Problem};
use asperity_io::input;
use roxmltree::{Document, Node, ParsingOptions};
use std::{fmt::Display, path::Path};

/// Most XML nodes accepted; HaTT materials have below 20,000.
const MAX_NODES: u32 = 1_000_000;

/// Parses a document: UTF-8, no document type, bounded.
pub(super) fn parse<'a>(file: &Path, bytes: &'a [u8]) -> Result<Document<'a>, HattError> {
    let fail = |line, problem| HattError {
        file: file.to_owned(),
        line,
        problem,
    };
    let text = input::text(bytes).map_err(|e| fail(None, e.into()))?;
    input::check_nesting(text).map_err(|e| fail(Some(e.line), e.problem.into()))?;
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
                .map(|index| index as u32 + 1);
            fail(line, Problem::Doctype)
        }
        other => {
            let line = other.pos().row;
            fail(Some(line), Problem::Malformed(other.to_string()))
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

    /// An error at this element.
    pub(super) fn error(&self, problem: Problem) -> HattError {
        let start = self.node.range().start;
        HattError {
            file: self.file.to_owned(),
            line: Some(self.node.document().text_pos_at(start).row),
            problem,
        }
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
    pub(super) fn child(&self, place: &str, name: &str) -> Result<Self, HattError> {
        let found = self.children(name);
        match found.as_slice() {
            [one] => Ok(*one),
            [] => Err(self.error(Problem::Missing {
                field: format!("{place}{name}"),
            })),
            [_, second, ..] => Err(second.error(Problem::Repeated {
                field: format!("{place}{name}"),
            })),
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
    ) -> Result<f64, HattError> {
        let value: f64 = self.text().parse().map_err(|_| {
            self.error(Problem::NotANumber {
                field: field.to_string(),
                value: self.text().chars().take(40).collect(),
            })
        })?;
        if value.is_finite() && accept(value) {
            Ok(value)
        } else {
            Err(self.error(Problem::OutOfRange {
                field: field.to_string(),
                value,
                rule: rule.to_owned(),
            }))
        }
    }

    /// The element's text as a count from `min` to `max`.
    pub(super) fn count(
        &self,
        field: impl Display,
        min: usize,
        max: usize,
    ) -> Result<usize, HattError> {
        let rule = format!("a whole number from {min} to {max}");
        let value = self.number(field, &rule, |v| {
            v.fract() == 0.0 && v >= min as f64 && v <= max as f64
        })?;
        Ok(value as usize)
    }

    /// The numbers of the `<value>` children, `expected` of them.
    pub(super) fn list(
        &self,
        field: &str,
        (expected, stated_by): (usize, &'static str),
        rule: &str,
        accept: impl Fn(f64) -> bool,
    ) -> Result<Vec<f64>, HattError> {
        let values = self.children("value");
        if values.len() != expected {
            return Err(self.error(Problem::Count {
                field: field.to_owned(),
                found: values.len(),
                expected,
                stated_by,
            }));
        }
        values
            .iter()
            .enumerate()
            .map(|(index, value)| value.number(format_args!("{field}[{index}]"), rule, &accept))
            .collect()
    }
}
