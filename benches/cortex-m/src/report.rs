//! The tables.

use crate::{measure::Measured, target::Target};
use asperity_session::{PHASE_TICKS, Phase};

/// Prints what was measured.
pub(crate) fn print(target: &Target, measured: &[Measured]) {
    println!(
        "{} ({}, {}), QEMU {}",
        target.triple, target.processor, target.arithmetic, target.machine
    );
    println!("\nexecuted instructions a tick, min / p50 / max of {PHASE_TICKS} ticks");
    row("", measured, |m| m.case.name.to_owned());
    for (index, phase) in Phase::ALL.iter().enumerate() {
        row(phase.name(), measured, |m| spread(&m.phase(index)));
    }
    row("all", measured, |m| spread(&m.session()));
    row("mean of all", measured, |m| {
        let counts = m.session();
        (counts.iter().sum::<u64>() / counts.len().max(1) as u64).to_string()
    });
    row("means of phases", measured, |m| {
        format!("within {:.1} %", m.spread_percent())
    });
    println!("\nbytes");
    row("code, constants", measured, |m| {
        m.elf.flash_bytes.to_string()
    });
    row("initial values", measured, |m| {
        m.elf.initial_bytes.to_string()
    });
    row("code of the tick", measured, |m| {
        m.reach.code_bytes.to_string()
    });
    row("code of loading", measured, |m| {
        m.load_code_bytes.to_string()
    });
    row("statics in RAM", measured, |m| m.elf.ram_bytes.to_string());
    row("slot, part of it", measured, |m| m.slot_bytes.to_string());
    row("state", measured, |m| m.state_bytes.to_string());
    row("stack, load", measured, |m| m.stack_load_bytes.to_string());
    row("stack, tick", measured, |m| m.stack_tick_bytes.to_string());
    println!();
    row("hash of all bits", measured, |m| {
        let last = Phase::ALL[Phase::ALL.len() - 1];
        m.run
            .value(last.name())
            .map_or_else(|e| e.to_string(), |hash| format!("{hash:016x}"))
    });
    row("functions reached", measured, |m| {
        m.reach.functions.to_string()
    });
}

fn row(label: &str, measured: &[Measured], cell: impl Fn(&Measured) -> String) {
    print!("{label:<18}");
    for m in measured {
        print!("{:>24}", cell(m));
    }
    println!();
}

fn spread(ascending: &[u64]) -> String {
    let at = |index: usize| ascending.get(index).copied().unwrap_or(0);
    let (half, last) = (ascending.len() / 2, ascending.len().saturating_sub(1));
    format!("{} / {} / {}", at(0), at(half), at(last))
}
