//! A device behind the server: what its servo loop does, live, and which texture it is to play.
//!
//! Whoever attends to the loop publishes its ticks, on a thread of its own and never waiting: the last second is kept,
//! and older ticks make room. The page asks for the ticks after those that it has, whenever it has drawn these. So a
//! slow page skips ticks, which are counted, where a stream would have it see the past through a full socket; and the
//! loop is never waited for.

mod feed;
pub(crate) mod requests;
mod tick;

pub(crate) use feed::Feed;
pub use feed::{LiveStatus, Percentiles};
pub use tick::LiveTick;

use serde::Serialize;
use std::{
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// A device whose loop runs in this process. Clones are the same device.
#[derive(Debug, Clone)]
pub struct LiveDevice(Arc<Shared>);

#[derive(Debug)]
struct Shared {
    name: String,
    rate_hz: u32,
    swaps: bool,
    state: Mutex<State>,
    news: Condvar,
}

#[derive(Debug)]
struct State {
    feed: Feed,
    wanted: Option<RequestedTexture>,
}

/// A texture that the page wants to be played.
#[derive(Debug, Clone)]
pub struct RequestedTexture {
    /// Its name.
    pub name: String,
    /// Its asset, checked.
    pub asset: Arc<[u8]>,
}

/// A device's description, which the page gets before anything else.
#[derive(Serialize)]
pub(crate) struct Description<'a> {
    pub(crate) name: &'a str,
    pub(crate) rate_hz: u32,
    swaps: bool,
}

impl LiveDevice {
    /// A device of this name, whose loop runs at `rate_hz`. `swaps` says whether it takes other textures; a scene does
    /// not.
    #[must_use]
    pub fn new(name: &str, rate_hz: u32, swaps: bool) -> Self {
        Self(Arc::new(Shared {
            name: name.to_owned(),
            rate_hz,
            swaps,
            state: Mutex::new(State {
                feed: Feed::of_a_second(rate_hz),
                wanted: None,
            }),
            news: Condvar::new(),
        }))
    }

    /// Publishes ticks, the oldest first, and what is to be said of the loop now.
    pub fn publish(&self, ticks: &[LiveTick], status: &LiveStatus) {
        self.lock().feed.publish(ticks, status);
        self.0.news.notify_all();
    }

    /// Says something to the person at the page: an event of the loop, or why a texture was refused.
    pub fn say(&self, text: &str) {
        self.lock().feed.say(text);
        self.0.news.notify_all();
    }

    /// The loop is over.
    pub fn end(&self) {
        self.lock().feed.end();
        self.0.news.notify_all();
    }

    /// The texture that the page wanted last, once.
    #[must_use]
    pub fn wanted(&self) -> Option<RequestedTexture> {
        self.lock().wanted.take()
    }

    pub(crate) fn description(&self) -> Description<'_> {
        let Shared {
            name,
            rate_hz,
            swaps,
            ..
        } = &*self.0;
        Description {
            name,
            rate_hz: *rate_hz,
            swaps: *swaps,
        }
    }

    pub(crate) fn swaps(&self) -> bool {
        self.0.swaps
    }

    /// Has this texture played next; one that still waits makes room.
    pub(crate) fn want(&self, name: &str, asset: &Arc<[u8]>) {
        self.lock().wanted = Some(RequestedTexture {
            name: name.to_owned(),
            asset: Arc::clone(asset),
        });
    }

    /// Returns the ticks published from number `after` on, or all that are kept if it is `None`, JSON. Waits up to
    /// `patience` for something to be published.
    pub(crate) fn news(&self, after: Option<u64>, patience: Duration) -> String {
        let deadline = Instant::now() + patience;
        let mut state = self.lock();
        while !state.feed.has_news(after) {
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                break;
            }
            let waited = self.0.news.wait_timeout(state, left);
            (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        }
        state.feed.after(after)
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.0.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
