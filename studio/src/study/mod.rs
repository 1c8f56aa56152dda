//! Studies with people: the textures of a TOML file, one after the other on a participant's page, and a dataset of what they
//! answer.
//!
//! | file | says |
//! |---|---|
//! | `design`, `forms`, `checks`, `text` | what a study is, and its faults |
//! | `plan` | which step follows which, for whom |
//! | `stimuli` | its textures, compiled |
//! | `prepared` | all of these |
//! | `host`, `answers`, `participants`, `requests` | who takes part, and what is open for them |
//! | `dataset`, `utc` | what is written |
//! | `simulate` | participants that nobody asked |
//!
//! A participant's page knows the address of the study and a secret of its own. It gets the step that is open and no other,
//! so that it can neither repeat a trial nor see what comes, nor what others do.

mod answers;
mod checks;
mod dataset;
mod design;
mod forms;
mod host;
mod participants;
mod plan;
mod prepared;
pub(crate) mod requests;
mod simulate;
mod stimuli;
mod text;
mod utc;

pub use host::StudyHost;
pub use prepared::{Outline, Study};
