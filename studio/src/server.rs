//! The server: accepts connections, gives each a thread, and answers one request of it after another.

use crate::{
    api,
    connections::{AdmittedConnection, Connections},
    error::ApiError,
    guard::{Guard, Target},
    http::{Answer, Body, Head, Method, Status, Timed, read_head},
    studio::Studio,
    study::{StudyHost, requests as study_requests},
    token::Token,
};
use asperity_io::{diagnostic::Diagnostic, system};
use std::{
    io::{self, ErrorKind, Read as _},
    net::{Ipv4Addr, Shutdown, SocketAddr, TcpListener, TcpStream},
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::Duration,
};
use thiserror::Error;

/// Time for which unwanted bytes are read before a socket is closed; an earlier close would discard its last answer.
const LINGER: Duration = Duration::from_secs(2);
/// Wait before a retry where the system gives the server no socket or thread.
const RECOVERY: Duration = Duration::from_millis(20);
/// Time for a rejected client to read why.
const TURNED_AWAY: Duration = Duration::from_millis(50);

/// Limits on clients.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Connections at once that know the token, at least 1.
    pub connections: usize,
    /// Time for a request to come, and again for its answer to go.
    pub time: Duration,
}

/// 64 connections, 10 s.
impl Default for Limits {
    fn default() -> Self {
        Self {
            connections: 64,
            time: Duration::from_secs(10),
        }
    }
}

/// The server cannot listen.
#[derive(Debug, Error)]
pub enum BindError {
    /// The system refuses the port.
    #[error("cannot listen on port {port}")]
    Port {
        /// The port.
        port: u16,
        /// Why.
        source: io::Error,
    },
    /// The system has no random numbers.
    #[error("the system gives no random numbers for the address")]
    Random(#[source] getrandom::Error),
}

impl Diagnostic for BindError {
    fn remedy(&self) -> String {
        match self {
            Self::Port { source, .. } => match source.kind() {
                ErrorKind::AddrInUse => {
                    "another program listens there: end it, give another --port, or leave it out for a free one".into()
                }
                ErrorKind::PermissionDenied => {
                    "give a --port from 1024 on, or leave it out for a free one".into()
                }
                _ => system::remedy(source)
                    .unwrap_or("leave --port out for a free one")
                    .into(),
            },
            Self::Random(_) => "see that the system offers random numbers (getrandom, /dev/urandom)".into(),
        }
    }
}

/// A server that listens.
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    stopped: Arc<AtomicBool>,
    shared: Arc<Shared>,
}

/// The site of a server.
#[derive(Clone)]
pub enum Site {
    /// A studio, under an address that is new each time.
    Studio(Arc<Studio>),
    /// A study for its participants, under the address of its folder.
    Study(Arc<StudyHost>),
}

impl From<Studio> for Site {
    fn from(studio: Studio) -> Self {
        Self::Studio(Arc::new(studio))
    }
}

impl From<Arc<Studio>> for Site {
    fn from(studio: Arc<Studio>) -> Self {
        Self::Studio(studio)
    }
}

impl From<StudyHost> for Site {
    fn from(study: StudyHost) -> Self {
        Self::Study(Arc::new(study))
    }
}

impl Site {
    /// The secret of its address.
    fn token(&self) -> Result<Token, getrandom::Error> {
        match self {
            Self::Study(study) => study.token().map_or_else(Token::random, Ok),
            Self::Studio(_) => Token::random(),
        }
    }
}

/// State shared by the threads of connections.
struct Shared {
    guard: Guard,
    site: Site,
    limits: Limits,
}

/// Stops a server, from any thread.
#[derive(Debug, Clone)]
pub struct Stopper {
    address: SocketAddr,
    stopped: Arc<AtomicBool>,
}

impl Stopper {
    /// [`Server::run`] returns; connections that are open are left to the end of the process.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::SeqCst);
        // It waits for a connection; this is one.
        drop(TcpStream::connect(self.address));
    }
}

impl Server {
    /// Listens on 127.0.0.1, at this port or, for 0, at a free one.
    ///
    /// # Errors
    /// [`BindError`] for a port that cannot be had, and a system without random numbers.
    pub fn bind(port: u16, site: impl Into<Site>, limits: Limits) -> Result<Self, BindError> {
        let refused = |source| BindError::Port { port, source };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(refused)?;
        let address = listener.local_addr().map_err(refused)?;
        let site = site.into();
        let token = site.token().map_err(BindError::Random)?;
        Ok(Self {
            listener,
            address,
            stopped: Arc::default(),
            shared: Arc::new(Shared {
                guard: Guard::new(token),
                site,
                limits,
            }),
        })
    }

    /// The page's address, with the token: whoever knows it may use the server.
    #[must_use]
    pub fn url(&self) -> String {
        format!("http://{}{}", self.address, self.shared.guard.page())
    }

    /// Returns a handle that stops the server.
    #[must_use]
    pub fn stopper(&self) -> Stopper {
        Stopper {
            address: self.address,
            stopped: Arc::clone(&self.stopped),
        }
    }

    /// Answers until it is stopped. Meanwhile another thread loads the networks, so that the page is there at once.
    pub fn run(self) {
        if let Site::Studio(studio) = self.shared.site.clone() {
            // Without this thread, the first prompt loads them.
            let _ = thread::Builder::new()
                .name("networks".into())
                .spawn(move || studio.load());
        }
        let connections = Connections::new(self.shared.limits.connections);
        for stream in self.listener.incoming() {
            if self.stopped.load(Ordering::SeqCst) {
                return;
            }
            match stream {
                Ok(stream) => self.accept(stream, &connections),
                Err(_) => thread::sleep(RECOVERY),
            }
        }
    }

    fn accept(&self, stream: TcpStream, connections: &Arc<Connections>) {
        let stream = Arc::new(stream);
        // Without it, answers are a little slower.
        let _ = stream.set_nodelay(true);
        let Some(connection) = connections.admit(&stream) else {
            return turn_away(&stream);
        };
        let shared = Arc::clone(&self.shared);
        let of_thread = Arc::clone(&stream);
        let started = thread::Builder::new()
            .name("connection".into())
            .spawn(move || shared.serve(&of_thread, &connection));
        if started.is_err() {
            turn_away(&stream);
            thread::sleep(RECOVERY);
        }
    }
}

/// There is no room.
fn busy() -> Answer {
    Answer::from(&ApiError::new(
        Status::Busy,
        "too many connections are open",
        "close other tabs of the studio, and try again",
    ))
}

/// Tells a client that there is no room. It may be gone already.
fn turn_away(stream: &TcpStream) {
    let _ = busy().send(&mut Timed::new(stream, TURNED_AWAY), true, false);
}

impl Shared {
    /// Answers the requests of a connection until it ends.
    fn serve(&self, stream: &TcpStream, connection: &AdmittedConnection) {
        let mut buffer = Vec::new();
        loop {
            let mut timed = Timed::new(stream, self.limits.time);
            let head = match read_head(&mut timed, &mut buffer) {
                Ok(Some(head)) => head,
                Ok(None) => return,
                Err(error) => return self.end(stream, connection, &Answer::from(&error), false),
            };
            let bare = head.method == Method::Head;
            let below = match self.guard.pass(&head) {
                Ok(below) if connection.enter() => below,
                Ok(_) => return self.end(stream, connection, &busy(), bare),
                Err(refusal) => return self.end(stream, connection, &Answer::from(&refusal), bare),
            };
            let mut body = Body::new(&mut timed, &mut buffer, head.length, head.expects_continue);
            let answer = self.answer(&head, below, &mut body);
            // What is left of a body would be read as a request.
            if head.closes || !body.is_over() {
                return self.end(stream, connection, &answer, bare);
            }
            let sent = answer.send(&mut Timed::new(stream, self.limits.time), false, bare);
            if sent.is_err() {
                return;
            }
            connection.wait();
        }
    }

    fn answer(&self, head: &Head, below: Target<'_>, body: &mut Body<'_, '_>) -> Answer {
        let Target::Below(below) = below else {
            return Answer::moved(&self.guard.page());
        };
        let work = AssertUnwindSafe(|| match &self.site {
            Site::Studio(studio) => api::answer(studio, head, below, body),
            Site::Study(study) => study_requests::answer(study, head, below, body),
        });
        match catch_unwind(work) {
            Ok(Ok(answer)) => answer,
            Ok(Err(error)) => Answer::from(&error),
            // What panicked has said why on standard error.
            Err(_) => Answer::from(&ApiError::panicked()),
        }
    }

    /// Sends the last answer of a connection, and reads what still comes.
    fn end(
        &self,
        stream: &TcpStream,
        connection: &AdmittedConnection,
        answer: &Answer,
        bare: bool,
    ) {
        let mut timed = Timed::new(stream, self.limits.time);
        if answer.send(&mut timed, true, bare).is_err() || stream.shutdown(Shutdown::Write).is_err()
        {
            return;
        }
        connection.linger();
        let mut rest = Timed::new(stream, LINGER.min(self.limits.time));
        let mut unwanted = [0; 1 << 14];
        while rest.read(&mut unwanted).is_ok_and(|count| count > 0) {}
    }
}
