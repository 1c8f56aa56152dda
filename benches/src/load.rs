//! The work of loading: the bytes of a texture are checked and a slot is prepared. The index of
//! a library is checked before a texture is looked up.

use crate::texture::texture;
use asperity_formats::{
    Asset, Numerator,
    library::{LibraryIndex, encode_library, encoded_len},
};
use asperity_runtime::{HostTexture, quantity::Quantity};

/// Textures of the library.
pub const TEXTURES: usize = 1000;

/// The measured work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Work {
    /// Every check of an asset of order 20, ARMA.
    Parse,
    /// The same, and a slot prepared for 1 kHz.
    Load,
    /// Every check of the index of a library of [`TEXTURES`] textures, and one of them found.
    Index,
}

impl Work {
    /// Every kind of work with its name.
    pub const ALL: [(Self, &'static str); 3] = [
        (Self::Parse, "parse, order 20, ARMA"),
        (Self::Load, "parse and load, order 20, ARMA"),
        (Self::Index, "index of 1,000 textures"),
    ];
}

/// The bytes to work on, and a slot.
pub struct Loading {
    asset: Vec<u8>,
    library: Vec<u8>,
    slot: Box<HostTexture>,
}

impl Default for Loading {
    fn default() -> Self {
        Self::new()
    }
}

impl Loading {
    /// Makes the bytes and an empty slot.
    ///
    /// # Panics
    /// If the format refuses the bytes.
    #[must_use]
    pub fn new() -> Self {
        let small = texture(4, Numerator::Nyquist);
        let names: Vec<String> = (0..TEXTURES).map(|n| format!("texture {n:04}")).collect();
        let textures: Vec<(&str, &[u8])> = names
            .iter()
            .map(|name| (name.as_str(), small.as_slice()))
            .collect();
        let mut library = vec![0; encoded_len(&textures)];
        encode_library(&textures, &mut library).expect("a valid library");
        Self {
            asset: texture(20, Numerator::Lsf),
            library,
            slot: Box::new(HostTexture::new()),
        }
    }

    /// Does the work once, and returns the number of vertices, transient ticks or textures.
    ///
    /// # Panics
    /// If the bytes are refused.
    #[inline(never)]
    pub fn once(&mut self, work: Work) -> usize {
        let asset = || Asset::parse(&self.asset).expect("a valid asset");
        match work {
            Work::Parse => asset().grid().vertices().len(),
            Work::Load => {
                self.slot.load(&asset(), 1000.0).expect("it fits");
                self.slot.taps().ticks()
            }
            Work::Index => {
                let index = LibraryIndex::parse(&self.library).expect("a valid index");
                let last = format!("texture {:04}", TEXTURES - 1);
                index.find(&last).expect("it is there") + 1
            }
        }
    }

    /// Checks that a loaded slot has what the asset has.
    ///
    /// # Panics
    /// If it has not.
    pub fn check(&mut self) {
        assert_eq!(self.once(Work::Parse), 40);
        assert_eq!(self.once(Work::Index), TEXTURES);
        assert!(self.once(Work::Load) >= 10, "10 ms of source at 1 kHz");
        let loudest = self.slot.filter_at(140.0, 2.0).level_m_s2;
        assert!(loudest > 0.1, "the middle of the grid sounds: {loudest}");
        let taps = self.slot.taps();
        let impact = taps.select(Quantity::of(0.4));
        let impulse: f32 = (0..taps.ticks())
            .map(|n| taps.acceleration(&impact, n).value())
            .sum();
        assert!(impulse.abs() > 0.1, "a tap has an impulse: {impulse}");
    }
}
