//! The wire of USB/IP, by a client of our own: what a kernel does when it attaches a device.

use std::io::Write as _;
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::JoinHandle;

use asperity_host::device::falcon::frame::{Answer, Command};
use asperity_host::device::falcon::ftdi::{RUNNING, payload};
use asperity_virtual_usb::falcon::Falcon;
use asperity_virtual_usb::touch::{Firmware, Touch};
use asperity_virtual_usb::transfer_fault::Rates;
use asperity_virtual_usb::usbip::server::Server;
use asperity_virtual_usb::usbip::wire::{BUSY, GRANTED, NO_DEVICE, status};
use asperity_virtual_usb::{AnyDevice, Port, Setup, Socket};

use crate::client::{Client, Event};

struct Served {
    server: Arc<Server>,
    address: SocketAddr,
    thread: Option<JoinHandle<()>>,
    sockets: Vec<Socket<AnyDevice>>,
}

impl Served {
    fn new(ports: Vec<Port<AnyDevice>>) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let address = listener.local_addr().expect("its address");
        let sockets: Vec<_> = ports.into_iter().map(Socket::new).collect();
        let server = Server::new(sockets.iter().cloned());
        let running = server.clone();
        let thread = std::thread::spawn(move || running.run(&listener).expect("it serves"));
        Self {
            server,
            address,
            thread: Some(thread),
            sockets,
        }
    }

    fn client(&self) -> Client {
        Client::connect(self.address).expect("a connection")
    }

    fn imported(&self) -> Client {
        let mut client = self.client();
        assert_eq!(client.import("1-1").expect("a reply"), GRANTED);
        client
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.server.stop();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn falcon() -> Port<AnyDevice> {
    Port::new(AnyDevice::Falcon(Box::new(Falcon::running())))
}

fn touch() -> Port<AnyDevice> {
    Port::new(AnyDevice::Touch(Touch::new(Firmware::Serial)))
}

fn get_descriptor(kind: u8, index: u8, length: u16) -> Setup {
    Setup {
        request_type: 0x80,
        request: 6,
        value: u16::from_le_bytes([index, kind]),
        index: 0,
        length,
    }
}

fn done(client: &mut Client) -> (u32, i32, Vec<u8>) {
    match client.wait().expect("a reply") {
        Event::Done {
            sequence,
            status,
            bytes,
            ..
        } => (sequence, status, bytes),
        other => panic!("{other:?}"),
    }
}

fn set_up(client: &mut Client) {
    for setting in RUNNING {
        let (request, value) = setting.request();
        let setup = Setup {
            request_type: 0x40,
            request,
            value,
            index: 0,
            length: 0,
        };
        let sequence = client.control(setup, &[]).expect("a request");
        assert_eq!(done(client), (sequence, 0, Vec::new()));
    }
}

#[test]
fn a_list_names_what_is_plugged_in() {
    let served = Served::new(vec![falcon(), touch()]);
    let list = served.client().list().expect("a list");
    assert_eq!(list.len(), 2);
    assert_eq!((&*list[0].bus_id, list[0].ids), ("1-1", (0x0403, 0xcb48)));
    assert_eq!(list[0].interfaces, [[0xff; 3]]);
    assert_eq!((&*list[1].bus_id, list[1].ids), ("1-2", (0x2988, 0x0302)));
    assert_eq!(list[1].interfaces, [[2, 2, 1], [10, 0, 0]]);
    served.sockets[0].port().unplug(f64::INFINITY);
    assert_eq!(served.client().list().expect("a list").len(), 1);
}

#[test]
fn one_client_has_a_device_at_a_time() {
    let served = Served::new(vec![falcon()]);
    assert_eq!(served.client().import("1-9").expect("a reply"), NO_DEVICE);
    let first = served.imported();
    assert_eq!(served.client().import("1-1").expect("a reply"), BUSY);
    drop(first);
    let freed = (0..100).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(10));
        served.client().import("1-1").expect("a reply") == GRANTED
    });
    assert!(freed, "a device whose client went away is free again");
}

#[test]
fn descriptors_come_whole_or_as_much_as_was_asked_for() {
    let served = Served::new(vec![falcon()]);
    let mut client = served.imported();
    let mut get = |kind, index, length| {
        let sequence = client.control(get_descriptor(kind, index, length), &[]);
        let (of, status, bytes) = done(&mut client);
        assert_eq!(of, sequence.expect("a request"));
        (status, bytes)
    };
    let (_, device) = get(1, 0, 64);
    assert_eq!(device.len(), 18);
    assert_eq!(device[8..12], [0x03, 0x04, 0x48, 0xcb]);
    assert_eq!(get(1, 0, 8).1, device[..8]);
    let (_, configuration) = get(2, 0, 255);
    let total = u16::from_le_bytes([configuration[2], configuration[3]]);
    assert_eq!(usize::from(total), configuration.len());
    assert_eq!(configuration.len(), 9 + 9 + 7 + 7);
    let (_, serial) = get(3, 3, 255);
    let text: Vec<u16> = serial[2..]
        .chunks(2)
        .map(|c| u16::from_le_bytes([c[0], c[1]]))
        .collect();
    assert_eq!(String::from_utf16_lossy(&text), "VF0001");
    // What there is not is refused, and the device goes on.
    assert_eq!(get(6, 0, 10).0, status::STALLED);
    assert_eq!(get(1, 0, 18).0, 0);
}

#[test]
fn a_transfer_stays_pending_until_there_is_an_answer() {
    let served = Served::new(vec![falcon()]);
    let mut client = served.imported();
    set_up(&mut client);
    let command = Command {
        homing: true,
        ..Command::default()
    };
    for _ in 0..200 {
        let waiting = client.read(0x81, 64).expect("a transfer");
        let sent = client.write(0x02, &command.encode()).expect("a transfer");
        let (mut answered, mut taken) = (None, false);
        let mut reading = waiting;
        while answered.is_none() || !taken {
            let (sequence, status, bytes) = done(&mut client);
            assert_eq!(status, 0);
            if sequence == sent {
                taken = true;
            } else if let Ok(frame) = payload(&bytes).try_into() {
                assert_eq!(sequence, reading);
                answered = Answer::decode(frame);
            } else {
                // Status bytes alone: the chip's latency passed.
                assert_eq!(bytes.len(), 2);
                reading = client.read(0x81, 64).expect("a transfer");
            }
        }
    }
}

#[test]
fn what_is_taken_back_is_answered_once() {
    let served = Served::new(vec![touch()]);
    let mut client = served.imported();
    // A Touch never sends: its transfers wait for ever.
    let first = client.read(0x82, 64).expect("a transfer");
    let second = client.read(0x82, 64).expect("a transfer");
    for waiting in [second, first] {
        let sequence = client.take_back(waiting).expect("a request");
        let status = status::TAKEN_BACK;
        assert_eq!(
            client.wait().expect("a reply"),
            Event::TakenBack { sequence, status }
        );
    }
    let sequence = client.take_back(first).expect("a request");
    assert_eq!(
        client.wait().expect("a reply"),
        Event::TakenBack {
            sequence,
            status: 0
        }
    );
}

#[test]
fn a_stall_lasts_until_it_is_cleared() {
    let mut rates = Rates::default();
    rates.of[0] = 1.0;
    let device = AnyDevice::Falcon(Box::new(Falcon::running()));
    let served = Served::new(vec![Port::with_faults(device, rates, 1)]);
    let mut client = served.imported();
    set_up(&mut client);
    let frame = Command::default().encode();
    client.write(0x02, &frame).expect("a transfer");
    assert_eq!(done(&mut client).1, status::STALLED);
    served.sockets[0].port().set_rates(Rates::default());
    client.write(0x02, &frame).expect("a transfer");
    assert_eq!(done(&mut client).1, status::STALLED, "it still stalls");
    let clear = Setup {
        request_type: 2,
        request: 1,
        value: 0,
        index: 2,
        length: 0,
    };
    client.control(clear, &[]).expect("a request");
    assert_eq!(done(&mut client).1, 0);
    client.write(0x02, &frame).expect("a transfer");
    assert_eq!(done(&mut client).1, 0);
    // An endpoint that there is not stalls as well.
    client.write(0x05, &frame).expect("a transfer");
    assert_eq!(done(&mut client).1, status::STALLED);
}

#[test]
fn unplugging_ends_the_connection_and_plugging_in_allows_another() {
    let served = Served::new(vec![falcon()]);
    let mut client = served.imported();
    client.read(0x81, 64).expect("a transfer");
    served.sockets[0].port().unplug(0.05);
    let ended = (0..100).any(|_| client.wait().is_err());
    assert!(ended, "to the client the device is gone");
    let back = (0..100).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(10));
        served.client().import("1-1").expect("a reply") == GRANTED
    });
    assert!(back, "it can be attached again");
}

#[test]
fn nonsense_ends_its_connection_alone() {
    let served = Served::new(vec![falcon()]);
    for nonsense in [&[0xff; 64][..], &[0; 3], b"GET / HTTP/1.1\r\n\r\n"] {
        let mut stream = TcpStream::connect(served.address).expect("a connection");
        stream.write_all(nonsense).expect("bytes");
    }
    let mut client = served.imported();
    // More bytes than a transfer may have.
    client.read(0x81, u32::MAX).expect("a transfer");
    assert!(client.wait().is_err());
    assert_eq!(served.client().list().expect("a list").len(), 1);
}
