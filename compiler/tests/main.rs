//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod auto_gain;
mod contact_laws;
mod directions;
mod edits;
mod manifests;
mod model_schema;
mod own_source;
mod prompts;
mod relative;
mod scene;
mod surfaces;
mod texture_model;
mod tokens;
