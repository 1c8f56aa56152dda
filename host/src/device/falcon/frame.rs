//! The 16 bytes that go each way once a period.
//!
//! ```text
//! byte      0    1–4   5–8   9–12   13                               14   15
//! command  '<'   m₁    m₂    m₃     'A' + (LEDs | homing)            'A'  '>'
//! answer   '<'   e₁    e₂    e₃     'A' + (homed·16 | buttons)        ?   '>'
//! ```
//!
//! A number has 16 bits in two's complement. It takes four bytes, its lowest four bits first, each
//! four bits as `'A'` plus their value. What byte 14 of an answer holds is not described; it is
//! ignored.

/// Bytes of a command and of an answer.
pub const FRAME_BYTES: usize = 16;
/// Largest magnitude of a motor's command.
pub const MOTOR_LIMIT: i16 = 4096;

/// The lights of the grip's ring, a bit each, as byte 13 has them.
pub mod led {
    /// Green.
    pub const GREEN: u8 = 0x2;
    /// Blue.
    pub const BLUE: u8 = 0x4;
    /// Red.
    pub const RED: u8 = 0x8;
}
const HOMING: u8 = 0x1;
const LEDS: u8 = led::GREEN | led::BLUE | led::RED;

/// A command to the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Command {
    /// Counts of the three motors.
    pub motors: [i16; 3],
    /// Lights that are on, see [`led`].
    pub leds: u8,
    /// True if the encoders search for and keep their zero; must be set in every command.
    pub homing: bool,
}

/// An answer of the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Answer {
    /// Counts of the three encoders.
    pub encoders: [i16; 3],
    /// Homed encoders, a bit each.
    pub homed: u8,
    /// Buttons that are held, a bit each: plus, forward, centre, minus.
    pub buttons: u8,
}

/// Every encoder has found its zero.
pub const ALL_HOMED: u8 = 0b111;

impl Command {
    /// As bytes.
    #[must_use]
    pub fn encode(&self) -> [u8; FRAME_BYTES] {
        let flags = (self.leds & LEDS) | if self.homing { HOMING } else { 0 };
        encode(self.motors, flags)
    }

    /// From bytes. `None` if they are no command.
    #[must_use]
    pub fn decode(bytes: &[u8; FRAME_BYTES]) -> Option<Self> {
        let (motors, flags) = decode(bytes)?;
        (flags <= (LEDS | HOMING)).then_some(Self {
            motors,
            leds: flags & LEDS,
            homing: flags & HOMING != 0,
        })
    }
}

impl Answer {
    /// As bytes.
    #[must_use]
    pub fn encode(&self) -> [u8; FRAME_BYTES] {
        let flags = (self.homed & ALL_HOMED) << 4 | (self.buttons & 0xf);
        encode(self.encoders, flags)
    }

    /// From bytes. `None` if they are no answer.
    #[must_use]
    pub fn decode(bytes: &[u8; FRAME_BYTES]) -> Option<Self> {
        let (encoders, flags) = decode(bytes)?;
        (flags <= 0x7f).then_some(Self {
            encoders,
            homed: flags >> 4,
            buttons: flags & 0xf,
        })
    }
}

fn encode(numbers: [i16; 3], flags: u8) -> [u8; FRAME_BYTES] {
    let mut bytes = [b'A'; FRAME_BYTES];
    bytes[0] = b'<';
    bytes[15] = b'>';
    for (n, number) in numbers.into_iter().enumerate() {
        for nibble in 0..4 {
            bytes[1 + 4 * n + nibble] += ((number as u16) >> (4 * nibble)) as u8 & 0xf;
        }
    }
    bytes[13] += flags;
    bytes
}

fn decode(bytes: &[u8; FRAME_BYTES]) -> Option<([i16; 3], u8)> {
    if bytes[0] != b'<' || bytes[15] != b'>' {
        return None;
    }
    let mut numbers = [0_u16; 3];
    for (n, number) in numbers.iter_mut().enumerate() {
        for nibble in 0..4 {
            let value = bytes[1 + 4 * n + nibble].wrapping_sub(b'A');
            if value > 0xf {
                return None;
            }
            *number |= u16::from(value) << (4 * nibble);
        }
    }
    Some((
        numbers.map(|number| number as i16),
        bytes[13].wrapping_sub(b'A'),
    ))
}

/// Finds answers in a stream of bytes that may begin, break off or be wrong anywhere.
#[derive(Debug, Clone, Default)]
pub struct Frames {
    held: [u8; FRAME_BYTES],
    count: usize,
    /// Bytes that belonged to no frame.
    pub skipped: u64,
}

impl Frames {
    /// Takes bytes; gives the newest answer that they complete.
    pub fn push(&mut self, bytes: &[u8]) -> Option<Answer> {
        let mut newest = None;
        for byte in bytes {
            self.held[self.count] = *byte;
            self.count += 1;
            if self.count == FRAME_BYTES {
                match Answer::decode(&self.held) {
                    Some(answer) => {
                        newest = Some(answer);
                        self.count = 0;
                    }
                    None => self.resume(1),
                }
            } else if self.count == 1 {
                self.resume(0);
            }
        }
        newest
    }

    /// Forgets what was held, after a gap in the stream.
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Goes on at the first `<` at or behind `from`.
    fn resume(&mut self, from: usize) {
        let held = &self.held[from..self.count];
        let begin = held.iter().position(|byte| *byte == b'<');
        let begin = begin.map_or(self.count, |n| n + from);
        self.skipped += begin as u64;
        self.held.copy_within(begin..self.count, 0);
        self.count -= begin;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NUMBERS: [i16; 9] = [0, 1, -1, 15, 16, 4096, -4096, i16::MAX, i16::MIN];

    #[test]
    fn every_number_light_and_button_comes_back() {
        for (n, first) in NUMBERS.into_iter().enumerate() {
            let numbers = [first, NUMBERS[(n + 3) % 9], NUMBERS[(n + 5) % 9]];
            for flags in 0..0x80_u8 {
                let answer = Answer {
                    encoders: numbers,
                    homed: flags >> 4,
                    buttons: flags & 0xf,
                };
                assert_eq!(Answer::decode(&answer.encode()), Some(answer));
                let command = Command {
                    motors: numbers,
                    leds: flags & LEDS,
                    homing: flags & 1 != 0,
                };
                assert_eq!(Command::decode(&command.encode()), Some(command));
            }
        }
    }

    #[test]
    fn the_bytes_are_those_of_the_description() {
        let command = Command {
            motors: [0x1234, -1, 0],
            leds: led::RED,
            homing: true,
        };
        assert_eq!(&command.encode(), b"<EDCBPPPPAAAAJA>");
    }

    #[test]
    fn one_wrong_byte_is_no_frame() {
        let good = Answer::default().encode();
        for place in (0..16).filter(|place| *place != 14) {
            for wrong in [0, b'@', b'Q', 0xff] {
                let mut bytes = good;
                bytes[place] = wrong;
                // Byte 13 holds seven bits; 'Q' is one of its values.
                if place == 13 && wrong == b'Q' {
                    continue;
                }
                assert_eq!(Answer::decode(&bytes), None, "byte {place} = {wrong}");
            }
        }
    }

    #[test]
    fn answers_are_found_again_after_any_loss() {
        let answer = |n: i16| Answer {
            encoders: [n, -n, 7 * n],
            homed: 7,
            buttons: (n & 0xf) as u8,
        };
        let stream: Vec<u8> = (1..=40).flat_map(|n| answer(n).encode()).collect();
        // A loss of just a frame, amid two, joins their halves: the protocol has no sum to tell.
        for cut in (0..33).filter(|cut| cut % 16 != 0) {
            for piece in [1, 3, 16, 62] {
                let mut broken = stream.clone();
                broken.drain(100..100 + cut);
                let mut frames = Frames::default();
                let seen: Vec<Answer> = broken
                    .chunks(piece)
                    .filter_map(|b| frames.push(b))
                    .collect();
                assert_eq!(seen.last(), Some(&answer(40)), "cut {cut}, piece {piece}");
                // What a cut mixes is never taken for an answer.
                let known = |a: &Answer| (1..=40).any(|n| answer(n) == *a);
                assert!(seen.iter().all(known), "cut {cut}, piece {piece}");
            }
        }
    }
}
