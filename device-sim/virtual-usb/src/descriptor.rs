//! USB descriptors (USB 2.0, chapter 9.6).

/// An endpoint of an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Endpoint {
    /// Number, with bit 7 for one to the computer.
    pub address: u8,
    /// 2: bulk, 3: interrupt.
    pub kind: u8,
    /// Largest packet, bytes.
    pub packet_bytes: u16,
    /// Interval, ms; 0 for bulk.
    pub interval_ms: u8,
}

/// An interface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interface {
    /// Class, subclass, protocol.
    pub class: [u8; 3],
    /// Descriptors of the class, between those of the interface and of its endpoints.
    pub class_descriptors: Vec<u8>,
    /// Its endpoints.
    pub endpoints: Vec<Endpoint>,
}

/// A full-speed device with one configuration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Descriptors {
    /// Vendor id.
    pub vendor: u16,
    /// Product id.
    pub product: u16,
    /// Release, BCD.
    pub release: u16,
    /// Class of the device, 0 where each interface has its own.
    pub class: u8,
    /// Manufacturer, product, serial number.
    pub strings: [String; 3],
    /// Its interfaces, numbered in turn.
    pub interfaces: Vec<Interface>,
}

impl Descriptors {
    /// The device descriptor.
    #[must_use]
    pub fn device(&self) -> Vec<u8> {
        let mut bytes = vec![18, 1, 0x00, 0x02, self.class, 0, 0, 64];
        for number in [self.vendor, self.product, self.release] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend([1, 2, 3, 1]);
        bytes
    }

    /// The configuration with all that belongs to it.
    #[must_use]
    pub fn configuration(&self) -> Vec<u8> {
        let mut parts = Vec::new();
        for (number, interface) in self.interfaces.iter().enumerate() {
            let [class, subclass, protocol] = interface.class;
            let endpoints = interface.endpoints.len() as u8;
            parts.extend([
                9,
                4,
                number as u8,
                0,
                endpoints,
                class,
                subclass,
                protocol,
                0,
            ]);
            parts.extend(&interface.class_descriptors);
            for endpoint in &interface.endpoints {
                parts.extend([7, 5, endpoint.address, endpoint.kind]);
                parts.extend(endpoint.packet_bytes.to_le_bytes());
                parts.push(endpoint.interval_ms);
            }
        }
        let total = 9 + parts.len() as u16;
        let mut bytes = vec![9, 2];
        bytes.extend(total.to_le_bytes());
        // Self-powered, 100 mA.
        bytes.extend([self.interfaces.len() as u8, 1, 0, 0xc0, 50]);
        bytes.extend(parts);
        bytes
    }

    /// A string descriptor: 0 is the language, American English. `None` for one that there is not.
    #[must_use]
    pub fn string(&self, index: u8) -> Option<Vec<u8>> {
        if index == 0 {
            return Some(vec![4, 3, 0x09, 0x04]);
        }
        let text = self.strings.get(usize::from(index) - 1)?;
        let units: Vec<u16> = text.encode_utf16().take(126).collect();
        let mut bytes = vec![2 + 2 * units.len() as u8, 3];
        bytes.extend(units.into_iter().flat_map(u16::to_le_bytes));
        Some(bytes)
    }

    /// Returns true for an endpoint of any interface, and for endpoint 0.
    #[must_use]
    pub fn has_endpoint(&self, address: u8) -> bool {
        let mut all = self.interfaces.iter().flat_map(|i| &i.endpoints);
        address & 0xf == 0 || all.any(|endpoint| endpoint.address == address)
    }
}
