//! Counts what a file would take many times its own bytes for, before it is decoded.
//!
//! A message or a name of two bytes becomes a structure of up to two hundred, and a varint of one
//! byte a number of eight. Bulk data are borrowed and take nothing more.

use super::refusal::refusal;
use crate::OnnxError;

/// Most messages and names of a file: nodes, constants, ports, attributes, inputs.
const MAX_ITEMS: usize = 1 << 16;
/// Most bytes of integers in lists, outside of `raw_data`.
const MAX_INTEGER_BYTES: usize = 16 << 20;

/// The messages of [`crate::proto`] that hold others, or lists.
#[derive(Clone, Copy)]
enum Message {
    Model,
    Graph,
    Node,
    Attribute,
    Tensor,
    Value,
    Type,
    TensorType,
    Shape,
    Other,
}

/// Content of a field.
enum Content {
    Message(Message),
    Name,
    Integers,
}

impl Message {
    /// Returns the content of a field of the message; `None` where it takes no more than its bytes.
    const fn field(self, tag: u64) -> Option<Content> {
        use Content::{Integers, Name};
        Some(match (self, tag) {
            (Self::Model, 7) => Content::Message(Self::Graph),
            (Self::Graph, 1) => Content::Message(Self::Node),
            (Self::Graph, 5) | (Self::Attribute, 5) => Content::Message(Self::Tensor),
            (Self::Graph, 11 | 12) => Content::Message(Self::Value),
            (Self::Node, 5) => Content::Message(Self::Attribute),
            (Self::Value, 2) => Content::Message(Self::Type),
            (Self::Type, 1) => Content::Message(Self::TensorType),
            (Self::TensorType, 2) => Content::Message(Self::Shape),
            (Self::Model, 8 | 14) | (Self::Shape, 1) => Content::Message(Self::Other),
            (Self::Graph, 15) | (Self::Node, 1 | 2) => Name,
            (Self::Tensor, 1 | 5 | 7) | (Self::Attribute, 8) => Integers,
            _ => return None,
        })
    }
}

/// Counts so far.
#[derive(Default)]
struct Counts {
    items: usize,
    integer_bytes: usize,
}

/// Refuses a file of too many parts. What is no protobuf is left to the decoder.
pub(super) fn check(bytes: &[u8]) -> Result<(), OnnxError> {
    Counts::default().message(bytes, Message::Model)
}

impl Counts {
    fn message(&mut self, mut rest: &[u8], message: Message) -> Result<(), OnnxError> {
        while let Some(key) = varint(&mut rest) {
            let content = message.field(key >> 3);
            let Some(value) = value(&mut rest, key & 7) else {
                return Ok(());
            };
            match content {
                Some(Content::Message(inner)) => {
                    self.item()?;
                    self.message(value, inner)?;
                }
                Some(Content::Name) => self.item()?,
                Some(Content::Integers) => {
                    // One that is not in a packed list is counted with its key.
                    self.integer_bytes += value.len() + 1;
                    if self.integer_bytes > MAX_INTEGER_BYTES {
                        let reason = format!("more than {MAX_INTEGER_BYTES} bytes of integers");
                        return Err(refusal("graph", reason + "; use raw_data"));
                    }
                }
                None => {}
            }
        }
        Ok(())
    }

    fn item(&mut self) -> Result<(), OnnxError> {
        self.items += 1;
        if self.items > MAX_ITEMS {
            let reason = format!("more than {MAX_ITEMS} nodes, names and constants");
            return Err(refusal("graph", reason));
        }
        Ok(())
    }
}

/// The bytes of a value; none of a number. `None` at the end of what is protobuf.
fn value<'a>(rest: &mut &'a [u8], wire_type: u64) -> Option<&'a [u8]> {
    let len = match wire_type {
        0 => {
            varint(rest)?;
            return Some(&[]);
        }
        1 => 8,
        2 => usize::try_from(varint(rest)?).ok()?,
        // Groups: what is in them is counted as if it were outside.
        3 | 4 => 0,
        5 => 4,
        _ => return None,
    };
    let (value, after) = rest.split_at_checked(len)?;
    *rest = after;
    Some(value)
}

fn varint(rest: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    for shift in (0..70).step_by(7) {
        let (&byte, after) = rest.split_first()?;
        *rest = after;
        value |= u64::from(byte & 0x7f).checked_shl(shift).unwrap_or(0);
        if byte < 0x80 {
            return Some(value);
        }
    }
    None
}
