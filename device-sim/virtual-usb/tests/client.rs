//! A client of our own: what a kernel does when it attaches a device.

use std::io::{self, Read as _, Write as _};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

use asperity_virtual_usb::Setup;
use asperity_virtual_usb::usbip::wire::{
    GRANTED, HEADER, Header, MAX_TRANSFER, RECORD, REPLY_IMPORT, REPLY_LIST, REQUEST_IMPORT,
    REQUEST_LIST, SUBMIT, SUBMITTED, UNLINK, UNLINKED, bus_id, operation, take,
};

/// A device of a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Listed {
    /// Its bus id.
    pub(crate) bus_id: String,
    /// Vendor and product id.
    pub(crate) ids: (u16, u16),
    /// Class, subclass, protocol of each interface.
    pub(crate) interfaces: Vec<[u8; 3]>,
}

/// Messages from the server once a device is imported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Event {
    /// A transfer is done.
    Done {
        /// Its number.
        sequence: u32,
        /// 0, or an error as Linux numbers them.
        status: i32,
        /// Bytes that went through.
        count: u32,
        /// Bytes from the device.
        bytes: Vec<u8>,
    },
    /// A transfer was taken back, or was done before.
    TakenBack {
        /// Number of the request.
        sequence: u32,
        /// 0 if the transfer was done before.
        status: i32,
    },
}

/// A connection.
pub(crate) struct Client {
    stream: TcpStream,
    sequence: u32,
    /// Numbers of transfers from the device: their replies carry bytes.
    from_device: Vec<u32>,
}

fn wrong(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what)
}

impl Client {
    /// Connects.
    pub(crate) fn connect(address: impl ToSocketAddrs) -> io::Result<Self> {
        let stream = TcpStream::connect(address)?;
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(Duration::from_secs(5)))?;
        Ok(Self {
            stream,
            sequence: 0,
            from_device: Vec::new(),
        })
    }

    /// Asks for the list of devices.
    pub(crate) fn list(&mut self) -> io::Result<Vec<Listed>> {
        self.stream.write_all(&operation(REQUEST_LIST, GRANTED))?;
        if take::<8>(&mut self.stream)?[..] != operation(REPLY_LIST, GRANTED) {
            return Err(wrong("no list"));
        }
        let count = u32::from_be_bytes(take(&mut self.stream)?);
        (0..count).map(|_| self.listed()).collect()
    }

    fn listed(&mut self) -> io::Result<Listed> {
        let record = take::<RECORD>(&mut self.stream)?;
        let id = record[256..288].split(|byte| *byte == 0).next();
        let number = |at: usize| u16::from_be_bytes([record[at], record[at + 1]]);
        let interfaces = (0..record[311]).map(|_| {
            let [class, subclass, protocol, _] = take::<4>(&mut self.stream)?;
            Ok([class, subclass, protocol])
        });
        Ok(Listed {
            bus_id: String::from_utf8_lossy(id.unwrap_or_default()).into_owned(),
            ids: (number(300), number(302)),
            interfaces: interfaces.collect::<io::Result<_>>()?,
        })
    }

    /// Asks for a device; gives the status, 0 if it is granted.
    pub(crate) fn import(&mut self, id: &str) -> io::Result<u32> {
        let mut request = operation(REQUEST_IMPORT, GRANTED);
        request.extend(bus_id(id));
        self.stream.write_all(&request)?;
        let [_, _, c0, c1, s0, s1, s2, s3] = take(&mut self.stream)?;
        if u16::from_be_bytes([c0, c1]) != REPLY_IMPORT {
            return Err(wrong("no reply to an import"));
        }
        let status = u32::from_be_bytes([s0, s1, s2, s3]);
        if status == GRANTED {
            take::<RECORD>(&mut self.stream)?;
        }
        Ok(status)
    }

    fn send(&mut self, mut header: Header, data: &[u8]) -> io::Result<u32> {
        self.sequence += 1;
        header.sequence = self.sequence;
        if header.command == SUBMIT && header.from_device {
            self.from_device.push(self.sequence);
        }
        let mut bytes = header.bytes().to_vec();
        bytes.extend(data);
        self.stream.write_all(&bytes)?;
        Ok(self.sequence)
    }

    /// Submits a control transfer; gives its number.
    pub(crate) fn control(&mut self, setup: Setup, data: &[u8]) -> io::Result<u32> {
        let header = Header {
            command: SUBMIT,
            from_device: setup.request_type & 0x80 != 0,
            numbers: [0, setup.length.into(), 0, u32::MAX, 0],
            setup: setup.bytes(),
            ..Header::default()
        };
        self.send(header, data)
    }

    /// Submits a transfer to an endpoint; gives its number.
    pub(crate) fn write(&mut self, endpoint: u8, data: &[u8]) -> io::Result<u32> {
        let header = Header {
            command: SUBMIT,
            endpoint: endpoint.into(),
            numbers: [0, data.len() as u32, 0, u32::MAX, 0],
            ..Header::default()
        };
        self.send(header, data)
    }

    /// Submits a transfer from an endpoint; gives its number.
    pub(crate) fn read(&mut self, endpoint: u8, most: u32) -> io::Result<u32> {
        let header = Header {
            command: SUBMIT,
            from_device: true,
            endpoint: (endpoint & 0xf).into(),
            numbers: [0, most, 0, u32::MAX, 0],
            ..Header::default()
        };
        self.send(header, &[])
    }

    /// Takes a transfer back; gives the number of the request.
    pub(crate) fn take_back(&mut self, sequence: u32) -> io::Result<u32> {
        let header = Header {
            command: UNLINK,
            numbers: [sequence, 0, 0, 0, 0],
            ..Header::default()
        };
        self.send(header, &[])
    }

    /// Waits for what the server sends next, 5 s at most.
    pub(crate) fn wait(&mut self) -> io::Result<Event> {
        let header = Header::of(&take::<HEADER>(&mut self.stream)?);
        let sequence = header.sequence;
        let [status, count, ..] = header.numbers;
        match header.command {
            SUBMITTED => {
                let known = self.from_device.iter().position(|n| *n == sequence);
                let mut bytes = Vec::new();
                if let Some(place) = known {
                    self.from_device.swap_remove(place);
                    if count > MAX_TRANSFER {
                        return Err(wrong("more bytes than a transfer has"));
                    }
                    bytes.resize(count as usize, 0);
                    self.stream.read_exact(&mut bytes)?;
                }
                Ok(Event::Done {
                    sequence,
                    status: status as i32,
                    count,
                    bytes,
                })
            }
            UNLINKED => Ok(Event::TakenBack {
                sequence,
                status: status as i32,
            }),
            _ => Err(wrong("neither a transfer nor one that was taken back")),
        }
    }
}
