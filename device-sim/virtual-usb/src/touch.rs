//! A virtual 3D Systems Touch, as far as it identifies itself.
//!
//! Its descriptors are made up from its ids and from the class that was seen in public. It never
//! sends a payload, and counts whatever is sent to it: a driver must send nothing.

use super::descriptor::{Descriptors, Endpoint, Interface};
use super::{Answer, Device, Setup};

/// Which firmware it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Firmware {
    /// 0301:2988, vendor-specific.
    First,
    /// 2988:0302, a serial line.
    Serial,
    /// 2988:0304, a HID.
    Hid,
}

/// A virtual Touch.
#[derive(Debug, Clone)]
pub struct Touch {
    descriptors: Descriptors,
    /// Bytes that were sent to its endpoints: guessed frames.
    pub guessed_bytes: u64,
    /// Requests of a class or a vendor.
    pub requests: u64,
}

impl Touch {
    /// A Touch that is switched on.
    #[must_use]
    pub fn new(firmware: Firmware) -> Self {
        let (vendor, product) = match firmware {
            Firmware::First => (0x0301, 0x2988),
            Firmware::Serial => (0x2988, 0x0302),
            Firmware::Hid => (0x2988, 0x0304),
        };
        let endpoint = |address, kind| Endpoint {
            address,
            kind,
            packet_bytes: 64,
            interval_ms: if kind == 3 { 1 } else { 0 },
        };
        let interface = |class, class_descriptors, endpoints| Interface {
            class,
            class_descriptors,
            endpoints,
        };
        let interfaces = match firmware {
            Firmware::First => {
                let both = vec![endpoint(0x81, 2), endpoint(0x01, 2)];
                vec![interface([0xff, 0, 0], Vec::new(), both)]
            }
            Firmware::Serial => {
                // Header, call management, abstract control, union of interfaces 0 and 1.
                let functional = vec![
                    5, 0x24, 0, 0x10, 1, 5, 0x24, 1, 0, 1, 4, 0x24, 2, 2, 5, 0x24, 6, 0, 1,
                ];
                let both = vec![endpoint(0x82, 2), endpoint(0x02, 2)];
                vec![
                    interface([2, 2, 1], functional, vec![endpoint(0x81, 3)]),
                    interface([10, 0, 0], Vec::new(), both),
                ]
            }
            Firmware::Hid => {
                // A report descriptor of 21 bytes, which nobody reads here.
                let hid = vec![9, 0x21, 0x11, 0x01, 0, 1, 0x22, 21, 0];
                let both = vec![endpoint(0x81, 3), endpoint(0x01, 3)];
                vec![interface([3, 0, 0], hid, both)]
            }
        };
        Self {
            descriptors: Descriptors {
                vendor,
                product,
                release: 0x0100,
                class: if firmware == Firmware::Serial { 2 } else { 0 },
                strings: ["Asperity", "virtual Touch", "VT0001"].map(String::from),
                interfaces,
            },
            guessed_bytes: 0,
            requests: 0,
        }
    }
}

impl Device for Touch {
    fn descriptors(&self) -> &Descriptors {
        &self.descriptors
    }

    fn control(&mut self, _: &Setup, _: &[u8]) -> Answer {
        self.requests += 1;
        Answer::Stall
    }

    fn write(&mut self, _: u8, bytes: &[u8]) -> Answer {
        self.guessed_bytes += bytes.len() as u64;
        Answer::Done(Vec::new())
    }

    fn read(&mut self, _: u8, _: usize) -> Answer {
        Answer::Pending
    }

    fn advance(&mut self, _: f64) {}
}
