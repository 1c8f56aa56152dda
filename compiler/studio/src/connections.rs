//! The connections that are open: at most so many, and a silent one makes room for a new one.
//!
//! A page of any site can open hundreds of sockets here and keep silent on them. If those who wait were only counted,
//! they would shut the user out for as long as they like.

use std::{
    collections::BTreeMap,
    net::{Shutdown, TcpStream},
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// How long a new connection waits for the room of one that was shut.
const ROOM_SOON: Duration = Duration::from_millis(100);

/// Connections by number.
pub(crate) struct Connections {
    most: usize,
    open: Mutex<Open>,
    left: Condvar,
}

#[derive(Default)]
struct Open {
    next: u64,
    connections: BTreeMap<u64, Connection>,
}

struct Connection {
    stream: Arc<TcpStream>,
    /// Since when it waits for a request; `None` while one is answered.
    silent_since: Option<Instant>,
    /// Whether it has shown the token.
    trusted: bool,
}

/// A connection's place, which it gives back when it is dropped.
pub(crate) struct Place {
    all: Arc<Connections>,
    number: u64,
}

impl Connections {
    pub(crate) fn new(most: usize) -> Arc<Self> {
        Arc::new(Self {
            most,
            open: Mutex::default(),
            left: Condvar::new(),
        })
    }

    /// A place for a connection. Where all are taken, the one that has been silent for longest is shut, and among those
    /// that have not shown the token, if there are any. `None` where none is silent.
    pub(crate) fn admit(self: &Arc<Self>, stream: &Arc<TcpStream>) -> Option<Place> {
        let mut open = self.lock();
        if open.connections.len() >= self.most {
            open.longest_silent()?.shut();
            let full = |open: &mut Open| open.connections.len() >= self.most;
            let (after, _) = self
                .left
                .wait_timeout_while(open, ROOM_SOON, full)
                .unwrap_or_else(PoisonError::into_inner);
            open = after;
            if open.connections.len() >= self.most {
                return None;
            }
        }
        let number = open.next;
        open.next += 1;
        let connection = Connection {
            stream: Arc::clone(stream),
            silent_since: Some(Instant::now()),
            trusted: false,
        };
        open.connections.insert(number, connection);
        Some(Place {
            all: Arc::clone(self),
            number,
        })
    }

    fn lock(&self) -> MutexGuard<'_, Open> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Open {
    fn longest_silent(&mut self) -> Option<&mut Connection> {
        let silent = |c: &&mut Connection| c.silent_since.is_some();
        let connections = self.connections.values_mut().filter(silent);
        connections.min_by_key(|c| (c.trusted, c.silent_since))
    }
}

impl Connection {
    /// Ends the read that its thread waits in. It is not chosen again.
    fn shut(&mut self) {
        self.silent_since = None;
        // One that is closed already has made room.
        let _ = self.stream.shutdown(Shutdown::Both);
    }
}

impl Place {
    /// The connection waits for a request from now on.
    pub(crate) fn waits(&self) {
        self.change(|connection| connection.silent_since = Some(Instant::now()));
    }

    /// A request has come, and is answered.
    pub(crate) fn works(&self) {
        self.change(|connection| connection.silent_since = None);
    }

    /// It has shown the token.
    pub(crate) fn is_trusted(&self) {
        self.change(|connection| connection.trusted = true);
    }

    fn change(&self, change: impl FnOnce(&mut Connection)) {
        if let Some(connection) = self.all.lock().connections.get_mut(&self.number) {
            change(connection);
        }
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.all.lock().connections.remove(&self.number);
        self.all.left.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{io::Read as _, net::TcpListener, thread};

    /// A connection whose thread reads until it is shut, as those of the server do.
    struct Silent {
        _client: TcpStream,
        place: Arc<Place>,
    }

    fn connect(listener: &TcpListener, all: &Arc<Connections>) -> Option<Silent> {
        let client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let stream = Arc::new(listener.accept().unwrap().0);
        let place = Arc::new(all.admit(&stream)?);
        let held = Arc::clone(&place);
        thread::spawn(move || {
            let _ = (&*stream).read(&mut [0]);
            drop(held);
        });
        Some(Silent {
            _client: client,
            place,
        })
    }

    #[test]
    fn the_longest_silent_stranger_makes_room_and_those_at_work_stay() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let all = Connections::new(3);
        let mut connections: Vec<Silent> = (0..3)
            .map(|_| connect(&listener, &all).expect("room"))
            .collect();
        connections[0].place.works();
        connections[1].place.is_trusted();
        // Its own handle goes with its thread's, so that its place is free.
        let number = |silent: &Silent| silent.place.number;
        let stranger = connections.remove(2);
        let gone = number(&stranger);
        drop(stranger.place);
        let fourth = connect(&listener, &all).expect("the room of the stranger");
        let open: Vec<u64> = all.lock().connections.keys().copied().collect();
        assert_eq!(open, [0, 1, number(&fourth)]);
        assert!(!open.contains(&gone));
        fourth.place.works();
        connections[1].place.works();
        assert!(connect(&listener, &all).is_none(), "all are at work");
    }
}
