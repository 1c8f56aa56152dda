//! Recordings: what was felt is felt again to the bit, and no damage goes unnoticed.

mod again;
mod damage;
mod disk;
mod replay;
mod session;
mod table;
