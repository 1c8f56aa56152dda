//! HMPG, the binary form of ISO/IEC 23090-31 (MPEG haptics): a stream of units of packets.
//!
//! The first unit initialises: timing, and metadata of the experience, its perceptions, channels and
//! bands. Each unit that follows holds the keyframes of 128 ms, and a silent unit stands for a gap.
//! Bits are written from the most significant one on, and packets end at whole bytes. Amplitudes
//! have 8 bits, which is what this form loses against HJIF.

use super::hjif::{Band, Channel, Document, Effect, Perception};
use asperity_io::shown::shortened;

/// Ticks of a unit, in parts of a second.
const UNITS_A_SECOND: f64 = 1000.0 / 128.0;
/// The latest tick of a keyframe within its effect.
pub(super) const MAX_TICK: i64 = u16::MAX as i64;
/// Largest gain that 32 bits are spread over.
const MAX_GAIN: f32 = 10_000.0;

/// Packets and units by their numbers.
mod number {
    pub(super) const INITIALIZATION: u64 = 0;
    pub(super) const TEMPORAL: u64 = 1;
    pub(super) const SILENT: u64 = 3;
    pub(super) const METADATA_HAPTICS: u64 = 1;
    pub(super) const METADATA_PERCEPTION: u64 = 2;
    pub(super) const METADATA_CHANNEL: u64 = 3;
    pub(super) const METADATA_BAND: u64 = 4;
    pub(super) const DATA: u64 = 5;
    pub(super) const INITIALIZATION_TIMING: u64 = 11;
    pub(super) const VIBROTACTILE: u64 = 6;
    pub(super) const LINEAR: u64 = 2;
}

/// The document with the amplitudes that 8 bits leave.
pub(super) fn quantised(document: &Document) -> Document {
    let mut document = document.clone();
    let channels = document
        .perceptions
        .iter_mut()
        .flat_map(|p| &mut p.channels);
    for band in channels.flat_map(|channel| &mut channel.bands) {
        for frame in band
            .effects
            .iter_mut()
            .flat_map(|effect| &mut effect.keyframes)
        {
            let code = frame.amplitude_modulation.map(|x| f64::from(code(x)));
            frame.amplitude_modulation = code.map(|code| code / 255.0 * 2.0 - 1.0);
        }
    }
    document
}

/// An amplitude in 8 bits.
fn code(amplitude: f64) -> u8 {
    ((amplitude.clamp(-1.0, 1.0) + 1.0) / 2.0 * 255.0).round() as u8
}

/// Writes a document whose curves end by [`MAX_TICK`].
pub(super) fn write(document: &Document) -> Vec<u8> {
    let ticks = (f64::from(document.timescale) / UNITS_A_SECOND).round() as i64;
    let mut bytes = initialization(document, ticks);
    let bands: Vec<(&Perception, &Channel, &Band)> = document
        .perceptions
        .iter()
        .flat_map(|p| p.channels.iter().map(move |c| (p, c)))
        .flat_map(|(p, c)| c.bands.iter().map(move |b| (p, c, b)))
        .collect();
    let last = bands.iter().flat_map(|(_, _, band)| &band.effects);
    let last = last.flat_map(times).max().unwrap_or(0);
    let mut silence = 0;
    for start in (0..=last).step_by(ticks.max(1) as usize) {
        let mut packets = Vec::new();
        let mut continues = false;
        for (id, (perception, channel, band)) in (0u64..).zip(&bands) {
            if let Some((packet, goes_on)) = data(start, ticks, id, perception, channel, band) {
                packets.extend(packet);
                continues |= goes_on;
            }
        }
        if packets.is_empty() {
            silence += ticks;
            continue;
        }
        // A unit can be decoded alone where all its effects begin in it.
        let sync = u64::from(continues);
        if silence > 0 {
            bytes.extend(unit(number::SILENT, sync, silence, &[]));
            silence = 0;
        }
        bytes.extend(unit(number::TEMPORAL, sync, ticks, &packets));
    }
    bytes
}

/// Ticks of an effect's keyframes.
fn times(effect: &Effect) -> impl Iterator<Item = i64> {
    let position = effect.position;
    let frames = effect.keyframes.iter();
    frames.map(move |frame| position + frame.relative_position.unwrap_or(0))
}

fn initialization(document: &Document, ticks: i64) -> Vec<u8> {
    let mut timing = Bits::default();
    timing.put(0, 32);
    timing.put(u64::from(document.timescale), 32);
    timing.put(ticks as u64, 24);
    timing.put(0, 24 + 1);
    let mut packets = packet(number::INITIALIZATION_TIMING, timing);

    let mut haptics = Bits::default();
    haptics.text(&document.version);
    haptics.text(&document.profile);
    haptics.put(u64::from(document.level), 8);
    haptics.text(&document.date);
    haptics.text(&document.description);
    haptics.put(document.perceptions.len() as u64, 8);
    haptics.put(0, 8);
    packets.extend(packet(number::METADATA_HAPTICS, haptics));

    for perception in &document.perceptions {
        let mut bits = Bits::default();
        bits.put(perception.id as u64, 8);
        bits.put(0, 8);
        bits.text(&perception.description);
        bits.put(number::VIBROTACTILE, 8);
        bits.put(perception.avatar_id as u64, 8);
        // No library, no semantics; units of 10⁻³ s and 1; no device.
        bits.put(0, 16 + 1);
        bits.put(-3i64 as u64, 8);
        bits.put(0, 8);
        bits.put(0, 8);
        bits.put(perception.channels.len() as u64, 16);
        packets.extend(packet(number::METADATA_PERCEPTION, bits));
    }
    let mut band_id = 0;
    let mut of_bands = Vec::new();
    for perception in &document.perceptions {
        for channel in &perception.channels {
            packets.extend(packet(
                number::METADATA_CHANNEL,
                metadata(perception, channel),
            ));
            for band in &channel.bands {
                of_bands.extend(packet(
                    number::METADATA_BAND,
                    band_metadata(band_id, perception, channel, band),
                ));
                band_id += 1;
            }
        }
    }
    packets.extend(of_bands);
    unit(number::INITIALIZATION, 0, 0, &packets)
}

fn metadata(perception: &Perception, channel: &Channel) -> Bits {
    let mut bits = Bits::default();
    bits.put(channel.id as u64, 16);
    bits.put(perception.id as u64, 8);
    bits.put(0, 8);
    bits.text(&channel.description);
    // No reference device.
    bits.put(255, 8);
    bits.spread(channel.gain as f32, -MAX_GAIN);
    bits.spread(channel.mixing_coefficient as f32, 0.0);
    // A mask of body parts follows.
    bits.put(1, 8);
    bits.put(u64::from(channel.body_part_mask), 32);
    // No sampling frequency, no vertices.
    bits.put(0, 32);
    bits.put(0, 16);
    bits.put(channel.bands.len() as u64, 8);
    bits
}

fn band_metadata(id: u64, perception: &Perception, channel: &Channel, band: &Band) -> Bits {
    let mut bits = Bits::default();
    bits.put(id, 8);
    bits.put(perception.id as u64, 8);
    bits.put(channel.id as u64, 16);
    bits.put(0, 8);
    bits.put(u64::from(is_curve(band)), 3);
    if is_curve(band) {
        bits.put(number::LINEAR, 4);
    }
    bits.put(u64::from(band.lower_frequency_limit), 16);
    bits.put(u64::from(band.upper_frequency_limit), 16);
    bits.put(band.effects.len() as u64, 16);
    bits
}

/// A band of what is written is a curve, number 1, or transients, number 0.
fn is_curve(band: &Band) -> bool {
    band.curve_type.is_some()
}

/// The keyframes of a band from `start` on for some ticks, and whether an effect began before;
/// `None` if there are none.
fn data(
    start: i64,
    ticks: i64,
    band_id: u64,
    perception: &Perception,
    channel: &Channel,
    band: &Band,
) -> Option<(Vec<u8>, bool)> {
    let range = start..start + ticks;
    let inside: Vec<(&Effect, Vec<usize>)> = band
        .effects
        .iter()
        .map(|effect| {
            let found = times(effect).enumerate().filter(|(_, t)| range.contains(t));
            (effect, found.map(|(n, _)| n).collect::<Vec<_>>())
        })
        .filter(|(_, frames)| !frames.is_empty())
        .collect();
    // The last effect of a packet says whether the packet stands alone.
    let goes_on = inside.last()?.1.first() != Some(&0);
    let mut bits = Bits::default();
    bits.put(u64::from(goes_on), 1);
    bits.put(perception.id as u64, 8);
    bits.put(channel.id as u64, 16);
    bits.put(band_id, 8);
    bits.put(inside.len() as u64, 16);
    for (effect, frames) in &inside {
        bits.put(effect.id.unwrap_or(0) as u64, 16);
        bits.put(0, 2);
        bits.put((effect.position - start) as u64, 25);
        bits.put(0, 1);
        bits.put(frames.len() as u64, 16);
        for &n in frames {
            let frame = &effect.keyframes[n];
            let amplitude = frame.amplitude_modulation.unwrap_or(0.0);
            bits.put(u64::from(code(amplitude)), 8);
            bits.put(frame.relative_position.unwrap_or(0) as u64, 16);
            if !is_curve(band) {
                bits.put(frame.frequency_modulation.unwrap_or(0) as u64, 16);
            }
        }
    }
    Some((packet(number::DATA, bits), goes_on))
}

fn packet(kind: u64, payload: Bits) -> Vec<u8> {
    let payload = payload.bytes();
    let mut header = Bits::default();
    header.put(kind, 6);
    header.put(payload.len() as u64, 17);
    header.put(0, 1);
    let mut bytes = header.bytes();
    bytes.extend(payload);
    bytes
}

fn unit(kind: u64, sync: u64, ticks: i64, packets: &[u8]) -> Vec<u8> {
    let mut header = Bits::default();
    header.put(kind, 6);
    header.put(sync, 2);
    // The base layer.
    header.put(0, 4);
    header.put(ticks as u64, 24);
    header.put(packets.len() as u64, 32);
    header.put(0, 4);
    let mut bytes = header.bytes();
    bytes.extend(packets);
    bytes
}

/// Bits, the most significant one of each number first.
#[derive(Debug, Default)]
struct Bits {
    bytes: Vec<u8>,
    /// Bits of the last byte that are taken; 0 for a full one.
    used_bits: u32,
}

impl Bits {
    /// The lowest `count` bits of a number; a negative one is given as its two's complement.
    fn put(&mut self, value: u64, count: u32) {
        for place in (0..count).rev() {
            if self.used_bits == 0 {
                self.bytes.push(0);
            }
            let bit = (value >> place & 1) as u8;
            if let Some(last) = self.bytes.last_mut() {
                *last |= bit << (7 - self.used_bits);
            }
            self.used_bits = (self.used_bits + 1) % 8;
        }
    }

    /// A length of 8 bits and as many bytes, cut between characters.
    fn text(&mut self, text: &str) {
        let text = shortened(text, 255);
        self.put(text.len() as u64, 8);
        for byte in text.bytes() {
            self.put(u64::from(byte), 8);
        }
    }

    /// A number from `low` to [`MAX_GAIN`] in 32 bits.
    fn spread(&mut self, value: f32, low: f32) {
        let share = ((value - low) / (MAX_GAIN - low)).clamp(0.0, 1.0);
        self.put((f64::from(share) * f64::from(u32::MAX)) as u64, 32);
    }

    fn bytes(self) -> Vec<u8> {
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_laid_one_after_the_other_and_the_last_byte_is_filled_with_zeros() {
        let mut bits = Bits::default();
        bits.put(0b101, 3);
        bits.put(-3i64 as u64, 8);
        bits.put(1, 1);
        assert_eq!(bits.bytes(), [0b1011_1111, 0b1011_0000]);
    }

    #[test]
    fn a_text_is_cut_between_characters() {
        let mut bits = Bits::default();
        bits.text(&"ä".repeat(200));
        let bytes = bits.bytes();
        assert_eq!((bytes.len(), bytes[0]), (255, 254));
    }

    #[test]
    fn eight_bits_are_off_by_half_a_step_at_most() {
        for n in -100..=100 {
            let x = f64::from(n) / 100.0;
            let back = f64::from(code(x)) / 255.0 * 2.0 - 1.0;
            assert!((back - x).abs() <= 0.5 * 2.0 / 255.0 + 1e-12, "{x}: {back}");
        }
    }
}
