//! `asperity diff`.

use crate::cli::Diff;
use asperity::library::{Change, LoadedLibrary, diff};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &Diff, console: Console) -> Result<(), Failures> {
    let old = LoadedLibrary::open(&args.old).map_err(one)?;
    let new = LoadedLibrary::open(&args.new).map_err(one)?;
    let difference = diff(&old, &new).map_err(one)?;
    let printed = if args.json {
        // Plain structures of numbers and strings always serialise.
        console.json(&serde_json::to_value(&difference).unwrap_or_default())
    } else {
        console.text(&difference.to_string())
    };
    printed.map_err(one)?;
    let listed = difference.added.is_empty() && difference.removed.is_empty();
    let small = |change: &Change| args.within.is_some_and(|db| is_within(change, db));
    if difference.is_empty() || (listed && difference.changed.values().all(small)) {
        Ok(())
    } else {
        // The result is printed; a status of 1 says that there is one.
        Err(Vec::new())
    }
}

/// Returns true if the only haptic change is in the spectra, by at most `db` dB.
fn is_within(change: &Change, db: f64) -> bool {
    let same = |[old, new]: [f64; 2]| old == new;
    let taps = !change.sections.iter().any(|tag| tag == "TAPS");
    taps && !change.picture
        && same(change.mu)
        && same(change.stiffness_n_m)
        && change.spectrum_db.is_some_and(|[_, worst]| worst <= db)
}
