//! The onset of a contact: when its vibration may be heard.
//!
//! A contact is silent until a query that was taken in it takes effect, and starts at its own
//! model. Out of contact the cycles go on, so that a tick always costs the same.

/// Contact during a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Onset {
    /// Not throughout.
    Left,
    /// Throughout since its query, the query's own tick included.
    Begun,
    /// The same, and the parameters at work belong to this contact.
    Followed,
}

impl Onset {
    /// Notes that a query is taken.
    #[inline(always)]
    pub(crate) fn begin_cycle(&mut self) {
        if *self == Self::Left {
            *self = Self::Begun;
        }
    }
}
