//! Serves virtual devices to whoever attaches them.
//!
//! A connection has a thread that reads what the other side submits. A transfer that the device
//! answers at once is answered at once. Others stay pending, and a thread that also moves the
//! devices' time asks again twice a millisecond.

use std::io::{self, Write as _};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread;
use std::time::{Duration, Instant};

use super::wire::{
    BUS_ID, BUSY, GRANTED, HEADER, Header, MAX_TRANSFER, NO_DEVICE, REPLY_IMPORT, REPLY_LIST,
    REQUEST_IMPORT, REQUEST_LIST, SUBMIT, SUBMITTED, UNLINK, UNLINKED, bus_id, operation, record,
    status, take,
};
use crate::{AnyDevice, Device as _, Port, Reply, Setup, Socket};

/// Time between two questions.
const STEP: Duration = Duration::from_micros(500);
/// Time for a request before a device is imported.
const PATIENCE: Duration = Duration::from_secs(5);
/// Transfers that may be pending on a connection.
const MAX_PENDING: usize = 256;

/// A USB/IP server and the devices it exports.
pub struct Server {
    devices: Vec<Served>,
    stop: AtomicBool,
}

struct Served {
    bus_id: String,
    socket: Socket<AnyDevice>,
    connection: Mutex<Weak<Connection>>,
}

/// A device that is imported.
struct Connection {
    stream: TcpStream,
    plugged: u64,
    pending: Mutex<Vec<Transfer>>,
}

/// A transfer without an answer.
struct Transfer {
    header: Header,
    data: Vec<u8>,
    /// It will never have one.
    lost: bool,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Server {
    /// Serves devices, as `1-1`, `1-2` and so on.
    #[must_use]
    pub fn new(sockets: impl IntoIterator<Item = Socket<AnyDevice>>) -> Arc<Self> {
        let devices = sockets.into_iter().enumerate().map(|(n, socket)| Served {
            bus_id: format!("1-{}", n + 1),
            socket,
            connection: Mutex::default(),
        });
        Arc::new(Self {
            devices: devices.collect(),
            stop: AtomicBool::new(false),
        })
    }

    /// Ends [`Self::run`] soon.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Release);
    }

    /// Accepts connections until [`Self::stop`].
    ///
    /// # Errors
    /// What the system says of the listener, or of a thread that it does not allow.
    pub fn run(self: &Arc<Self>, listener: &TcpListener) -> io::Result<()> {
        listener.set_nonblocking(true)?;
        let server = self.clone();
        let clock = thread::Builder::new().spawn(move || server.clock())?;
        while !self.stop.load(Ordering::Acquire) {
            match listener.accept() {
                Ok((stream, _)) => {
                    let server = self.clone();
                    // A connection that breaks is its client's affair. Where no thread can serve it,
                    // it is closed.
                    let _ = thread::Builder::new().spawn(move || server.serve(stream));
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {
                    thread::sleep(Duration::from_millis(5));
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => {
                    self.stop();
                    let _ = clock.join();
                    return Err(error);
                }
            }
        }
        let _ = clock.join();
        Ok(())
    }

    /// Moves time, and asks for what is pending.
    fn clock(&self) {
        let mut last = Instant::now();
        while !self.stop.load(Ordering::Acquire) {
            thread::sleep(STEP);
            let passed = last.elapsed();
            last += passed;
            for served in &self.devices {
                served.socket.port().advance(passed.as_secs_f64());
                let connection = lock(&served.connection).upgrade();
                if let Some(connection) = connection
                    && !connection.ask(&served.socket)
                {
                    connection.end();
                }
            }
        }
        for served in &self.devices {
            if let Some(connection) = lock(&served.connection).upgrade() {
                connection.end();
            }
        }
    }

    fn serve(&self, mut stream: TcpStream) -> io::Result<()> {
        stream.set_nonblocking(false)?;
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        loop {
            let [_, _, c0, c1, ..] = take::<8>(&mut stream)?;
            match u16::from_be_bytes([c0, c1]) {
                REQUEST_LIST => stream.write_all(&self.list())?,
                REQUEST_IMPORT => {
                    let wanted = take::<BUS_ID>(&mut stream)?;
                    if let Some((served, connection)) = self.import(&mut stream, &wanted)? {
                        let result = connection.read(&served.socket);
                        connection.end();
                        return result;
                    }
                }
                _ => return Err(io::ErrorKind::InvalidData.into()),
            }
        }
    }

    fn list(&self) -> Vec<u8> {
        let mut count = 0_u32;
        let mut records = Vec::new();
        for (n, served) in self.devices.iter().enumerate() {
            let port = served.socket.port();
            if port.is_plugged_in() {
                let descriptors = port.device.descriptors();
                count += 1;
                records.extend(record(&served.bus_id, n as u32 + 1, descriptors));
                for interface in &descriptors.interfaces {
                    records.extend(interface.class);
                    records.push(0);
                }
            }
        }
        let mut bytes = operation(REPLY_LIST, GRANTED);
        bytes.extend(count.to_be_bytes());
        bytes.extend(records);
        bytes
    }

    /// Gives a device to the other side, if it is there and nobody has it.
    fn import(
        &self,
        stream: &mut TcpStream,
        wanted: &[u8; BUS_ID],
    ) -> io::Result<Option<(&Served, Arc<Connection>)>> {
        let mut all = self.devices.iter().enumerate();
        let found = all.find(|(_, served)| bus_id(&served.bus_id) == *wanted);
        let Some((n, served)) = found.filter(|(_, s)| s.socket.port().is_plugged_in()) else {
            stream.write_all(&operation(REPLY_IMPORT, NO_DEVICE))?;
            return Ok(None);
        };
        let connection = {
            let mut holder = lock(&served.connection);
            if holder.upgrade().is_some() {
                stream.write_all(&operation(REPLY_IMPORT, BUSY))?;
                return Ok(None);
            }
            let connection = Arc::new(Connection {
                stream: stream.try_clone()?,
                plugged: served.socket.port().times_plugged_in(),
                pending: Mutex::default(),
            });
            *holder = Arc::downgrade(&connection);
            connection
        };
        stream.set_read_timeout(None)?;
        let mut bytes = operation(REPLY_IMPORT, GRANTED);
        let port = served.socket.port();
        bytes.extend(record(
            &served.bus_id,
            n as u32 + 1,
            port.device.descriptors(),
        ));
        drop(port);
        stream.write_all(&bytes)?;
        Ok(Some((served, connection)))
    }
}

impl Connection {
    /// Ends the connection: to the other side the device is unplugged.
    fn end(&self) {
        // It may have ended already.
        let _ = self.stream.shutdown(Shutdown::Both);
    }

    /// Reads what the other side submits, until it ends.
    fn read(&self, socket: &Socket<AnyDevice>) -> io::Result<()> {
        let mut stream = &self.stream;
        loop {
            let header = Header::of(&take::<HEADER>(&mut stream)?);
            match header.command {
                SUBMIT => {
                    let [_, length, _, packets, _] = header.numbers;
                    // Isochronous transfers have packets; no device here has such endpoints.
                    let isochronous = packets != 0 && packets != u32::MAX;
                    if length > MAX_TRANSFER || isochronous {
                        return Err(io::ErrorKind::InvalidData.into());
                    }
                    let mut data = Vec::new();
                    if !header.from_device {
                        data.resize(length as usize, 0);
                        io::Read::read_exact(&mut stream, &mut data)?;
                    }
                    let mut pending = lock(&self.pending);
                    if pending.len() >= MAX_PENDING {
                        return Err(io::ErrorKind::InvalidData.into());
                    }
                    pending.push(Transfer {
                        header,
                        data,
                        lost: false,
                    });
                }
                UNLINK => {
                    let mut pending = lock(&self.pending);
                    let wanted = header.numbers[0];
                    let place = pending.iter().position(|t| t.header.sequence == wanted);
                    // A transfer that is done already is answered before this.
                    let status = place.map_or(0, |_| status::TAKEN_BACK);
                    if let Some(place) = place {
                        pending.remove(place);
                    }
                    let mut numbers = [0; 5];
                    numbers[0] = status as u32;
                    let reply = Header {
                        command: UNLINKED,
                        sequence: header.sequence,
                        numbers,
                        ..Header::default()
                    };
                    stream.write_all(&reply.bytes())?;
                }
                _ => return Err(io::ErrorKind::InvalidData.into()),
            }
            if !self.ask(socket) {
                return Ok(());
            }
        }
    }

    /// Answers what can be answered. False when the device is gone, or the other side.
    fn ask(&self, socket: &Socket<AnyDevice>) -> bool {
        let mut pending = lock(&self.pending);
        let mut port = socket.port();
        if port.times_plugged_in() != self.plugged {
            return false;
        }
        // Transfers of an endpoint keep their order: one that waits holds up those behind it.
        let mut waiting: Vec<(u32, bool)> = Vec::new();
        let mut at = 0;
        while at < pending.len() {
            let transfer = &mut pending[at];
            let place = (transfer.header.endpoint, transfer.header.from_device);
            if transfer.lost || waiting.contains(&place) {
                waiting.push(place);
                at += 1;
                continue;
            }
            let (status, count, bytes) = match try_transfer(&mut port, transfer) {
                Reply::Done { count, bytes } => (0, count, bytes),
                Reply::Stalled => (status::STALLED, 0, Vec::new()),
                Reply::Gone => return false,
                Reply::Pending => {
                    waiting.push(place);
                    at += 1;
                    continue;
                }
                Reply::Never => {
                    transfer.lost = true;
                    waiting.push(place);
                    at += 1;
                    continue;
                }
            };
            let header = Header {
                command: SUBMITTED,
                sequence: transfer.header.sequence,
                numbers: [status as u32, count as u32, 0, u32::MAX, 0],
                ..Header::default()
            };
            let mut reply = header.bytes().to_vec();
            if transfer.header.from_device {
                reply.extend(&bytes);
            }
            pending.remove(at);
            if (&self.stream).write_all(&reply).is_err() {
                return false;
            }
        }
        port.is_plugged_in()
    }
}

fn try_transfer(port: &mut Port<AnyDevice>, transfer: &Transfer) -> Reply {
    let header = &transfer.header;
    let endpoint = header.endpoint as u8 & 0xf;
    if endpoint == 0 {
        return port.control(&Setup::of(header.setup), &transfer.data);
    }
    if header.from_device {
        port.read(endpoint | 0x80, header.numbers[1] as usize)
    } else {
        port.write(endpoint, &transfer.data)
    }
}
