//! The tables.

use crate::{measure::Measured, target::Target};
use asperity_session::{PHASE_TICKS, Phase};
use asperity_tests::figures::{self, Set};

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

/// Returns the figures that pages quote: cells of the tables, and the cost of the first case.
pub(crate) fn figures(target: &Target, measured: &[Measured]) -> Option<(&'static str, Set)> {
    let (name, processor) = match target.triple {
        "thumbv7em-none-eabihf" => ("cortex_m4f", "Cortex-M4F"),
        "thumbv7m-none-eabi" => ("cortex_m3", "Cortex-M3"),
        _ => return None,
    };
    let first = measured.first()?;
    let line = |label: &str, cell: &dyn Fn(&Measured) -> u64| {
        let cells: Vec<String> = measured.iter().map(|m| figures::count(cell(m))).collect();
        format!("| {label} | {} |\n", cells.join(" | "))
    };
    let head = |what: &str| {
        let names: Vec<&str> = measured.iter().map(|m| m.case.texture).collect();
        let rule = "---:|".repeat(measured.len());
        format!("| {what} | {} |\n|---|{rule}\n", names.join(" | "))
    };
    let mean = |m: &Measured| m.session().iter().sum::<u64>() / m.session().len().max(1) as u64;
    let spreads: Vec<String> = measured
        .iter()
        .map(|m| format!("{:.1} %", m.spread_percent()))
        .collect();
    let instructions = [
        head(&format!("executed instructions a tick, {processor}")),
        line("minimum", &|m| m.session().first().copied().unwrap_or(0)),
        line("median", &Measured::median),
        line("mean", &mean),
        line("maximum", &Measured::worst),
        format!(
            "| costliest phase over cheapest, means | {} |\n",
            spreads.join(" | ")
        ),
    ];
    let bytes = [
        head(&format!("bytes, {processor}")),
        line("code and constants, with the harness", &|m| {
            m.elf.flash_bytes
        }),
        line("code that the tick reaches", &|m| m.reach.code_bytes as u64),
        line("code that parsing and loading reach", &|m| {
            m.load_code_bytes as u64
        }),
        line("slot, 40 vertices and 56 triangles", &|m| m.slot_bytes),
        line("state", &|m| m.state_bytes),
        line("stack, parse and load", &|m| m.stack_load_bytes),
        line("stack, tick", &|m| m.stack_tick_bytes),
    ];
    let spread = |m: &Measured| {
        let counts = m.session();
        let least = counts.first().copied().unwrap_or(0);
        [least, m.median(), m.worst()]
            .map(figures::count)
            .join(" / ")
    };
    let rows: String = measured
        .iter()
        .map(|m| format!("| {} | {} |\n", m.case.texture, spread(m)))
        .collect();
    let command = format!(
        "cargo run --release -p asperity-cortex-m -- --target {}",
        target.triple
    );
    let set = Set::new(
        &command,
        [
            ("most", figures::count(first.worst())),
            ("median", figures::count(first.median())),
            ("state", figures::count(first.state_bytes)),
            ("slot", figures::count(first.slot_bytes)),
            ("tick_code", figures::count(first.reach.code_bytes as u64)),
            ("tick_stack", figures::count(first.stack_tick_bytes)),
            ("load_stack", figures::count(first.stack_load_bytes)),
            (
                "spreads",
                format!("| a tick, instructions | min / p50 / max |\n|---|---:|\n{rows}"),
            ),
            ("instructions", instructions.concat()),
            ("bytes", bytes.concat()),
        ],
    );
    Some((name, set.under(format!("QEMU, {}", figures::compiler()))))
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
