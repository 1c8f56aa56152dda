//! The studio: a page on which a person types a prompt, sees the surface, strokes it and hears it, and the server
//! behind that page.
//!
//! ```no_run
//! use asperity_studio::{Limits, Server, Studio};
//!
//! let studio = Studio::new(None, None); // without prompts
//! let server = Server::bind(0, studio, Limits::default())?; // a free port
//! println!("{}", server.url());
//! server.run(); // until `server.stopper().stop()`
//! # Ok::<(), asperity_studio::BindError>(())
//! ```
//!
//! # What it trusts
//!
//! Nothing. It listens on 127.0.0.1 alone, yet every program of the machine and every page in the user's browser can
//! connect. So each request passes, in this order and before any byte of its body is read:
//!
//! 1. `connections`: at most so many that have not shown the token, of which any goes for a new one.
//! 2. `http/`: a head of at most 16 KiB, in time, and a body of stated length.
//! 3. `guard`: `Host` is a name of this machine, at whatever port a tunnel has, against pages that reach it by a name of
//!    their own (DNS rebinding); `Origin` is that host, or another local name where the browser says
//!    same-origin; the path begins with the secret token; no other site asked for it.
//!    A request that does not pass is the last of its connection. One that does takes a place of the user's.
//! 4. `api`: the page's files by the table in `page`, so that no path reaches a file system; then the requests of the
//!    interface, each with its limit of bytes.
//!
//! What is compiled, mixed, opened or exported goes through the same calls as in the commands, so that bytes, reports and
//! errors are theirs. A panic in one of these ends one request. Files that are dropped on the page stay in memory, but
//! for those of a recording, which lie in a temporary folder while they are read; a
//! project is written to a disk, its files named by hashes. At most four large bodies are in memory at once, and no more requests compute at once than
//! there are processors.
#![forbid(unsafe_code)]

mod about;
mod api;
mod batch;
mod browser;
mod bundle;
mod collection;
mod connections;
mod device;
mod difference;
mod download;
mod error;
mod export;
mod folder;
mod guard;
mod http;
mod library_store;
mod limiter;
mod making;
mod module;
mod opening;
mod packing;
mod page;
mod project;
mod prompts;
mod recent;
mod recipe;
mod reply;
mod row;
mod server;
mod studio;
mod study;
mod texture;
mod thumbnails;
mod token;
mod worklet_asset;

/// The version of page, interface and module, which belong together.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

pub use browser::{BrowserError, show};
pub use collection::{Collection, CollectionError};
pub use device::{LiveDevice, LiveStatus, LiveTick, Percentiles, RequestedTexture};
pub use export::{ExportError, Exported, export};
pub use module::{Module, ModuleError};
pub use project::Project;
pub use prompts::LoadPrompts;
pub use reply::Reply;
pub use server::{BindError, Limits, Server, Site, Stopper};
pub use studio::Studio;
pub use study::{Outline, Study, StudyHost};
