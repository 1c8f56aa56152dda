//! Laws on materials made up here, and figures of a user's own copy of HaTT.

mod laws;
mod made_up;
mod real;
