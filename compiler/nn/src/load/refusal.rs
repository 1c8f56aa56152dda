//! The error of a part of the file that cannot be used.

use crate::OnnxError;

pub(super) fn refusal(field: &'static str, reason: String) -> OnnxError {
    OnnxError::Model { field, reason }
}
