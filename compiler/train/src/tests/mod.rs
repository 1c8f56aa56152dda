//! Whole runs on a small corpus.

mod folder;
mod training;
