//! As much of HTTP/1.1 as a page and its server need, with every length and every wait bounded.
//!
//! `tiny_http` reads heads of any length, starts a thread for every connection, and keeps its sockets to itself, so
//! that a slow client cannot be dropped. `httparse` parses heads; all else is here, on plain sockets, which a WebSocket
//! can take over.

mod answer;
mod body;
mod deadline;
mod head;

pub(crate) use answer::{Answer, Content, Keep, PAGE_POLICY, Status};
pub(crate) use body::Body;
pub(crate) use deadline::Timed;
pub(crate) use head::{Head, Method, read_head};
