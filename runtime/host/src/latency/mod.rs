//! How punctual a servo loop is.
