//! The integration tests of this crate, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

mod alternation;
mod attacks;
mod c_face;
mod exchange;
mod export;
mod fidelity;
mod fixed_point;
mod floating_point;
mod friction_law;
mod fuzz_cases;
mod fuzz_ticks;
mod golden;
mod import_hatt;
mod levels;
mod model_files;
mod queries;
mod rates;
mod scene;
mod support;
mod unsafe_code;
