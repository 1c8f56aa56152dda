//! Whole runs on a small corpus.

mod clip;
mod folder;
mod training;
