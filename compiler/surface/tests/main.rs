//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod maps;
mod normals;
mod profiles;
mod strokes;
