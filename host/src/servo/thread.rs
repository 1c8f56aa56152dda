//! A servo loop on a thread of its own.

use super::{
    clock::Monotonic,
    periods::ServoLoop,
    privileges::{Grant, PrivilegeRequest, acquire},
    record::Observer,
    render::Render,
    report::Report,
    settings::Settings,
};
use crate::device::Device;
use std::io;
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::{Receiver, channel};
use std::thread::{Builder, Scope, ScopedJoinHandle};

/// Stack of the servo thread, bytes; all of it is touched before the loop begins.
const STACK_BYTES: usize = 1 << 20;

/// Arguments of a servo thread.
pub struct Start<'s, R, O> {
    /// The device; it is given back when the thread ends.
    pub device: &'s mut dyn Device,
    /// Renderer of its samples.
    pub render: R,
    /// Observer of its records.
    pub observer: O,
    /// Settings of the loop.
    pub settings: Settings,
    /// The clock, which may spin.
    pub clock: Monotonic,
    /// Requested privileges.
    pub privileges: PrivilegeRequest,
    /// Set to end the loop.
    pub stop: &'s AtomicBool,
}

/// A running servo thread.
#[derive(Debug)]
pub struct Servo<'scope> {
    thread: ScopedJoinHandle<'scope, Report>,
    grants: Receiver<Vec<Grant>>,
}

impl<'scope> Servo<'scope> {
    /// Starts the thread: it asks the system for what is wanted, then runs the loop.
    ///
    /// # Errors
    /// [`io::Error`] where the system has no room for a thread.
    pub fn spawn<'env, R, O>(
        scope: &'scope Scope<'scope, 'env>,
        start: Start<'scope, R, O>,
    ) -> io::Result<Self>
    where
        R: Render + Send + 'scope,
        O: Observer + Send + 'scope,
    {
        let (to_grants, grants) = channel();
        let body = move || {
            let acquired = acquire(&start.privileges, start.settings.rate_hz);
            // The receiver may be gone; the loop runs all the same.
            let _ = to_grants.send(acquired.grants.clone());
            drop(to_grants);
            let servo = ServoLoop::new(
                start.device,
                start.render,
                start.clock,
                start.observer,
                start.settings,
            );
            servo.run(start.stop)
        };
        let builder = Builder::new().name("asperity-servo".into());
        let thread = builder.stack_size(STACK_BYTES).spawn_scoped(scope, body)?;
        Ok(Self { thread, grants })
    }

    /// Returns the granted and refused privileges; blocks until the thread has requested them.
    #[must_use]
    pub fn grants(&self) -> Vec<Grant> {
        self.grants.recv().unwrap_or_default()
    }

    /// Returns true if the loop has ended.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.thread.is_finished()
    }

    /// Waits for the end of the loop; `None` if it panicked.
    #[must_use]
    pub fn join(self) -> Option<Report> {
        self.thread.join().ok()
    }
}
