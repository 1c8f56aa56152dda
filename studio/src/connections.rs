//! Open connections. Those that have shown the token hold the user's places. All others share as few, whatever they do:
//! one of them is shut for each that is new.
//!
//! A page of any site can open hundreds of sockets here, and keep silent on them, send bodies without end or read no
//! answer. None of that may shut the user out. A new connection of the user's goes only where 64 others come before its
//! head is read; a last answer may be lost where strangers fill their room.

use std::{
    collections::BTreeMap,
    net::{Shutdown, TcpStream},
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// Connections at once that hold no place of the user's.
const STRANGERS: usize = 64;
/// Longest wait for the room of a shut connection; its thread ends as soon as it gets a processor.
const ROOM_SOON: Duration = Duration::from_secs(1);

/// Connections by number.
pub(crate) struct Connections {
    /// The user's places.
    most: usize,
    open: Mutex<Open>,
    changed: Condvar,
}

#[derive(Default)]
struct Open {
    next: u64,
    connections: BTreeMap<u64, Connection>,
}

struct Connection {
    stream: Arc<TcpStream>,
    stage: Stage,
    /// True if it holds one of the user's places.
    trusted: bool,
}

/// In the order in which connections make room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    /// It has its last answer.
    Lingers,
    /// It waits for a request since then.
    Silent(Instant),
    /// A request is answered; it makes no room.
    Works,
    /// It was shut, and its thread ends.
    Shut,
}

/// An open connection, which is forgotten when this is dropped.
pub(crate) struct AdmittedConnection {
    all: Arc<Connections>,
    number: u64,
}

impl Connections {
    /// No connection yet, with so many places for the user.
    pub(crate) fn new(most: usize) -> Arc<Self> {
        Arc::new(Self {
            most,
            open: Mutex::default(),
            changed: Condvar::new(),
        })
    }

    /// Admits a connection among the strangers. `None` where those that were shut for it do not end.
    pub(crate) fn admit(self: &Arc<Self>, stream: &Arc<TcpStream>) -> Option<AdmittedConnection> {
        let mut open = self.room(false, STRANGERS - 1)?;
        let number = open.next;
        open.next += 1;
        let connection = Connection {
            stream: Arc::clone(stream),
            stage: Stage::Silent(Instant::now()),
            trusted: false,
        };
        open.connections.insert(number, connection);
        Some(AdmittedConnection {
            all: Arc::clone(self),
            number,
        })
    }

    /// Waits until at most so many connections hold a place of the user's, or hold none, and shuts others for that, one
    /// after another. `None` where they work on.
    fn room(&self, trusted: bool, most: usize) -> Option<MutexGuard<'_, Open>> {
        let until = Instant::now() + ROOM_SOON;
        let mut open = self.lock();
        while open.of(trusted).count() > most {
            if !open.of(trusted).any(|c| c.stage == Stage::Shut)
                && let Some(first) = open.of(trusted).min_by_key(|c| c.stage)
            {
                first.shut();
            }
            let left = until.checked_duration_since(Instant::now())?;
            let woken = self.changed.wait_timeout(open, left);
            (open, _) = woken.unwrap_or_else(PoisonError::into_inner);
        }
        Some(open)
    }

    fn lock(&self) -> MutexGuard<'_, Open> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Open {
    fn of(&mut self, trusted: bool) -> impl Iterator<Item = &mut Connection> {
        let connections = self.connections.values_mut();
        connections.filter(move |connection| connection.trusted == trusted)
    }
}

impl Connection {
    /// Ends the read that its thread waits in, unless it works.
    fn shut(&mut self) {
        if self.stage < Stage::Works {
            self.stage = Stage::Shut;
            // One that is closed already has made room.
            let _ = self.stream.shutdown(Shutdown::Both);
        }
    }
}

impl AdmittedConnection {
    /// The connection has shown the token, and its request is answered from now on. `false` where all places of the user
    /// are at work.
    pub(crate) fn enter(&self) -> bool {
        let entered = |connection: &mut Connection| {
            let is_open = connection.stage != Stage::Shut;
            if is_open {
                connection.stage = Stage::Works;
            }
            (is_open, connection.trusted)
        };
        match self.change(self.all.lock(), entered) {
            // It made room for another before its head was read.
            (false, _) => return false,
            (true, true) => return true,
            (true, false) => {}
        }
        let Some(open) = self.all.room(true, self.all.most.saturating_sub(1)) else {
            return false;
        };
        self.change(open, |connection| connection.trusted = true);
        true
    }

    /// It waits for the next request from now on.
    pub(crate) fn wait(&self) {
        let silent = Stage::Silent(Instant::now());
        self.change(self.all.lock(), |connection| connection.stage = silent);
    }

    /// It gets no further request, and gives the user's place back.
    pub(crate) fn linger(&self) {
        self.change(self.all.lock(), |connection| {
            if connection.stage != Stage::Shut {
                connection.stage = Stage::Lingers;
            }
            connection.trusted = false;
        });
    }

    fn change<T: Default>(
        &self,
        mut open: MutexGuard<'_, Open>,
        change: impl FnOnce(&mut Connection) -> T,
    ) -> T {
        self.all.changed.notify_all();
        let connection = open.connections.get_mut(&self.number);
        connection.map(change).unwrap_or_default()
    }
}

impl Drop for AdmittedConnection {
    fn drop(&mut self) {
        self.all.lock().connections.remove(&self.number);
        self.all.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{io::Read as _, net::TcpListener, thread};

    /// A connection whose thread reads until it is shut, as those of the server do.
    struct Reading {
        _client: TcpStream,
        connection: Arc<AdmittedConnection>,
    }

    fn connect(listener: &TcpListener, all: &Arc<Connections>) -> Reading {
        let client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let stream = Arc::new(listener.accept().unwrap().0);
        let connection = all.admit(&stream).expect("strangers make room");
        let connection = Arc::new(connection);
        let held = Arc::downgrade(&connection);
        thread::spawn(move || {
            let _ = (&*stream).read(&mut [0]);
            // Its place is given back here, as in the server.
            if let Some(connection) = held.upgrade() {
                connection.all.lock().connections.remove(&connection.number);
                connection.all.changed.notify_all();
            }
        });
        Reading {
            _client: client,
            connection,
        }
    }

    fn open(all: &Connections) -> Vec<u64> {
        all.lock().connections.keys().copied().collect()
    }

    #[test]
    fn the_longest_silent_makes_room_and_those_at_work_stay() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let all = Connections::new(2);
        let connections: Vec<Reading> = (0..4).map(|_| connect(&listener, &all)).collect();
        let connection = |n: usize| &connections[n].connection;
        assert!(connection(0).enter() && connection(1).enter());
        assert!(!connection(2).enter(), "both are at work");
        connection(1).wait();
        // Two times are two, on coarse clocks too.
        thread::sleep(Duration::from_millis(2));
        connection(0).wait();
        assert!(connection(3).enter());
        assert_eq!(open(&all), [0, 2, 3], "1 was silent for longer");
        assert!(connection(0).enter(), "it has its place");
        connection(3).linger();
        assert!(connection(2).enter(), "one that lingers holds no place");
        assert_eq!(open(&all), [0, 2, 3]);
    }

    #[test]
    fn strangers_make_room_for_strangers_alone_and_those_with_their_answer_first() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let all = Connections::new(2);
        let users = [0, 1].map(|_| connect(&listener, &all));
        assert!(users[0].connection.enter() && users[1].connection.enter());
        users[1].connection.wait();
        let mut strangers: Vec<Reading> =
            (0..STRANGERS).map(|_| connect(&listener, &all)).collect();
        strangers[9].connection.linger();
        let gone = [
            strangers[9].connection.number,
            strangers[0].connection.number,
        ];
        for _ in gone {
            strangers.push(connect(&listener, &all));
        }
        let open = open(&all);
        assert_eq!(open.len(), 2 + STRANGERS);
        assert_eq!(open[..2], [0, 1]);
        assert!(gone.iter().all(|number| !open.contains(number)));
    }
}
