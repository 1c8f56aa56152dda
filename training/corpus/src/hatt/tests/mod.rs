//! Laws on materials made up here, and figures of a user's own copy of HaTT or of these.

mod figures;
mod laws;
mod made_up;
