//! The server as its page and its enemies meet it: over a socket.

mod answers;
mod attacks;
mod client;
mod connection;
mod device;
mod export;
mod files;
mod gallery;
mod hostile_files;
mod lists;
mod mixing;
mod refusals;
mod reply;
mod study;
mod waits;
