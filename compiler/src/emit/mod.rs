//! Everything that knows the bytes: models into assets, the gate before they are written,
//! files, and the way back.

mod contact;
pub mod lower;
pub mod pack;
pub mod raise;
pub mod sections;
pub mod textures;
pub mod verify;
