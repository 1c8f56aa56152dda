//! The commands that make libraries and take them apart, each in a file of its own.

pub(super) mod build;
pub(super) mod diff;
pub(super) mod extract;
pub(super) mod list;
pub(super) mod merge;
pub(super) mod rename;
pub(super) mod split;
