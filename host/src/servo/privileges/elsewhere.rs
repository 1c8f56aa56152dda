//! macOS, Windows and others. Untested: nobody has run this.

use super::{Grant, Policy, PrivilegeRequest, Refusal, system};
use std::fs::File;

pub(super) fn acquire(
    request: &PrivilegeRequest,
    _: u32,
    grants: &mut Vec<Grant>,
    _: &mut Vec<File>,
) {
    if request.policy != Policy::Other {
        let answer = system::set_interactive().map_err(|error| Refusal {
            why: error.to_string(),
            remedy: "close other programs; this system has nothing to grant".into(),
        });
        grants.push(Grant {
            what: "policy",
            wanted: system::INTERACTIVE.into(),
            refusal: answer.err(),
        });
    }
    let mut absent = |what, wanted: String| {
        grants.push(Grant {
            what,
            wanted,
            refusal: Some(Refusal {
                why: "this system has no such setting, or none that is used here".into(),
                remedy: "use Linux for a servo loop that is never late".into(),
            }),
        });
    };
    if request.lock_memory {
        absent("memory", "locked".into());
    }
    if let Some(cpu) = request.cpu {
        absent("processor", cpu.to_string());
    }
}
