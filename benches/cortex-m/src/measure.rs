//! Measures a case, from sources to figures.

use crate::{
    calls,
    elf::{self, Elf},
    emulate::{self, Run},
    package::Result,
    target::Target,
    toolchain::{Toolchain, host_session},
};
use asperity_session::{Case, PHASE_TICKS, Phase};

/// The function whose reach is searched for panics.
const TICK: &str = "asperity_tick";
/// Parsing and loading.
const LOAD: &str = "asperity_firmware::load";

/// Everything that was measured of a case.
#[derive(Debug)]
pub(crate) struct Measured {
    pub(crate) case: &'static Case,
    pub(crate) run: Run,
    /// With denormals flushed to zero, where floats have registers.
    flushed: Option<Run>,
    pub(crate) elf: Elf,
    pub(crate) reach: calls::Reach,
    /// Bytes of code that loading reaches.
    pub(crate) load_code_bytes: usize,
    pub(crate) state_bytes: u64,
    pub(crate) slot_bytes: u64,
    pub(crate) stack_load_bytes: u64,
    pub(crate) stack_tick_bytes: u64,
    /// Output on the host, by profile.
    host: [(&'static str, String); 2],
}

impl Measured {
    /// Executed instructions of a phase's ticks, ascending.
    pub(crate) fn phase(&self, index: usize) -> Vec<u64> {
        let ticks = PHASE_TICKS as usize;
        let mut counts = self.run.instructions[index * ticks..(index + 1) * ticks].to_vec();
        counts.sort_unstable();
        counts
    }

    /// Executed instructions of every tick, ascending.
    pub(crate) fn session(&self) -> Vec<u64> {
        let mut counts = self.run.instructions.clone();
        counts.sort_unstable();
        counts
    }

    /// Returns the median tick, in executed instructions.
    pub(crate) fn median(&self) -> u64 {
        let counts = self.session();
        counts.get(counts.len() / 2).copied().unwrap_or(0)
    }

    /// By how much the costliest phase exceeds the cheapest, in the mean of its ticks.
    pub(crate) fn spread_percent(&self) -> f64 {
        let sum = |index: usize| self.phase(index).iter().sum::<u64>() as f64;
        let sums = (0..Phase::ALL.len()).map(sum);
        let (least, most) = sums.fold((f64::MAX, 0.0), |(least, most): (f64, f64), sum| {
            (least.min(sum), most.max(sum))
        });
        (most / least - 1.0) * 100.0
    }

    /// The costliest tick.
    pub(crate) fn worst(&self) -> u64 {
        self.run.instructions.iter().copied().max().unwrap_or(0)
    }
}

/// Every case that fits the target.
pub(crate) fn all(target: &Target, toolchain: &Toolchain) -> Result<Vec<Measured>> {
    target
        .cases()
        .map(|case| {
            measure(target, toolchain, case).map_err(|e| format!("{}: {e}", case.name).into())
        })
        .collect()
}

fn measure(target: &Target, toolchain: &Toolchain, case: &'static Case) -> Result<Measured> {
    let path = toolchain.firmware(case.name, &[])?;
    let elf = elf::read(&path)?;
    let ticks = Phase::ALL.len() * PHASE_TICKS as usize;
    let run = emulate::run(target, &path, ticks)?;
    let flushed = if target.arithmetic == "float" {
        let path = toolchain.firmware(case.name, &["flush"])?;
        Some(emulate::run(target, &path, ticks)?)
    } else {
        None
    };
    let host = |profile| -> Result<_> {
        let printed = host_session(case.name, target.arithmetic, profile)?;
        Ok((profile, printed))
    };
    Ok(Measured {
        case,
        reach: calls::from(&elf, TICK),
        load_code_bytes: calls::from(&elf, LOAD).code_bytes,
        state_bytes: run.value("state")?,
        slot_bytes: run.value("slot")?,
        stack_load_bytes: run.value("stack-load")?,
        stack_tick_bytes: run.value("stack-tick")?,
        host: [host("test")?, host("release")?],
        run,
        flushed,
        elf,
    })
}

/// Panics that the tick reaches, and phases whose bits are not the host's.
pub(crate) fn differences(measured: &[Measured]) -> Vec<String> {
    let mut faults = Vec::new();
    for m in measured {
        let name = m.case.name;
        faults.extend(
            m.reach
                .faults
                .iter()
                .map(|fault| format!("{name}: {fault}")),
        );
        for (profile, printed) in &m.host {
            let runs = [("", Some(&m.run)), (", flushing", m.flushed.as_ref())];
            for (how, run) in runs {
                let difference = run.and_then(|run| difference(run, printed));
                faults.extend(difference.map(|(found, expected)| {
                    format!(
                        "{name}: the target{how} says `{found}`, the host ({profile}) `{expected}`"
                    )
                }));
            }
        }
    }
    faults
}

/// The first phase after which a run has another hash than the host: what follows differs too.
fn difference(run: &Run, host: &str) -> Option<(String, String)> {
    let mut lines = host.lines();
    Phase::ALL.iter().find_map(|phase| {
        let hash = run.value(phase.name()).unwrap_or(0);
        let found = format!("{} {hash:016x}", phase.name());
        let expected = lines.next().unwrap_or("nothing");
        (found != expected).then(|| (found, expected.to_owned()))
    })
}

/// A fault when the search for panics misses the one of a tick that can panic.
pub(crate) fn search_for_panics_works(
    target: &Target,
    toolchain: &Toolchain,
) -> Result<Option<String>> {
    let Some(case) = target.cases().last() else {
        return Ok(Some("no case fits the target".into()));
    };
    let elf = elf::read(&toolchain.firmware(case.name, &["can-panic"])?)?;
    let found = calls::from(&elf, TICK).faults;
    let panics = found.iter().any(|fault| fault.contains("panic"));
    Ok((!panics).then(|| format!("the search for panics misses a panic in the tick: {found:?}")))
}
