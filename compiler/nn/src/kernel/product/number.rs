//! The forms in which an element of the right-hand side is stored.

/// A number that widens to f32 without rounding.
pub(super) trait Number: Copy {
    /// The number.
    fn f32(self) -> f32;
}

impl Number for f32 {
    #[inline(always)]
    fn f32(self) -> f32 {
        self
    }
}

/// Little-endian float32, at any address.
impl Number for [u8; 4] {
    #[inline(always)]
    fn f32(self) -> f32 {
        f32::from_le_bytes(self)
    }
}
