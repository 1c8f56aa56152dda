//! macOS, Windows and others. Untested: nobody has run this.

use super::{Grant, Policy, Refusal, Wanted, system};
use std::fs::File;

pub(super) fn acquire(wanted: &Wanted, _: u32, grants: &mut Vec<Grant>, _: &mut Vec<File>) {
    if wanted.policy != Policy::Other {
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
    if wanted.lock_memory {
        absent("memory", "locked".into());
    }
    if let Some(cpu) = wanted.cpu {
        absent("processor", cpu.to_string());
    }
}
