//! Whole runs on a small corpus.

mod speed;
mod training;
